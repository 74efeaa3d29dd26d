// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/image_run.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/momentum_balance.hpp"
#include "mechanics/morphism.hpp"
#include "model/plain_names.hpp"
#include "model/scene_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lagen {

namespace {

constexpr double large = 1e-3;  ///< of the size of a column
constexpr double least = 1e-12; ///< of the largest column: a column that is smaller is 0 but for rounding

/// A row by the names of its columns.
Values row_values(const Table& table, std::size_t row)
{
    Values values;
    for (std::size_t k = 0; k < table.columns.size(); ++k) values[table.columns[k]] = table.row(row)[k];
    return values;
}

void join(ColumnDefect& defect, long double given, long double image, double time)
{
    double difference = static_cast<double>(std::fabs(given - image));
    if (!std::isfinite(difference)) difference = std::numeric_limits<double>::infinity();
    if (difference <= defect.max) return;
    defect.max = difference;
    defect.time = time;
}

/// When each column first was far off, once their sizes are known.
void find_moved(RunComparison& comparison)
{
    const std::size_t count = comparison.defects.size();
    double most = 0;
    for (const ColumnDefect& defect : comparison.defects) most = std::fmax(most, defect.size);
    for (std::size_t row = 0; row < comparison.table.count(); ++row) {
        const std::span<const double> values = comparison.table.row(row);
        for (std::size_t k = 0; k < count; ++k) {
            ColumnDefect& defect = comparison.defects[k];
            const double allowed = std::fmax(large * defect.size, least * most);
            if (defect.moved || std::fabs(values[k + 1] - values[count + k + 1]) <= allowed) continue;
            defect.moved = true;
            defect.moved_at = values[0];
        }
    }
}

/// The names of the column and of its image.
std::pair<std::string, std::string> headings(const ComparedColumn& column)
{
    switch (column.kind) {
    case ComparedColumn::Kind::projected: return {column.name, "projected_" + column.name};
    case ComparedColumn::Kind::pulled: return {column.name, "pulled_" + column.name};
    case ComparedColumn::Kind::lifted: break;
    }
    return {"source_" + column.name, "lifted_" + column.name};
}

/// Of the rows that both have. Both tables have t and all states, by their names.
RunComparison compare(const Projection& projection, const Table& source, const Table& target)
{
    const std::vector<ComparedColumn>& columns = projection.columns();
    RunComparison found;
    found.table.columns = {"t"};
    for (const ComparedColumn& column : columns) {
        found.table.columns.push_back(headings(column).first);
        found.defects.push_back({column.name, column.kind == ComparedColumn::Kind::lifted});
    }
    for (const ComparedColumn& column : columns) found.table.columns.push_back(headings(column).second);
    for (std::size_t row = 0; row < std::min(source.count(), target.count()); ++row) {
        const Values here = row_values(source, row), there = row_values(target, row);
        if (here.at("t") != there.at("t")) throw InternalError("the rows of the two sides have different times");
        const std::vector<long double> images = projection(here, there);
        std::vector<double> behind;
        found.table.numbers.push_back(static_cast<double>(here.at("t")));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const bool of_target = columns[k].kind == ComparedColumn::Kind::projected;
            const long double given = (of_target ? there : here).at(columns[k].name);
            ColumnDefect& defect = found.defects[k];
            join(defect, given, images[k], static_cast<double>(here.at("t")));
            for (const long double value : {given, images[k]})
                if (std::isfinite(value)) defect.size = std::fmax(defect.size, std::fabs(static_cast<double>(value)));
            found.table.numbers.push_back(static_cast<double>(given));
            behind.push_back(static_cast<double>(images[k]));
        }
        found.table.numbers.insert(found.table.numbers.end(), behind.begin(), behind.end());
    }
    find_moved(found);
    return found;
}

// Reconstruction: from a solution of the target of a morphism that is an isomorphism of fibres, and the start of the
// source, the motion of the source, x' = rho(x) Phi(x)^-1 y'(t).                              [Martinez 2001, Theorem
// 3]

struct LiftedTarget {
    Model model;                    ///< the target with the base coordinates of the source as first-order states
    std::vector<std::string> names; ///< of these states
};

/// lifted_x, under names that the target does not have.
std::vector<std::string> names_of_lifts(const SystemMorphism& map)
{
    std::vector<std::string> names;
    for (const NodeId x : map.source.algebroid.x) names.push_back("lifted_" + map.source.graph.input_name(x));
    names = plain_names(names);
    for (std::string& name : names)
        while (map.target.declares(name)) name += "_";
    return names;
}

