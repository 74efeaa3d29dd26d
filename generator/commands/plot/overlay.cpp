// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/overlay.hpp"

#include "commands/scene/scene_options.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

Scene overlaid_scene(const Options& options, const Model& model, const Scene& first, const std::string& name)
{
    Scene scene = scene_of(options, model, options.named("initial"), name);
    scene.plot = first.plot;
    scene.observe = first.observe;
    scene.states = first.states;
    return scene;
}

} // namespace

OverlaidRun::OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& first,
                         const std::string& name)
    : OverlaidRun(options, checked, overlaid_scene(options, checked.model, first, name))
{
}

OverlaidRun::OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& scene)
    : checked_(checked),
      run_(options, checked_, scene, method_of(options, scene), options.has("at") && !options.has("t-end")),
      outcome_(run_.integrate())
{
    if (is_interrupted(outcome_)) throw InterruptedError("lagen: interrupted while drawing");
}

std::vector<std::string> overlaid_scenes(const Options& options, const Model& model, const Scene& first)
{
    std::vector<std::string> names;
    if (!options.has("overlay")) return names;
    for (const char* word : {"accuracy", "bind", "branch", "variations", "jacobi-field"})
        if (options.has(word))
            throw UsageError(fmt::format("lagen run: --{} is of one run, and --overlay draws several", word));
    for (const std::string& text : options.all("overlay"))
        for (const std::string& name : split_list(text)) {
            if (name == first.name || std::ranges::find(names, name) != names.end())
                throw UsageError(fmt::format("lagen run: --overlay names scene '{}', which is drawn already", name));
            const Scene scene = scene_of(options, model, options.named("initial"), name);
            if (scene.form != first.form)
                throw UsageError(
                    fmt::format("lagen run: --overlay draws runs of one form, and scene '{}' is run in the "
                                "form '{}', scene '{}' in the form '{}'\nhint: --form {}",
                                first.name, first.form, name, scene.form, first.form));
            names.push_back(name);
        }
    if (names.empty()) throw UsageError("lagen run: --overlay needs the name of a scene");
    return names;
}

} // namespace lagen
