// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/phase_motion.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

PhaseSystem phase_system(Graph& graph, const System& system, const MomentumBalance& balance, NodeId hamiltonian,
                         NodeId lagrangian)
{
    PhaseSystem phase;
    phase.hamiltonian = hamiltonian;
    phase.lagrangian = lagrangian;
    phase.mu = balance.p;
    phase.y = balance.y;
    phase.xdot = base_velocity(graph, system.algebroid, balance.y);
    phase.mudot = momentum_rates(graph, system.algebroid, balance);
    phase.energy_rate = energy_rate(graph, system.algebroid, balance);
    return phase;
}

Binding phase_names(const System& system, const PhaseSystem& phase, NodeId energy)
{
    Binding binding = phase.more;
    for (std::size_t a = 0; a < phase.mu.size(); ++a) {
        binding.emplace(system.graph.input_name(system.velocities()[a]), phase.y[a]);
        binding.emplace(system.graph.input_name(phase.mu[a]), phase.mu[a]);
    }
    for (const auto& [control, value] : phase.found) binding.emplace(system.graph.input_name(control), value);
    for (const auto& [name, node] :
         {std::pair("energy", energy), {"hamiltonian", energy}, {"lagrangian", phase.lagrangian}})
        if (!system.declares(name)) binding.emplace(name, node);
    return binding;
}

PhaseMotion::PhaseMotion(Graph& graph, const System& system, PhaseSystem phase)
    : graph_(graph), system_(system), phase_(std::move(phase)), energy_name_(graph.input("energy of H"))
{
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
    Lowering lower(graph_, names());
    for (std::size_t k = 0; k < system_.states.size(); ++k)
        seeds.emplace_back(system_.states[k], lower(system_.written.states[k].value));
    seeds.emplace_back(system_.time, graph_.constant(1));
    const NodeId outputs[] = {f};
    const NodeId value = in_states(directional(graph_, outputs, seeds)[0]);
    if (has_open_control(value)) return {value, phase_.obstacle, true};
    return {value, {}, false, phase_.divisors};
}

} // namespace lagen
