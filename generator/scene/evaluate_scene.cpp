// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees of a scene to numbers, and the conditions on a start.
#include "scene/evaluate_scene.hpp"

#include "geometry/group_relations.hpp"
#include "model/families.hpp"
#include "model/scene_form.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace lagen {

namespace {

constexpr long double constraint_tolerance = 1e-10L;
constexpr long double largest_cayley = 1e7L; ///< of rotations to 4e-7 from a half turn
constexpr long double group_tolerance = 1e-10L;

/// The whole text of a comparison or constraint as the user wrote it, or printed where its place is unknown.
std::string written(const Tree& tree)
{
    const SourceRange& where = tree->where;
    const bool known = where.file && where.begin < where.end && where.end <= where.file->text.size();
    return known ? where.file->text.substr(where.begin, where.end - where.begin) : to_text(tree);
}

bool has_coordinate(const Model& model, const Tree& tree)
{
    return std::ranges::any_of(model.base.coordinates, [&](const Symbol& x) { return mentions(tree, x.name); });
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

SceneEvaluator::SceneEvaluator(const Model& model, const Scene& scene)
    : model_(model), scene_(scene), carried_(carried_states(model, form_of(model, scene), &scene))
{
    std::map<std::string, const NamedTree*> own;
    for (const NamedTree& entry : scene_.parameters) own.emplace(entry.name, &entry);
    std::vector<NamedTree> trees;
    for (const Parameter& parameter : model_.parameters) {
        const auto place = own.find(parameter.symbol.name);
        trees.push_back(place != own.end() ? *place->second
                                           : NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    for (const std::size_t k : dependency_order(trees, "parameters")) parameters_.push_back(std::move(trees[k]));
}

/// `what` with `name` in it calls the value in a message.
long double SceneEvaluator::finite(const Tree& tree, const Values& values, const char* what, const std::string& name,
                                   const SourceRange& where)
{
    const long double value = value_of_(tree, values);
    if (std::isfinite(value)) return value;
    throw StartError("non_finite",
                     fmt::format("{} is {}, where a finite number is required", fmt::format(fmt::runtime(what), name),
                                 static_cast<double>(value)),
                     tree->where.file ? tree->where : where);
}

/// The step that a discrete scene gives wins over the parameter of that name.
Values SceneEvaluator::parameter_values(const Values& given)
{
    Values values = values_in_order(given);
    if (!scene_.step || !is_form(form_of(model_, scene_), FormKind::discrete) || has_own_step(model_)) return values;
    Values with_step = given;
    with_step[model_.discrete->step.name] = *optional_value(scene_.step, values, "'step' of scene '{}'", true);
    return values_in_order(with_step);
}

Values SceneEvaluator::values_in_order(const Values& given)
{
    Values values;
    for (const NamedTree& parameter : parameters_) {
        const auto place = given.find(parameter.name);
        values[parameter.name] = place != given.end() ? place->second
                                                      : finite(parameter.value, values, "the value of parameter '{}'",
                                                               parameter.name, parameter.where);
    }
    return values;
}

/// `what` as for `finite`, of the scene.
std::optional<long double> SceneEvaluator::optional_value(const Tree& tree, const Values& values, const char* what,
                                                          bool positive)
{
    if (!tree) return std::nullopt;
    const long double value = finite(tree, values, what, scene_.name, scene_.where);
    if (positive && !(value > 0)) {
        throw StartError("invalid_input",
                         fmt::format("{} is {}, where a positive number is required",
                                     fmt::format(fmt::runtime(what), scene_.name), static_cast<double>(value)),
                         tree->where.file ? tree->where : scene_.where);
    }
    return value;
}

void SceneEvaluator::read_times(const Values& values, SceneValues& out)
{
    const auto number = [&](const Tree& tree, const char* what, bool positive) {
        return optional_value(tree, values, what, positive);
    };
    out.start = number(scene_.start, "'start' of scene '{}'", false).value_or(0);
    out.duration = number(scene_.duration, "'duration' of scene '{}'", false);
    out.step = number(scene_.step, "'step' of scene '{}'", true);
    const std::optional<long double> tolerance = number(scene_.tolerance, "'tolerance' of scene '{}'", true);
    out.relative = number(scene_.relative, "'relative' of scene '{}'", true);
    out.absolute = number(scene_.absolute, "'absolute' of scene '{}'", true);
    if (tolerance) out.relative = out.absolute = tolerance;
    out.interval = number(scene_.sampling.interval, "'sample' of scene '{}'", true);
    for (const Tree& time : scene_.sampling.at)
        out.at.push_back(finite(time, values, "a time in 'at' of scene '{}'", scene_.name, scene_.where));
}

void SceneEvaluator::require_constraints(Values& values)
{
    if (model_.base.constraints.empty()) return;
    if (!constraints_) constraints_.emplace(model_);
    if (scene_.project && !project_start(*constraints_, values)) {
        throw StartError(
            "off_constraint",
            fmt::format("the start of scene '{}' cannot be moved onto the constraints by Newton's method", scene_.name),
            scene_.where, "give a start that is nearer to them");
    }
    const std::vector<ConstraintValue> h = constraints_->at(values);
    for (std::size_t k = 0; k < h.size(); ++k) {
        if (h[k].holds(constraint_tolerance)) continue;
        throw StartError(
            "off_constraint",
            fmt::format("the start of scene '{}' misses the constraint {} = 0: its left side is {:.6g}, where at most "
                        "{:.3g} is allowed",
                        scene_.name, written(model_.base.constraints[k]), static_cast<double>(h[k].value),
                        static_cast<double>(constraint_tolerance * h[k].scale)),
            scene_.where, "correct the initial values, or let lagen move them: project = true");
    }
}

void SceneEvaluator::require_domain(const Values& values)
{
    for (const Tree& condition : model_.base.domain) {
        if (value_of_(condition, values) == 1) continue;
        throw StartError(
            "left_domain",
            fmt::format(
                "the start of scene '{}' lies outside the domain: {} is required, but the left side is {:.6g} and "
                "the right side {:.6g}",
                scene_.name, written(condition), static_cast<double>(value_of_(condition->arguments[0], values)),
                static_cast<double>(value_of_(condition->arguments[1], values))),
            scene_.where, has_coordinate(model_, condition) ? "correct the initial values" : "correct the parameters");
    }
}

/// Bounds over parameters must be in order.
void SceneEvaluator::require_bounds(const Values& parameters)
{
    if (!model_.control) return;
    for (const ControlBound& bound : model_.control->bounds) {
        const std::string& name = model_.control->controls[bound.control].name;
        const auto value = [&](const Tree& tree, long double none) {
            return tree ? finite(tree, parameters, "a bound of '{}'", name, bound.where) : none;
        };
        constexpr long double infinity = std::numeric_limits<long double>::infinity();
        const long double lower = value(bound.lower, -infinity), upper = value(bound.upper, infinity);
        if (lower < upper) continue;
        throw StartError(
            "invalid_input",
            fmt::format("in scene '{}' the bounds of '{}' are {:.6g} and {:.6g}, where the first must be the smaller",
                        scene_.name, name, static_cast<double>(lower), static_cast<double>(upper)),
            bound.where, "correct the parameters");
    }
}

/// The generators are not looked at where there is no element.
void SceneEvaluator::require_in_group(const Values& parameters, const std::vector<NamedNumber>& element)
{
    const GroupoidBlock& groupoid = *model_.groupoid;
    std::vector<RealMatrix> generators;
    for (const ArrayValue& matrix : groupoid.generators) {
        RealMatrix& numbers = generators.emplace_back();
        for (const Tree& entry : matrix.entries)
            numbers.push_back(finite(entry, parameters, "an entry of the generators{}", "", groupoid.group_where));
    }
    RealMatrix W;
    for (const NamedNumber& entry : element) W.push_back(entry.second);
    const std::size_t n = groupoid.generators[0].shape.rows;
    GroupDefect defect = group_defect(generators, W, n);
    if (defect.size <= group_tolerance && groupoid.group.empty()) defect = logarithm_defect(generators, W, n);
    if (!(defect.size <= group_tolerance))
        throw StartError(
            "off_constraint",
            fmt::format("the element of scene '{}' is not in the group{}: it misses {} by {:.3g}, where at most "
                        "{:.3g} is allowed",
                        scene_.name, groupoid.group.empty() ? "" : " " + groupoid.group, defect.relation,
                        static_cast<double>(defect.size), static_cast<double>(group_tolerance)),
            scene_.element_where, "for example element = \"exp(hat([..]))\" or \"cay(hat([..]))\"");
    if (!model_.discrete || model_.discrete->scheme.empty() || cayley_size(W, n) < largest_cayley) return;
    throw StartError(
        "branch_lost",
        fmt::format("the element of scene '{}' is a half turn, or nearly one: Cayley's map does not reach it, its "
                    "logarithm is not unique, and the scheme '{}' rests on one of both",
                    scene_.name, model_.discrete->scheme),
        scene_.element_where, "start from a shorter step, or from momenta in `initial`");
}

/// Reads the states that the scene carries, and matrices that start in their groups.
void SceneEvaluator::read_states(Values& values, SceneValues& out)
{
    for (const FirstOrderState& state : model_.states)
        values.try_emplace(state.symbol.name, static_cast<long double>(state.start));
    for (const std::size_t k : carried_)
        out.states.emplace_back(model_.states[k].symbol.name, values.at(model_.states[k].symbol.name));
    for (const Reconstruction& g : model_.reconstructions) {
        std::vector<RealMatrix> generators;
        for (const ArrayValue& matrix : g.generators) {
            RealMatrix& numbers = generators.emplace_back();
            for (const Tree& entry : matrix.entries) numbers.push_back(value_of_(entry, {}));
        }
        RealMatrix start;
        for (std::size_t k = 0; k < g.size * g.size; ++k)
            start.push_back(values.at(model_.states[g.first + k].symbol.name));
        const GroupDefect defect = group_defect(generators, start, g.size);
        if (defect.size <= group_tolerance) continue;
        throw StartError("off_constraint",
                         fmt::format("the start of '{}' in scene '{}' is not in the group {}: it misses {} by {:.3g}, "
                                     "where at most {:.3g} is allowed",
                                     g.name, scene_.name, g.group, defect.relation, static_cast<double>(defect.size),
                                     static_cast<double>(group_tolerance)),
                         scene_.where, "for example initial = { .., " + g.name + " = \"exp(hat([..]))\" }");
    }
}

void SceneEvaluator::read_arrow(const Values& parameters, SceneValues& out)
{
    for (std::size_t k = 0; k < scene_.element.size(); ++k)
        out.element.emplace_back(
            model_.groupoid->element[k].name,
            finite(scene_.element[k], parameters, "an entry of the element of scene '{}'", scene_.name, scene_.where));
    if (!out.element.empty()) require_in_group(parameters, out.element);
    Values target = parameters;
    for (const NamedTree& entry : scene_.next)
        target[entry.name] = finite(entry.value, parameters, "the next value of '{}'", entry.name, entry.where);
    if (scene_.next.empty()) return;
    require_domain(target);
    out.next = pick(model_.base.coordinates, target);
}

std::vector<NamedNumber> SceneEvaluator::parameters(const Values& given)
{
    return pick(free_parameters(model_), parameter_values(given));
}

/// The step of a discrete motion, by the scene or by the parameter of that name.
void SceneEvaluator::read_step(const Values& parameters, SceneValues& out)
{
    if (!is_form(form_of(model_, scene_), FormKind::discrete)) return;
    const std::string& name = model_.discrete->step.name;
    out.discrete = true;
    out.steps = scene_.steps;
    out.own_step = has_own_step(model_);
    if (!out.own_step) out.step = parameters.at(name);
    if (out.step && !(*out.step > 0))
        throw StartError("invalid_input",
                         fmt::format("the step '{}' of scene '{}' is {}, where a positive number is required", name,
                                     scene_.name, static_cast<double>(*out.step)),
                         scene_.step ? scene_.step->where : scene_.where);
}

SceneValues SceneEvaluator::operator()(const Values& given, const Values& initial)
{
    SceneValues out;
    const Values parameters = parameter_values(given);
    out.parameters = pick(free_parameters(model_), parameters);
    read_times(parameters, out);
    read_step(parameters, out);
    if (scene_.input_table)
        for (const Input& input : model_.inputs)
            out.inputs.emplace_back(input.symbol.name, finite(input.value, parameters, "the default of the input '{}'",
                                                              input.symbol.name, input.symbol.where));
    Values values = parameters;
    bool has_momenta = false;
    for (const NamedTree& entry : scene_.initial) {
        const auto place = initial.find(entry.name);
        values[entry.name] = place != initial.end() ? place->second
                                                    : finite(entry.value, parameters, "the initial value of '{}'",
                                                             entry.name, entry.where);
        const auto is_entry = [&](const Symbol& symbol) { return symbol.name == entry.name; };
        has_momenta = has_momenta || std::ranges::any_of(model_.fibre.momenta, is_entry);
    }
    require_constraints(values);
    require_domain(values);
    require_bounds(parameters);
    read_arrow(parameters, out);
    out.base = pick(model_.base.coordinates, values);
    if (has_momenta)
        out.momenta = pick(model_.fibre.momenta, values);
    else if (out.element.empty() && out.next.empty())
        out.fibre = pick(model_.fibre.coordinates, values);
    read_states(values, out);
    for (const NamedTree& casimir : model_.base.casimirs)
        out.casimirs.emplace_back(casimir.name, value_of_(casimir.value, values));
    return out;
}

SceneValues evaluate_scene(const Model& model, const Scene& scene)
{
    return SceneEvaluator(model, scene)({}, {});
}

} // namespace lagen