/// Phi^-1 by Cramer's rule, of a map that is shown to be an isomorphism of fibres: then these have no more than
/// `determinant_limit` coordinates. `parameters` of the source are numbers in the rates.
LiftedTarget lifted_target(const Model& target, const SystemMorphism& map, const std::vector<NamedNumber>& parameters)
{
    LiftedTarget lifted{target, names_of_lifts(map)};
    Graph graph = map.source.graph;
    Replacements values;
    for (const auto& [name, value] : parameters)
        values.emplace_back(graph.input(name), graph.constant(Rational(static_cast<double>(value))));
    for (std::size_t i = 0; i < lifted.names.size(); ++i)
        values.emplace_back(map.source.algebroid.x[i], graph.input(lifted.names[i]));
    std::vector<NodeId> y; // stand-ins: names of the target may be others in the source
    for (const NodeId each : map.target.algebroid.y) {
        const std::string name = map.target.graph.input_name(each);
        y.push_back(graph.input(name + "'"));
        values.emplace_back(y.back(), graph.input(name));
    }
    const std::vector<NodeId> Phi = fibre_matrix(graph, map);
    const Places all = first_places(y.size());
    const std::vector<NodeId> velocity = CramersRule{graph, Phi, y.size(), all, all, y}.solution();
    const std::vector<NodeId> rates = substitute(graph, base_velocity(graph, map.source.algebroid, velocity), values);
    for (std::size_t i = 0; i < rates.size(); ++i) {
        FirstOrderState state;
        state.symbol.name = lifted.names[i];
        state.rate = to_tree(graph, rates[i]);
        lifted.model.states.push_back(std::move(state));
    }
    return lifted;
}

// The scene of the target that starts where a morphism puts the start of a scene of the source.

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

/// Times of `rows`, and method, step and tolerances of the run of the source. Gives the projection the parameters of
/// the target. Throws MathematicsError where the target has no equations of this form, and where momenta of the source
/// are not those of one start of the target.
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

/// Starts of the lifts are those of the source.
void add_lifts(const LiftedTarget& lifted, const SceneRun& source, Scene& image, Projection& projection)
{
    projection.add_lifts(lifted.names);
    for (std::size_t i = 0; i < lifted.names.size(); ++i) {
        const auto start = static_cast<double>(source.input().initial[i]);
        image.initial.push_back({lifted.names[i], number(Rational(start)), {}});
    }
}

/// The first `count` columns behind t.
Table first_columns(const Table& table, std::size_t count)
{
    Table part;
    part.columns.assign(table.columns.begin(), table.columns.begin() + static_cast<std::ptrdiff_t>(count + 1));
    for (std::size_t k = 0; k < table.count(); ++k) {
        const std::span<const double> row = table.row(k).first(count + 1);
        part.numbers.insert(part.numbers.end(), row.begin(), row.end());
    }
    return part;
}

/// A run with everything that can be compared, and without what nobody asked for.
struct WholeRun {
    RunOutcome outcome;
    Table whole;
};

WholeRun run_of(SceneRun& run, std::size_t asked, SecondRun second)
{
    WholeRun result{run.integrate(second), {}};
    result.whole = result.outcome.table;
    result.outcome.table = first_columns(result.whole, asked);
    return result;
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

ImageRun run_image(SceneRun& source, std::size_t asked, CheckedModel& target, SystemMorphism map, bool reconstruct,
                   SecondRun second)
{
    WholeRun here = run_of(source, asked, second);
    ImageRun runs{std::move(here.outcome), std::nullopt, {}};
    if (is_interrupted(runs.source) || here.whole.count() == 0) return runs;
    LiftedTarget lifted;
    if (reconstruct) {
        lifted = lifted_target(target.model, map, source.values().parameters);
        target.model = lifted.model;
    }
    Projection projection(std::move(map), source.form(), source.values());
    Scene image = image_scene(source, here.whole, target.model, projection);
    if (reconstruct) add_lifts(lifted, source, image, projection);
    const std::size_t states = observe_states(target.model, image);
    SceneRun other(target, std::move(image), source.method(), false);
    WholeRun there = run_of(other, states, second);
    runs.comparison = compare(projection, here.whole, there.whole);
    runs.target = std::move(there.outcome);
    return runs;
}

} // namespace lagen
