// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene_equilibria.hpp"

#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/lagrange.hpp"
#include "model/scene_form.hpp"
#include "scene/start_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

// The values of a scene as they are written: 1/10 and sqrt(2) are no doubles, and a verdict at a bifurcation depends
// on it. Where a number does not come of what is written alone (a start that is projected), the double is taken.

Tree value_in(const std::vector<NamedTree>& given, const std::string& name)
{
    const auto found = std::ranges::find(given, name, &NamedTree::name);
    return found == given.end() ? nullptr : found->value;
}

bool is_closed(const Graph& graph, NodeId node)
{
    const NodeId roots[] = {node};
    return std::ranges::none_of(reachable(graph, roots), [&](NodeId each) { return graph.op(each) == Op::input; });
}

/// The node where it has no inputs and is this number; else the double.
NodeId node_or_double(Graph& graph, NodeId node, long double value)
{
    if (is_closed(graph, node)) {
        const NodeId roots[] = {node};
        const long double there = evaluate<long double>(graph, roots, {})[0];
        if (std::abs(there - value) <= 1e-15L * std::abs(value)) return node;
    }
    return graph.constant(Rational(static_cast<double>(value)));
}

NodeId lowered(Graph& graph, const Tree& tree, const Replacements& parameters)
{
    const NodeId node[] = {Lowering(graph)(tree)};
    return substitute(graph, node, parameters)[0];
}

/// Gives the parameters the scene's values, `values` in numbers; the regularity is decided anew where it rests on them.
void put_exact_parameters(CheckedModel& checked, const Scene& scene, const std::vector<long double>& values)
{
    System& system = checked.system;
    if (!set_parameters(system, values)) return;
    for (std::size_t k = 0; k < values.size(); ++k) {
        auto& [parameter, value] = system.parameter_values[k];
        if (const Tree given = value_in(scene.parameters, system.graph.input_name(parameter)))
            value = node_or_double(system.graph, Lowering(system.graph)(given), values[k]);
    }
    if (rests_on_values(checked.report.mechanics.regularity))
        checked.report.mechanics.regularity = verify_regularity(system);
}

/// (x, mu) at the start as nodes without inputs; `state` is the same in numbers. `graph`: a copy of the system's.
std::vector<NodeId> exact_start(Graph& graph, const System& system, const Scene& scene,
                                const std::vector<long double>& state)
{
    const auto given = [&](NodeId input, NodeId absent) {
        const Tree tree = value_in(scene.initial, graph.input_name(input));
        return tree == nullptr ? absent : lowered(graph, tree, system.parameter_values);
    };
    std::vector<NodeId> start;
    Replacements at = system.parameter_values;
    for (std::size_t i = 0; i < system.n(); ++i) {
        const NodeId x = system.algebroid.x[i];
        start.push_back(node_or_double(graph, given(x, x), state[i]));
        at.emplace_back(x, start.back());
    }
    std::vector<NodeId> momenta = system.mu; // those of the velocities that the scene gives
    if (system.lagrangian) {
        const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
        for (const NodeId y : lagrangian.fibre.y) at.emplace_back(y, given(y, y));
        momenta = substitute(graph, lagrangian.fibre.momenta, at);
    }
    for (std::size_t a = 0; a < system.r(); ++a)
        start.push_back(node_or_double(graph, given(system.mu[a], momenta[a]), state[system.n() + a]));
    return start;
}

void require_free_motion(const Model& model, const Graph& graph, const System& system, const HamiltonianNodes& H)
{
    const NodeId only[] = {H.value};
    if (depends_on_any(graph, only, std::vector<NodeId>{system.time}) || !system.forces.empty())
        throw MathematicsError(fmt::format("relative equilibria are those of motions without forces and explicit time, "
                                           "and model '{}' has them",
                                           model.name));
}

/// y at an equilibrium.
std::vector<double> velocities_at(const Graph& graph, const System& system, const HamiltonianNodes& H,
                                  const RelativeEquilibria& all, const RelativeEquilibrium& found)
{
    std::map<std::string, double> inputs;
    for (const NodeId x : system.algebroid.x) inputs[graph.input_name(x)] = 0; // cyclic ones
    for (const auto& [parameter, value] : system.parameter_values)
        inputs[graph.input_name(parameter)] = graph.value(value).get_d();
    for (std::size_t k = 0; k < found.z.size(); ++k) inputs[graph.input_name(all.coordinates[k])] = found.z[k];
    return evaluate<double>(graph, H.y, inputs);
}

} // namespace

SceneEquilibria scene_equilibria(CheckedModel& checked, const Scene& given, std::size_t starts)
{
    const Model& model = checked.model;
    const Scene scene = in_form(model, given, "hamilton");
    const SceneValues values = evaluate_scene(model, scene);
    put_exact_parameters(checked, scene, finite_numbers(values.parameters, scene));
    const System& system = checked.system;
    Graph graph = system.graph;
    std::optional<HamiltonianNodes> H;
    const Regularity& regularity = checked.report.mechanics.regularity;
    if (system.hamiltonian || (system.lagrangian && regularity.kind != Regularity::Kind::degenerate))
        H = closed_hamiltonian(graph, system, regularity.newton_start);
    if (!H)
        throw MathematicsError(
            fmt::format("model '{}' has no Hamiltonian in closed form, whose critical points these are", model.name));
    require_free_motion(model, graph, system, *H);

    StartState to_momenta(checked, "hamilton");
    (void)to_momenta.prepare(!values.momenta.empty(), true);
    const std::vector<NodeId> start = exact_start(graph, system, scene, to_momenta(values));
    SceneEquilibria out;
    out.all = relative_equilibria(graph, system, *H, start, {.starts = starts});
    for (const NodeId each : out.all.coordinates) out.coordinates.push_back(graph.input_name(each));
    for (const NodeId each : out.all.cyclic) out.cyclic.push_back(graph.input_name(each));
    SymbolicModel symbolic(model, system.written.algebroid, {});
    for (const ConservedFunction& each : out.all.conserved)
        out.functions.push_back(to_text(symbolic.shortest(symbolic.lower(to_tree(graph, each.value)))));
    for (const RelativeEquilibrium& found : out.all.found)
        out.velocities.push_back(velocities_at(graph, system, *H, out.all, found));
    return out;
}

} // namespace lagen
