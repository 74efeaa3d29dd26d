// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/morphism/image_scene.hpp"

#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

Tree number_of(long double value)
{
    return number(Rational(static_cast<double>(value)));
}

std::vector<NamedTree> trees_of(const std::vector<NamedNumber>& numbers)
{
    std::vector<NamedTree> trees;
    for (const auto& [name, value] : numbers) trees.push_back({name, number_of(value), {}});
    return trees;
}

/// The lanes of the start as the program has them, by names; those of arrows and of momenta are left out.
Values lanes_by_name(const SceneRun& source)
{
    const Model& model = source.checked().model;
    std::vector<Symbol> symbols = model.base.coordinates;
    if (!form_named(source.form()).momenta)
        symbols.insert(symbols.end(), model.fibre.coordinates.begin(), model.fibre.coordinates.end());
    Values values;
    for (std::size_t k = 0; k < symbols.size(); ++k) values[symbols[k].name] = source.input().initial[k];
    values["t"] = source.values().start;
    return values;
}

/// Those behind the base coordinates and, of a discrete motion, the arrow.
std::vector<long double> momenta_of(const SceneRun& source)
{
    const Model& model = source.checked().model;
    std::vector<long double> lanes = source.input().initial;
    const std::size_t r = model.fibre.momenta.size();
    const std::size_t carried = source.values().states.size();
    const auto end = lanes.end() - static_cast<std::ptrdiff_t>(carried);
    return {end - static_cast<std::ptrdiff_t>(r), end};
}

/// The image of the first arrow.
void start_from_arrow(const SceneRun& source, const Model& target, const Projection& projection, Values arrow,
                      Scene& scene)
{
    const SceneValues& values = source.values();
    const Model& model = source.checked().model;
    for (const auto& [name, value] : values.element) arrow[name] = value;
    for (std::size_t i = 0; i < values.next.size(); ++i) arrow[model.groupoid->next[i].name] = values.next[i].second;
    for (const long double entry : projection.element(arrow)) scene.element.push_back(number_of(entry));
    if (target.groupoid->next.empty()) return;
    Values end = arrow;
    for (const auto& [name, value] : values.next) end[name] = value;
    scene.next = trees_of(projection.base(end));
}

/// At the times of the rows that the source has, so that rows can be compared.
void take_times(const SceneRun& source, const Table& rows, Scene& scene)
{
    scene.start = number_of(source.values().start);
    if (source.values().discrete) {
        const std::size_t every = source.input().times.every;
        scene.steps = std::max<long>(1, static_cast<long>(every * (rows.count() - 1)));
        if (every == 1) return;
        scene.sampling.kind = Sampling::Kind::count;
        scene.sampling.count = rows.count();
        return;
    }
    scene.sampling.kind = Sampling::Kind::at;
    double last = static_cast<double>(source.values().start);
    for (std::size_t k = 0; k < rows.count(); ++k) {
        last = rows.row(k)[0];
        scene.sampling.at.push_back(number_of(last));
    }
    scene.duration = number(Rational(last) - Rational(static_cast<double>(source.values().start)));
}

/// That of the source, unless the step is a parameter of the target that the map gives another value.
Tree step_of(const Model& target, const Scene& scene, Tree step)
{
    if (!form_named(scene.form).steps) return step;
    const auto given = std::ranges::find(scene.parameters, target.discrete->step.name, &NamedTree::name);
    return given == scene.parameters.end() ? step : given->value;
}

} // namespace

std::size_t observe_states(const Model& model, Scene& scene)
{
    std::vector<std::string> needed = state_names(model, scene.form);
    if (!scene.observe) {
        scene.observe.emplace();
        for (const std::string& each : needed) scene.observe->push_back({each, name(each), {}});
    }
    const std::size_t asked = scene.observe->size();
    if (form_named(scene.form).steps)
        for (const Symbol& symbol : model.groupoid->next) needed.push_back(symbol.name);
    for (const std::string& each : needed)
        if (std::ranges::find(*scene.observe, each, &NamedTree::name) == scene.observe->end())
            scene.observe->push_back({each, name(each), {}});
    return asked;
}

Scene image_scene(const SceneRun& source, const Table& rows, const Model& target, Projection& projection)
{
    const std::string& form = source.form();
    Scene scene;
    scene.name = source.scene().name;
    scene.form = form;
    scene.method = source.method().name;
    scene.relative = number_of(*source.input().relative);
    scene.absolute = number_of(*source.input().absolute);
    take_times(source, rows, scene);
    scene.parameters = trees_of(projection.known_parameters());
    if (const auto& step = source.values().step) scene.step = step_of(target, scene, number_of(*step));
    projection.set_parameters(SceneEvaluator(target, scene).parameters({}));

    const Values state = lanes_by_name(source);
    scene.initial = trees_of(projection.base(state));
    std::vector<NamedNumber> rest;
    if (source.input().from_arrow)
        start_from_arrow(source, target, projection, state, scene);
    else if (form_named(form).momenta)
        rest = projection.momenta(state, momenta_of(source));
    else
        rest = projection.fibre(state);
    for (NamedTree& each : trees_of(rest)) scene.initial.push_back(std::move(each));
    return in_form(target, std::move(scene), form);
}

} // namespace lagen
