// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/start_state.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "mechanics/hamilton.hpp"
#include "model/scene_form.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

[[noreturn]] void fail_start(const char* given, const char* wanted, const std::string& why)
{
    throw MathematicsError(fmt::format("the {} of the start {}", given, why),
                           fmt::format("give the {} in `initial` instead", wanted));
}

} // namespace

/// z with values(z) = what is given, where `values` are the slopes of `function`. Throws MathematicsError where z is
/// not shown to be unique.
StartState::Conversion StartState::inversion(Graph graph, const Regularity& regularity, std::vector<NodeId> unknowns,
                                             const std::vector<NodeId>& values, NodeId function, const char* given,
                                             const char* wanted)
{
    const std::string& obstacle = regularity.legendre_obstacle;
    if (!obstacle.empty()) fail_start(given, wanted, fmt::format("are not shown to fix the {}: {}", wanted, obstacle));
    std::vector<NodeId> residuals;
    std::vector<std::string> targets;
    for (std::size_t a = 0; a < values.size(); ++a) {
        targets.push_back("start of " + graph.input_name(unknowns[a]));
        residuals.push_back(graph.subtract(values[a], graph.input(targets[a])));
    }
    ImplicitBlock block = gradient_block(graph, wanted, "", unknowns, residuals, function, regularity.newton_start);
    return {std::move(graph), std::move(unknowns), std::move(block), std::move(targets), given, wanted};
}

/// y with dL/dy = the given momenta.
StartState::Conversion StartState::to_velocities(const CheckedModel& checked)
{
    const System& system = checked.system;
    Graph graph = system.graph;
    const FibreHessian fibre = lagrangian_nodes(graph, system).fibre;
    return inversion(std::move(graph), checked.report.mechanics.regularity, fibre.y, fibre.momenta, fibre.lagrangian,
                     "momenta", "fibre coordinates");
}

/// mu = dL/dy at the given fibre coordinates, or mu with dH/dmu = them.
StartState::Conversion StartState::to_momenta(const Checked& checked)
{
    const System& system = checked(false).system;
    Graph graph = system.graph;
    const char *given = "fibre coordinates", *wanted = "momenta";
    if (!system.lagrangian) {
        const std::vector<NodeId> velocities = given_hamiltonian(graph, system).y;
        const Regularity& known = checked(true).report.mechanics.regularity;
        return inversion(std::move(graph), known, system.mu, velocities, *system.hamiltonian, given, wanted);
    }
    std::vector<NodeId> momenta = lagrangian_nodes(graph, system).fibre.momenta;
    std::vector<std::string> targets;
    for (const NodeId y : system.velocities()) targets.push_back(graph.input_name(y));
    return {std::move(graph), std::move(momenta), std::nullopt, std::move(targets), given, wanted};
}

std::vector<long double> StartState::converted(const std::vector<NamedNumber>& given, Values inputs) const
{
    const Conversion& to = *conversion_;
    for (std::size_t a = 0; a < given.size(); ++a) inputs[to.targets[a]] = given[a].second;
    if (to.block) {
        try {
            solve_unknowns<long double>(to.graph, {&*to.block, 1}, inputs);
        } catch (const MathematicsError&) {
            fail_start(to.given, to.wanted, fmt::format("have no {} that Newton's method finds", to.wanted));
        }
    }
    std::vector<long double> lanes = evaluate<long double>(to.graph, to.lanes, inputs);
    if (!std::ranges::all_of(lanes, [](long double lane) { return std::isfinite(lane); }))
        throw MathematicsError("the momenta dL/dy of the start are no finite numbers",
                               "L is not defined, or not smooth, at the initial values");
    return lanes;
}

bool StartState::prepare(bool has_momenta, bool any)
{
    const EquationForm& form = form_named(form_);
    if (!any || has_momenta == form.momenta) return false;
    if (form.kind == FormKind::pontryagin) throw InternalError("a scene in Pontryagin's form without momenta");
    if (!conversion_) conversion_ = has_momenta ? to_velocities(checked_(true)) : to_momenta(checked_);
    return true;
}

/// x_next - x and W - 1 of the first arrow, zeros of the arrow 1; zeros of the inner unknowns.
std::vector<long double> StartState::arrow_lanes(const SceneValues& values) const
{
    const Groupoid& groupoid = *checked_(false).system.groupoid;
    const std::size_t inner = checked_(false).system.discrete->inner.size();
    std::vector<long double> lanes(groupoid.horizontal() + groupoid.arrow.W.size() + inner, 0);
    for (std::size_t i = 0; i < values.next.size(); ++i) lanes[i] = values.next[i].second - values.base[i].second;
    for (std::size_t k = 0; k < values.element.size(); ++k)
        lanes[groupoid.horizontal() + k] = values.element[k].second - (k % (groupoid.size + 1) == 0 ? 1 : 0);
    return lanes;
}

std::vector<long double> StartState::operator()(const SceneValues& values)
{
    std::vector<long double> state = of_motion(values);
    for (const auto& [name, value] : values.states) state.push_back(value);
    return state;
}

/// Base lanes and those of the form.
std::vector<long double> StartState::of_motion(const SceneValues& values)
{
    std::vector<long double> state;
    const auto append = [&](const std::vector<NamedNumber>& lanes) {
        for (const auto& [name, value] : lanes) state.push_back(value);
    };
    append(values.base);
    if (values.discrete) {
        const std::vector<long double> arrow = arrow_lanes(values);
        state.insert(state.end(), arrow.begin(), arrow.end());
    }
    if (starts_from_arrow(values)) { // whose momenta the program finds
        state.resize(state.size() + checked_(false).system.r(), 0);
        return state;
    }
    const bool has_momenta = !values.momenta.empty();
    const std::vector<NamedNumber>& given = has_momenta ? values.momenta : values.fibre;
    if (!prepare(has_momenta, !given.empty())) {
        append(given);
        return state;
    }
    Values inputs;
    for (const std::vector<NamedNumber>* group : {&values.parameters, &values.base})
        for (const auto& [name, value] : *group) inputs[name] = value;
    inputs["t"] = values.start;
    const std::vector<long double> lanes = converted(given, std::move(inputs));
    state.insert(state.end(), lanes.begin(), lanes.end());
    return state;
}

bool starts_from_arrow(const SceneValues& values)
{
    return !values.element.empty() || !values.next.empty();
}

std::vector<long double> finite_start(StartState& start, const SceneValues& values, const Scene& scene)
{
    for (const std::vector<NamedNumber>* group : {&values.base, &values.fibre, &values.momenta, &values.states})
        (void)finite_numbers(*group, scene);
    return start(values);
}

std::vector<long double> finite_numbers(const std::vector<NamedNumber>& named, const Scene& scene)
{
    std::vector<long double> values;
    for (const auto& [name, value] : named) {
        if (!std::isfinite(static_cast<double>(value)))
            throw ModelError(fmt::format("'{}' starts at {:.6g} in scene '{}', where at most 1.79769e+308 is possible",
                                         name, value, scene.name),
                             scene.where);
        values.push_back(value);
    }
    return values;
}

} // namespace lagen
