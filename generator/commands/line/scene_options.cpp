// SPDX-License-Identifier: GPL-2.0-or-later
/// The command line wins over the scene.
#include "commands/line/scene_options.hpp"

#include "commands/line/options.hpp"
#include "expression/parse.hpp"
#include "machine/places.hpp"
#include "model/families.hpp"
#include "model/read_curve.hpp"
#include "model/scene_form.hpp"
#include "scene/evaluate_scene.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

/// The text of --NAME, as a place that it is complained of at.
Excerpt text_of(const Options& options, const std::string& name)
{
    return whole_text("<--" + name + ">", options.get(name));
}

SourceRange place_of(const Options& options, const std::string& name)
{
    return text_of(options, name).range(0, options.get(name).size());
}

Tree tree_of(const Options& options, const Model& model, const std::string& name)
{
    return option_tree(model, name, text_of(options, name));
}

void replace_times(const Options& options, const Model& model, Scene& scene)
{
    if (options.has("t-end")) {
        const Tree end = tree_of(options, model, "t-end");
        scene.duration = scene.start ? add({end, negate(scene.start)}) : end;
    }
    if (!options.has("at")) return;
    scene.sampling = {Sampling::Kind::at, nullptr, 0, {}};
    for (const std::string& time : split_list(options.get("at")))
        scene.sampling.at.push_back(option_tree(model, "at", whole_text("<--at>", time)));
    if (scene.sampling.at.empty()) throw UsageError("--at needs at least one time, e.g. --at 0,1/2,1");
}

/// "x1:y1, [x2:y2, x3:y3]": what stands in brackets is one panel.
Plot curves_of(const Options& options, const Model& model)
{
    Plot plot;
    for (const std::string& text : options.all("curves"))
        for (const std::string& panel : split_list(text)) {
            const bool several = panel.starts_with('[') && panel.ends_with(']');
            std::vector<PlotCurve> curves;
            for (const std::string& curve :
                 several ? split_list(panel.substr(1, panel.size() - 2)) : std::vector{panel})
                for (PlotCurve& each : read_curve(model, model.columns, whole_text("<--curves>", curve)))
                    curves.push_back(std::move(each));
            if (!curves.empty()) add_panel(plot, std::move(curves));
        }
    if (plot.panels.empty()) throw UsageError("--curves needs at least one curve, e.g. --curves t:energy");
    return plot;
}

/// The picture of --plot shows curves of the command line, or those of --like, or those of the scene. Without --plot it
/// draws nothing.
void set_plot(const Options& options, const Model& model, Scene& scene)
{
    if (!options.has("plot")) scene.plot.reset();
    if (options.has("like")) {
        scene.plot = find_scene(model, options.get("like")).plot;
        if (!scene.plot)
            throw UsageError(
                fmt::format("--like takes the picture of scene '{}', which has none", options.get("like")));
    }
    if (options.has("curves")) scene.plot = curves_of(options, model);
    for (const char* word : {"equal", "points", "sphere"})
        if (options.has(word) && !scene.plot)
            throw UsageError(
                fmt::format("--{} is for curves, and scene '{}' has no [scene.{}.plot]", word, scene.name, scene.name),
                "give them: --curves x:y");
    if (options.has("equal")) scene.plot->equal = true;
    if (options.has("points")) scene.plot->points = true;
    if (options.has("sphere")) scene.plot->sphere = true;
}

/// Only the program behind `lagen run` steps from row to row.
void refuse_input_table(const Options& options, const Scene& scene)
{
    if (!scene.input_table || (options.command() == "run" && !options.has("accuracy"))) return;
    throw ModelError(fmt::format("scene '{}' takes its inputs from a table, which `lagen {}{}` does not", scene.name,
                                 options.command(), options.command() == "run" ? " --accuracy" : ""),
                     scene.input_table->where, "inputs = { u = \"..\" }");
}

} // namespace

CheckedModel loaded(const Options& options)
{
    CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    return checked;
}

Tree time_scale_of(const Options& options, const Model& model)
{
    if (!options.has("time-scale")) return nullptr;
    return model.observer.close(parse_expression(text_of(options, "time-scale")));
}

bool starts_from_momenta(const Model& model, const Scene& scene)
{
    const std::vector<Symbol>& momenta = model.fibre.momenta;
    return std::ranges::any_of(scene.initial, [&](const NamedTree& each) {
        return std::ranges::find(momenta, each.name, &Symbol::name) != momenta.end();
    });
}

