// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/start_state.hpp"

#include "diagnostic.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "mechanics/hamilton.hpp"
#include "model/form.hpp"
#include "scene/values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// value(z) = target for unknown lanes z, where `value` is the slope of `function`.
struct Inversion {
    std::vector<NodeId> unknowns, values;
    NodeId function;
    const char* given; ///< for the message
    const char* wanted;
};

/// By Newton's method. Throws MathematicsError where the lanes are not shown to be unique, or not found.
std::vector<long double> invert(Graph& graph, const Regularity& regularity, const Inversion& inversion,
                                const std::vector<NamedNumber>& target, Values inputs)
{
    const auto fail = [&](const std::string& why) {
        throw MathematicsError(fmt::format("the {} of the start {}", inversion.given, why),
                               fmt::format("give the {} in `initial` instead", inversion.wanted));
    };
    const std::string& obstacle = regularity.legendre_obstacle;
    if (!obstacle.empty()) fail(fmt::format("are not shown to fix the {}: {}", inversion.wanted, obstacle));
    std::vector<NodeId> residuals;
    for (std::size_t a = 0; a < inversion.values.size(); ++a) {
        const NodeId wanted = graph.input("start of " + graph.input_name(inversion.unknowns[a]));
        inputs[graph.input_name(wanted)] = target[a].second;
        residuals.push_back(graph.subtract(inversion.values[a], wanted));
    }
    const ImplicitBlock block = gradient_block(graph, inversion.wanted, "", inversion.unknowns, residuals,
                                               inversion.function, regularity.newton_start);
    try {
        solve_unknowns<long double>(graph, {&block, 1}, inputs);
    } catch (const MathematicsError&) {
        fail(fmt::format("have no {} that Newton's method finds", inversion.wanted));
    }
    std::vector<long double> lanes;
    for (const NodeId unknown : inversion.unknowns) lanes.push_back(inputs.at(graph.input_name(unknown)));
    return lanes;
}

/// y with dL/dy = the given momenta.
std::vector<long double> velocities_of(const CheckedModel& checked, const SceneValues& values, const Values& inputs)
{
    const System& system = checked.system;
    Graph graph = system.graph;
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    return invert(graph, checked.report.mechanics.regularity,
                  {system.algebroid.y, lagrangian.fibre.momenta, *system.lagrangian, "momenta", "fibre coordinates"},
                  values.momenta, inputs);
}

/// mu = dL/dy at the given fibre coordinates, or mu with dH/dmu = them.
std::vector<long double> momenta_of(const CheckedModel& checked, const SceneValues& values, Values inputs)
{
    const System& system = checked.system;
    Graph graph = system.graph;
    if (!system.lagrangian)
        return invert(
            graph, checked.report.mechanics.regularity,
            {system.mu, given_hamiltonian(graph, system).y, *system.hamiltonian, "fibre coordinates", "momenta"},
            values.fibre, inputs);
    for (const auto& [name, value] : values.fibre) inputs[name] = value;
    if (values.fibre.empty()) return {};
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    std::vector<long double> momenta = evaluate<long double>(graph, lagrangian.fibre.momenta, inputs);
    if (!std::ranges::all_of(momenta, [](long double mu) { return std::isfinite(mu); }))
        throw MathematicsError("the momenta dL/dy of the start are no finite numbers",
                               "L is not defined, or not smooth, at the initial values");
    return momenta;
}

} // namespace

std::vector<long double> start_state(const std::function<const CheckedModel&()>& checked, const std::string& form,
                                     const SceneValues& values)
{
    Values inputs;
    std::vector<long double> state;
    for (const auto& [name, value] : values.parameters) inputs[name] = value;
    for (const auto& [name, value] : values.base) {
        inputs[name] = value;
        state.push_back(value);
    }
    inputs["t"] = values.start;
    const auto append = [&](const std::vector<long double>& lanes) {
        state.insert(state.end(), lanes.begin(), lanes.end());
        return state;
    };
    std::vector<long double> given;
    for (const auto& [name, value] : values.momenta.empty() ? values.fibre : values.momenta) given.push_back(value);
    const bool has_momenta = !values.momenta.empty();
    switch (form_named(form).kind) {
    case FormKind::lagrange: return append(has_momenta ? velocities_of(checked(), values, inputs) : given);
    case FormKind::hamilton:
        return append(has_momenta || given.empty() ? given : momenta_of(checked(), values, inputs));
    case FormKind::pontryagin:
        if (has_momenta || given.empty()) return append(given);
        throw InternalError("a scene in Pontryagin's form without momenta");
    }
    throw InternalError("a form without a start");
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
