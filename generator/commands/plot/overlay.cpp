// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/overlay.hpp"

#include "commands/scene/scene_options.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

Scene overlaid_scene(const Options& options, const Model& model, const Scene& last, const std::string& name)
{
    Scene scene = scene_of(options, model, options.named("initial"), name);
    scene.plot = last.plot;
    scene.observe = last.observe;
    scene.states = last.states;
    return scene;
}

} // namespace

OverlaidRun::OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& last,
                         const std::string& name)
    : OverlaidRun(options, checked, overlaid_scene(options, checked.model, last, name))
{
}

OverlaidRun::OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& scene)
    : checked_(checked),
      run_(options, checked_, scene, method_of(options, scene), options.has("at") && !options.has("t-end")),
      outcome_(run_.integrate())
{
    if (is_interrupted(outcome_)) throw InterruptedError("lagen: interrupted while drawing");
}

std::vector<std::string> overlaid_scenes(const Options& options, const Model& model, const Scene& last)
{
    std::vector<std::string> names = options.all("scene");
    if (names.size() < 2) return {};
    for (const char* word : {"accuracy", "bind", "branch", "variations", "jacobi-field"})
        if (options.has(word)) throw UsageError(fmt::format("--{} is of one run, and --scene names several", word));
    if (!options.has("plot"))
        throw UsageError("several scenes are drawn into one picture: give --plot FILE.svg as well");
    for (const std::string& name : names) {
        if (std::ranges::count(names, name) > 1) throw UsageError(fmt::format("--scene names '{}' twice", name));
        const Scene scene = scene_of(options, model, options.named("initial"), name);
        if (scene.form != last.form)
            throw UsageError(fmt::format("a picture is of runs of one form, and scene '{}' is run in the form '{}', "
                                         "scene '{}' in the form '{}'",
                                         last.name, last.form, scene.name, scene.form),
                             fmt::format("--form {}", last.form));
    }
    names.pop_back();
    return names;
}

} // namespace lagen
