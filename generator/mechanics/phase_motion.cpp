// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/phase_motion.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/fibre_hessian.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Replacements = std::vector<std::pair<NodeId, NodeId>>;

/// f = -H at fixed mu and u; y = sigma.
MomentumBalance pontryagin_balance(Graph& graph, const System& system, NodeId hamiltonian)
{
    BaseSlopes slopes = base_slopes(graph, system, graph.negate(hamiltonian));
    MomentumBalance balance;
    balance.df_dx = std::move(slopes.x);
    balance.df_dt = slopes.t;
    balance.p = system.mu;
    balance.y = system.control->sigma;
    balance.forces.assign(system.r(), graph.constant(0));
    return balance;
}

/// The rates that follow from H, y and Q, where H may contain controls: they are held fixed, since dH/du vanishes.
void add_rates(Graph& graph, const System& system, const MomentumBalance& balance, PhaseSystem& phase)
{
    phase.xdot = base_velocity(graph, system.algebroid, balance.y);
    phase.mudot = momentum_rates(graph, system.algebroid, balance);
    phase.energy_rate = energy_rate(graph, system.algebroid, balance);
}

/// u = -(d2H/du2)^-1 dH/du(u = 0) by Cramer's rule, a block of coupled controls at a time; nothing, with the reason,
/// where the controls are not found in this way.
Replacements controls_on_extremals(Graph& graph, const ControlProblem& control, PhaseSystem& phase)
{
    const FibreHessian hessian = fibre_hessian(graph, phase.hamiltonian, control.u);
    if (control.bounded()) {
        phase.obstacle = "the controls are bounded, so that they are no smooth functions of x and mu";
        return {};
    }
    if (depends_on_any(graph, hessian.hessian, control.u)) {
        phase.obstacle = "dH/du is not affine in the controls, which are not solved for then";
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
            phase.obstacle = block.size() > determinant_limit
                                 ? "d2H/du2 couples " + std::to_string(block.size()) + " controls, more than the " +
                                       std::to_string(determinant_limit) + " that are solved for exactly"
                                 : "d2H/du2 is singular, so that dH/du = 0 does not determine the controls";
            return {};
        }
        phase.divisors.push_back({determinant, "det(d2H/du2)"});
        std::vector<NodeId> right;
        for (const std::size_t k : block) right.push_back(graph.negate(gradient[k]));
        for (std::size_t k = 0; k < block.size(); ++k)
            found.emplace_back(control.u[block[k]],
                               graph.divide(minor_determinant(graph, hessian, block, block, k, right), determinant));
    }
    return found;
}

} // namespace

NodeId control_hamiltonian(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu)
{
    return graph.subtract(contraction(graph, mu, control.sigma), control.cost);
}

PhaseSystem hamilton_system(Graph& graph, const System& system)
{
    const HamiltonianNodes hamiltonian = given_hamiltonian(graph, system);
    PhaseSystem phase;
    phase.hamiltonian = hamiltonian.value;
    phase.lagrangian = hamiltonian.lagrangian;
    phase.mu = hamiltonian.mu;
    phase.y = hamiltonian.y;
    add_rates(graph, system, hamilton_balance(graph, system, hamiltonian), phase);
    return phase;
}

PhaseSystem pontryagin_system(Graph& graph, const System& system)
{
    const ControlProblem& control = *system.control;
    PhaseSystem phase;
    phase.mu = system.mu;
    phase.y = control.sigma;
    phase.lagrangian = control.cost;
    phase.hamiltonian = control_hamiltonian(graph, control, phase.mu);
    phase.found = controls_on_extremals(graph, control, phase);
    if (phase.found.empty()) phase.open = control.u;
    MomentumBalance balance = pontryagin_balance(graph, system, phase.hamiltonian);
    add_rates(graph, system, balance, phase);
    for (std::vector<NodeId>* nodes : {&phase.y, &phase.xdot, &phase.mudot})
        *nodes = substitute(graph, *nodes, phase.found);
    for (NodeId* node : {&phase.hamiltonian, &phase.lagrangian, &phase.energy_rate}) {
        const NodeId nodes[] = {*node};
        *node = substitute(graph, nodes, phase.found)[0];
    }
    return phase;
}

PhaseMotion::PhaseMotion(Graph& graph, const System& system, PhaseSystem phase)
    : graph_(graph), system_(system), phase_(std::move(phase)), energy_name_(graph.input("energy of H"))
{
}

Binding PhaseMotion::names() const
{
    Binding binding;
    for (std::size_t a = 0; a < phase_.mu.size(); ++a) {
        binding.emplace(graph_.input_name(system_.algebroid.y[a]), phase_.y[a]);
        binding.emplace(graph_.input_name(phase_.mu[a]), phase_.mu[a]);
    }
    for (const auto& [control, value] : phase_.found) binding.emplace(graph_.input_name(control), value);
    for (const auto& [name, node] :
         {std::pair("energy", energy_name_), {"hamiltonian", energy_name_}, {"lagrangian", phase_.lagrangian}})
        if (!system_.declares(name)) binding.emplace(name, node);
    return binding;
}

NodeId PhaseMotion::in_states(NodeId f)
{
    const NodeId nodes[] = {f};
    const Replacements replacements = {{energy_name_, phase_.hamiltonian}};
    return substitute(graph_, nodes, replacements)[0];
}

bool PhaseMotion::has_open_control(NodeId f) const
{
    const NodeId nodes[] = {f};
    return depends_on_any(graph_, nodes, phase_.open);
}

Rate PhaseMotion::rate(NodeId f)
{
    if (has_open_control(f)) return {{}, phase_.obstacle, false};
    Replacements seeds = {{energy_name_, phase_.energy_rate}};
    for (std::size_t i = 0; i < phase_.xdot.size(); ++i) seeds.emplace_back(system_.algebroid.x[i], phase_.xdot[i]);
    for (std::size_t a = 0; a < phase_.mu.size(); ++a) seeds.emplace_back(phase_.mu[a], phase_.mudot[a]);
    seeds.emplace_back(system_.time, graph_.constant(1));
    const NodeId outputs[] = {f};
    const NodeId value = in_states(directional(graph_, outputs, seeds)[0]);
    if (has_open_control(value)) return {value, phase_.obstacle, true};
    return {value, {}, false, phase_.divisors};
}

} // namespace lagen