std::vector<Symbol> initial_symbols(const Model& model, const Scene& scene)
{
    std::vector<Symbol> symbols = model.base.coordinates;
    if (!scene.element.empty() || !scene.next.empty()) return symbols; // the arrow says the rest
    const std::vector<Symbol>& rest = starts_from_momenta(model, scene) ? model.fibre.momenta : model.fibre.coordinates;
    symbols.insert(symbols.end(), rest.begin(), rest.end());
    const std::vector<Symbol> states = symbols_of(model, Role::state);
    symbols.insert(symbols.end(), states.begin(), states.end());
    return symbols;
}

std::vector<Symbol> swept_symbols(const std::string& option, const Model& model, const Scene& scene)
{
    return option == "set" ? free_parameters(model) : initial_symbols(model, scene);
}

SweptName resolved(const SweptName& given, const Model& model, const Scene& scene, const char* what,
                   const SourceRange& where)
{
    const auto& [option, name] = given;
    const std::vector<Symbol> symbols = swept_symbols(option, model, scene);
    const std::optional<ResolvedKey> key = resolve_key(symbols, name);
    if (key && key->shape.rank == Rank::scalar) return {option, key->name};
    const bool set = option == "set";
    throw ModelError(set ? fmt::format("the model has no single parameter '{}' {}", name, what)
                         : fmt::format("scene '{}' has no single initial value '{}' {}", scene.name, name, what),
                     where, hint_for_key(symbols, name, set ? "parameters" : "initial values"));
}

void set_initial(const Model& model, Scene& scene, const Setting& setting)
{
    const std::vector<Symbol> symbols = initial_symbols(model, scene);
    const std::optional<ResolvedKey> key = resolve_key(symbols, setting.name);
    const std::string given = setting.name + "=" + setting.value.text;
    if (!key)
        throw ModelError(fmt::format("scene '{}' has no initial value '{}' to change", scene.name, setting.name),
                         whole_text("<--initial>", given).range(0, setting.name.size()),
                         resolve_key(symbols_of(model, Role::parameter), setting.name)
                             ? fmt::format("--set {} changes a parameter", given)
                             : hint_for_key(symbols, setting.name, "initial values"));
    const SourceRange where = setting.value.range(0, setting.value.text.size());
    const std::vector<Tree> trees = fit_values(option_array(model, "initial", setting.value), key->shape,
                                               fmt::format("the initial value of '{}'", key->name), where,
                                               "an entry is written x[1], a norm norm(x)");
    std::vector<NamedTree> values;
    for (std::size_t k = 0; k < trees.size(); ++k) values.push_back({symbols[key->indices[k]].name, trees[k], where});
    put_all(scene.initial, std::move(values));
}

Scene scene_of(const Options& options, const Model& model, const std::vector<Setting>& initial,
               const std::optional<std::string>& name)
{
    Scene scene = find_scene(model, name.value_or(options.get("scene")));
    refuse_input_table(options, scene);
    if (options.has("method")) {
        scene.method = options.get("method");
        scene.method_where = place_of(options, "method");
    }
    if (options.has("step")) scene.step = tree_of(options, model, "step");
    if (options.has("time-scale")) scene.time_scale_where = place_of(options, "time-scale");
    if (options.has("time-scale") || options.has("accuracy")) scene.time_scale = time_scale_of(options, model);
    if (options.has("tolerance")) {
        scene.relative = scene.absolute = nullptr;
        scene.tolerance = tree_of(options, model, "tolerance");
    }
    replace_times(options, model, scene);
    for (const Setting& setting : initial) set_initial(model, scene, setting);
    set_plot(options, model, scene);
    return in_form(model, scene, options.has("form") ? options.get("form") : form_of(model, scene));
}

void require_curve(const Scene& scene, const char* what)
{
    if (!form_named(scene.form).steps) return;
    throw UsageError(fmt::format("{} of curves, and scene '{}' is a discrete motion", what, scene.name),
                     "--form lagrange, where the model has [lagrangian]");
}

void require_least(const Model& model, const Scene& scene)
{
    require_curve(scene, "least models are made");
    if (is_form(scene.form, FormKind::pontryagin))
        throw UsageError(fmt::format("least models are made of motions whose controls are given, and those of scene "
                                     "'{}' are searched for",
                                     scene.name));
    (void)evaluate_scene(model, scene);
}

void require_no_jumps(const Scene& scene, const char* what)
{
    const auto jumps = [](const Event& event) { return !event.jump.empty(); };
    const auto event = std::ranges::find_if(scene.events, jumps);
    if (event == scene.events.end()) return;
    throw UsageError(fmt::format("{} of motions without jumps, and the event '{}' of scene '{}' has one", what,
                                 event->name, scene.name),
                     "another scene, or the same without its events");
}

} // namespace lagen
