// SPDX-License-Identifier: GPL-2.0-or-later
/// The command line wins over the scene.
#include "commands/scene_options.hpp"

#include "expression/parse.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

Tree option_tree(const Model& model, const std::string& name, const std::string& text)
{
    return model.scope.close(parse_expression(whole_text("<--" + name + ">", text)));
}

void replace_times(const Options& options, const Model& model, Scene& scene)
{
    if (options.has("t-end")) {
        const Tree end = option_tree(model, "t-end", options.get("t-end"));
        scene.duration = scene.start ? add({end, negate(scene.start)}) : end;
    }
    if (!options.has("at")) return;
    scene.sampling = {Sampling::Kind::at, nullptr, 0, {}};
    for (const std::string& time : split_list(options.get("at")))
        scene.sampling.at.push_back(option_tree(model, "at", time));
    if (scene.sampling.at.empty()) throw UsageError("lagen run: --at needs at least one time, e.g. --at 0,1/2,1");
}

} // namespace

Scene scene_of(const Options& options, const Model& model)
{
    Scene scene = find_scene(model, options.get("scene"));
    if (options.has("method")) scene.method = options.get("method");
    if (options.has("step")) scene.step = option_tree(model, "step", options.get("step"));
    if (options.has("tolerance")) {
        scene.relative = scene.absolute = nullptr;
        scene.tolerance = option_tree(model, "tolerance", options.get("tolerance"));
    }
    replace_times(options, model, scene);
    return in_form(model, scene, options.has("form") ? options.get("form") : form_of(model, scene));
}

const MethodEntry& method_of(const Options& options, const Scene& scene)
{
    const std::string name = scene.method.empty() ? standard_method : scene.method;
    const MethodEntry* method = find_method(name);
    if (method == nullptr) {
        const std::string nearest = nearest_method(name);
        const std::string hint =
            nearest.empty() ? "`lagen methods` lists them" : fmt::format("did you mean '{}'?", nearest);
        if (options.has("method"))
            throw UsageError(fmt::format("lagen run: unknown method '{}'\nhint: {}", name, hint));
        throw ModelError(fmt::format("unknown method '{}'", name), scene.method_where, hint);
    }
    if (method->adaptive || scene.step) return *method;
    const std::string text =
        fmt::format("method '{}' needs a step: give --step, or `step` in scene '{}'", name, scene.name);
    if (options.has("method")) throw UsageError("lagen run: " + text);
    throw ModelError(text, scene.where);
}

} // namespace lagen
