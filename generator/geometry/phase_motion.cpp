// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/phase_motion.hpp"

#include "geometry/fibre_hessian.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Replacements = std::vector<std::pair<NodeId, NodeId>>;

/// The rates that follow from H, y and Q, where H may contain controls: they are held fixed, since dH/du vanishes.
void add_rates(Graph& graph, const LoweredAlgebroid& algebroid, PhaseSystem& system, const std::vector<NodeId>& forces,
               std::optional<NodeId> time)
{
    const MomentumBalance balance{graph.negate(system.hamiltonian), system.mu, system.y, forces};
    system.xdot = base_velocity(graph, algebroid, system.y);
    BaseGradient partial(graph, algebroid.x);
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        system.mudot.push_back(momentum_rate(graph, algebroid, balance, partial, a));
    system.energy_rate = energy_rate(graph, algebroid, balance, time);
}

NodeId contraction(Graph& graph, const std::vector<NodeId>& mu, const std::vector<NodeId>& y)
{
    std::vector<NodeId> terms;
    for (std::size_t a = 0; a < mu.size(); ++a) terms.push_back(graph.multiply(mu[a], y[a]));
    return graph.sum(terms);
}

/// u = -(d2H/du2)^-1 dH/du(u = 0) by Cramer's rule, a block of coupled controls at a time; nothing, with the reason,
/// where the controls are not found in this way.
Replacements controls_on_extremals(Graph& graph, NodeId hamiltonian, const ControlNodes& control, std::string& obstacle)
{
    const FibreHessian hessian = fibre_hessian(graph, hamiltonian, control.u);
    if (control.bounded()) {
        obstacle = "the controls are bounded, so that they are no smooth functions of x and mu";
        return {};
    }
    if (depends_on_any(graph, hessian.hessian, control.u)) {
        obstacle = "dH/du is not affine in the controls, which are not solved for then";
        return {};
    }
    Replacements zero;
    for (const NodeId u : control.u) zero.emplace_back(u, graph.constant(0));
    const std::vector<NodeId> gradient = substitute(graph, hessian.momenta, zero);
    Replacements found;
    for (const std::vector<std::size_t>& block : hessian.blocks) {
        const NodeId determinant =
            block.size() > determinant_limit ? graph.constant(0) : minor_determinant(graph, hessian, block, block);
        if (graph.is_zero(determinant)) {
            obstacle = block.size() > determinant_limit
                           ? "d2H/du2 couples " + std::to_string(block.size()) + " controls, more than the " +
                                 std::to_string(determinant_limit) + " that are solved for exactly"
                           : "d2H/du2 is singular, so that dH/du = 0 does not determine the controls";
            return {};
        }
        std::vector<NodeId> right;
        for (const std::size_t k : block) right.push_back(graph.negate(gradient[k]));
        for (std::size_t k = 0; k < block.size(); ++k)
            found.emplace_back(control.u[block[k]],
                               graph.divide(minor_determinant(graph, hessian, block, block, k, right), determinant));
    }
    return found;
}

} // namespace

bool ControlNodes::bounded() const
{
    const auto given = [](const std::optional<NodeId>& bound) { return bound.has_value(); };
    return std::ranges::any_of(lower, given) || std::ranges::any_of(upper, given);
}

NodeId control_hamiltonian(Graph& graph, const ControlNodes& control, const std::vector<NodeId>& mu)
{
    return graph.subtract(contraction(graph, mu, control.sigma), control.cost);
}

PhaseSystem hamilton_system(Graph& graph, const LoweredAlgebroid& algebroid, NodeId hamiltonian,
                            const std::vector<NodeId>& mu, const std::vector<NodeId>& forces,
                            std::optional<NodeId> time)
{
    PhaseSystem system;
    system.hamiltonian = hamiltonian;
    system.mu = mu;
    system.y = gradient(graph, hamiltonian, mu);
    system.lagrangian = graph.subtract(contraction(graph, mu, system.y), hamiltonian);
    Replacements velocities;
    for (std::size_t a = 0; a < mu.size(); ++a) velocities.emplace_back(algebroid.y[a], system.y[a]);
    add_rates(graph, algebroid, system, substitute(graph, forces, velocities), time);
    return system;
}

PhaseSystem pontryagin_system(Graph& graph, const LoweredAlgebroid& algebroid, const ControlNodes& control,
                              const std::vector<NodeId>& mu, std::optional<NodeId> time)
{
    PhaseSystem system;
    system.mu = mu;
    system.y = control.sigma;
    system.lagrangian = control.cost;
    system.hamiltonian = control_hamiltonian(graph, control, mu);
    system.found = controls_on_extremals(graph, system.hamiltonian, control, system.obstacle);
    if (system.found.empty()) system.open = control.u;
    add_rates(graph, algebroid, system, std::vector<NodeId>(mu.size(), graph.constant(0)), time);
    for (std::vector<NodeId>* nodes : {&system.y, &system.xdot, &system.mudot})
        *nodes = substitute(graph, *nodes, system.found);
    for (NodeId* node : {&system.hamiltonian, &system.lagrangian, &system.energy_rate}) {
        const NodeId nodes[] = {*node};
        *node = substitute(graph, nodes, system.found)[0];
    }
    return system;
}

PhaseMotion::PhaseMotion(Graph& graph, const LoweredAlgebroid& algebroid, PhaseSystem system,
                         std::optional<NodeId> time)
    : graph_(graph), algebroid_(algebroid), system_(std::move(system)), time_(time),
      energy_name_(graph.input("energy of H"))
{
}

Binding PhaseMotion::names(const Model& model) const
{
    Binding binding;
    for (std::size_t a = 0; a < system_.mu.size(); ++a) {
        binding.emplace(model.fibre.coordinates[a].name, system_.y[a]);
        binding.emplace(model.fibre.momenta[a].name, system_.mu[a]);
    }
    for (const auto& [control, value] : system_.found) binding.emplace(graph_.input_name(control), value);
    bind_undeclared(binding, model, "energy", energy_name_);
    bind_undeclared(binding, model, "hamiltonian", energy_name_);
    bind_undeclared(binding, model, "lagrangian", system_.lagrangian);
    return binding;
}

NodeId PhaseMotion::in_states(NodeId f)
{
    const NodeId nodes[] = {f};
    const Replacements replacements = {{energy_name_, system_.hamiltonian}};
    return substitute(graph_, nodes, replacements)[0];
}

bool PhaseMotion::has_open_control(NodeId f) const
{
    const NodeId nodes[] = {f};
    return depends_on_any(graph_, nodes, system_.open);
}

Rate PhaseMotion::rate(NodeId f)
{
    if (has_open_control(f)) return {{}, system_.obstacle, false};
    Replacements seeds = {{energy_name_, system_.energy_rate}};
    for (std::size_t i = 0; i < system_.xdot.size(); ++i) seeds.emplace_back(algebroid_.x[i], system_.xdot[i]);
    for (std::size_t a = 0; a < system_.mu.size(); ++a) seeds.emplace_back(system_.mu[a], system_.mudot[a]);
    if (time_) seeds.emplace_back(*time_, graph_.constant(1));
    const NodeId outputs[] = {f};
    const NodeId value = in_states(directional(graph_, outputs, seeds)[0]);
    if (has_open_control(value)) return {value, system_.obstacle, true};
    return {value, {}, false};
}

} // namespace lagen
