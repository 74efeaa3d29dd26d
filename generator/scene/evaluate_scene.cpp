// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees of a scene to numbers, and the conditions on a start.
#include "scene/evaluate_scene.hpp"

#include "model/dependency_order.hpp"
#include "scene/project_start.hpp"
#include "scene/values.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace lagen {

namespace {

constexpr long double constraint_tolerance = 1e-10L;

long double finite(const Tree& tree, const Values& values, const std::string& what, const SourceRange& where)
{
    const long double value = value_of(tree, values);
    if (std::isfinite(value)) return value;
    throw ModelError(fmt::format("{} is {}, where a finite number is required", what, static_cast<double>(value)),
                     tree->where.file ? tree->where : where);
}

Values parameter_values(const Model& model, const Scene& scene)
{
    std::map<std::string, const NamedTree*> own;
    for (const NamedTree& entry : scene.parameters) own.emplace(entry.name, &entry);
    std::vector<NamedTree> trees;
    for (const Parameter& parameter : model.parameters) {
        const auto place = own.find(parameter.symbol.name);
        trees.push_back(place != own.end() ? *place->second
                                           : NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    Values values;
    for (const std::size_t k : dependency_order(trees, "parameters")) {
        const std::string what = fmt::format("the value of parameter '{}'", trees[k].name);
        values[trees[k].name] = finite(trees[k].value, values, what, trees[k].where);
    }
    return values;
}

std::optional<long double> optional_value(const Tree& tree, const Values& values, const char* key, const Scene& scene,
                                          bool positive)
{
    if (!tree) return std::nullopt;
    const std::string what = fmt::format("'{}' of scene '{}'", key, scene.name);
    const long double value = finite(tree, values, what, scene.where);
    if (positive && !(value > 0)) {
        throw ModelError(fmt::format("{} is {}, where a positive number is required", what, static_cast<double>(value)),
                         tree->where.file ? tree->where : scene.where);
    }
    return value;
}

void read_times(const Scene& scene, const Values& values, SceneValues& out)
{
    out.start = optional_value(scene.start, values, "start", scene, false).value_or(0);
    out.duration = optional_value(scene.duration, values, "duration", scene, false);
    out.step = optional_value(scene.step, values, "step", scene, true);
    const std::optional<long double> tolerance = optional_value(scene.tolerance, values, "tolerance", scene, true);
    out.relative = optional_value(scene.relative, values, "relative", scene, true);
    out.absolute = optional_value(scene.absolute, values, "absolute", scene, true);
    if (tolerance) out.relative = out.absolute = tolerance;
    out.interval = optional_value(scene.sampling.interval, values, "sample", scene, true);
    for (const Tree& time : scene.sampling.at) {
        out.at.push_back(finite(time, values, fmt::format("a time in 'at' of scene '{}'", scene.name), scene.where));
    }
}

/// The whole text of a comparison or constraint as the user wrote it, or printed where its place is unknown.
std::string written(const Tree& tree)
{
    const SourceRange& where = tree->where;
    const bool known = where.file && where.begin < where.end && where.end <= where.file->text.size();
    return known ? where.file->text.substr(where.begin, where.end - where.begin) : to_text(tree);
}

void require_constraints(const Model& model, const Scene& scene, Values& values)
{
    if (model.base.constraints.empty()) return;
    const ConstraintFunctions constraints(model);
    if (scene.project && !project_start(constraints, values)) {
        throw ModelError(
            fmt::format("the start of scene '{}' cannot be moved onto the constraints by Newton's method", scene.name),
            scene.where, "give a start that is nearer to them");
    }
    const std::vector<ConstraintValue> h = constraints.at(values);
    for (std::size_t k = 0; k < h.size(); ++k) {
        if (h[k].holds(constraint_tolerance)) continue;
        throw ModelError(
            fmt::format("the start of scene '{}' misses the constraint {} = 0: its left side is {:.6g}, where at most "
                        "{:.3g} is allowed",
                        scene.name, written(model.base.constraints[k]), static_cast<double>(h[k].value),
                        static_cast<double>(constraint_tolerance * h[k].scale)),
            scene.where, "correct the initial values, or let lagen move them: project = true");
    }
}

bool has_coordinate(const Model& model, const Tree& tree)
{
    const std::vector<std::string> names = names_in(tree);
    const auto stands = [&](const Symbol& each) { return std::ranges::find(names, each.name) != names.end(); };
    return std::ranges::any_of(model.base.coordinates, stands);
}

void require_domain(const Model& model, const Scene& scene, const Values& values)
{
    for (const Tree& condition : model.base.domain) {
        if (value_of(condition, values) == 1) continue;
        throw ModelError(
            fmt::format(
                "the start of scene '{}' lies outside the domain: {} is required, but the left side is {:.6g} and "
                "the right side {:.6g}",
                scene.name, written(condition), static_cast<double>(value_of(condition->arguments[0], values)),
                static_cast<double>(value_of(condition->arguments[1], values))),
            scene.where, has_coordinate(model, condition) ? "correct the initial values" : "correct the parameters");
    }
}

/// Of bounds over parameters.
void require_bounds(const Model& model, const Scene& scene, const Values& parameters)
{
    if (!model.control) return;
    for (const ControlBound& bound : model.control->bounds) {
        const std::string& name = model.control->controls[bound.control].name;
        const std::string what = fmt::format("a bound of '{}'", name);
        constexpr long double infinity = std::numeric_limits<long double>::infinity();
        const long double lower = bound.lower ? finite(bound.lower, parameters, what, bound.where) : -infinity;
        const long double upper = bound.upper ? finite(bound.upper, parameters, what, bound.where) : infinity;
        if (lower < upper) continue;
        throw ModelError(
            fmt::format("in scene '{}' the bounds of '{}' are {:.6g} and {:.6g}, where the first must be the smaller",
                        scene.name, name, static_cast<double>(lower), static_cast<double>(upper)),
            bound.where, "correct the parameters");
    }
}

std::vector<NamedNumber> pick(const std::vector<Symbol>& symbols, const Values& values)
{
    std::vector<NamedNumber> out;
    for (const Symbol& symbol : symbols) {
        const auto place = values.find(symbol.name);
        out.emplace_back(symbol.name, place == values.end() ? 0.0L : place->second);
    }
    return out;
}

} // namespace

SceneValues evaluate_scene(const Model& model, const Scene& scene)
{
    SceneValues out;
    const Values parameters = parameter_values(model, scene);
    for (const Parameter& parameter : model.parameters) {
        if (parameter.bound) continue;
        out.parameters.emplace_back(parameter.symbol.name, parameters.at(parameter.symbol.name));
    }
    read_times(scene, parameters, out);
    Values values = parameters;
    std::set<std::string> given;
    for (const NamedTree& entry : scene.initial) {
        const std::string what = fmt::format("the initial value of '{}'", entry.name);
        values[entry.name] = finite(entry.value, parameters, what, entry.where);
        given.insert(entry.name);
    }
    require_constraints(model, scene, values);
    require_domain(model, scene, values);
    require_bounds(model, scene, parameters);
    out.base = pick(model.base.coordinates, values);
    const auto is_given = [&](const Symbol& symbol) { return given.contains(symbol.name); };
    const Fibre& fibre = model.fibre;
    if (std::any_of(fibre.momenta.begin(), fibre.momenta.end(), is_given)) {
        out.momenta = pick(fibre.momenta, values);
    } else {
        out.fibre = pick(fibre.coordinates, values);
    }
    for (const NamedTree& casimir : model.base.casimirs) {
        out.casimirs.emplace_back(casimir.name, value_of(casimir.value, values));
    }
    return out;
}

} // namespace lagen
