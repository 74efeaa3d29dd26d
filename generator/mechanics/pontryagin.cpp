// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/pontryagin.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {
namespace {

std::vector<NodeId> negated(Graph& graph, std::vector<NodeId> nodes)
{
    for (NodeId& node : nodes) node = graph.negate(node);
    return nodes;
}

/// u = W^-1 dH/du(u = 0) of one block of coupled controls, and the determinant that it divides by; nothing where that
/// is zero.
bool find_controls(Graph& graph, const ControlEquations& equations, const Places& block, PhaseSystem& phase)
{
    std::vector<NodeId> right;
    for (const std::size_t k : block) right.push_back((*equations.right)[k]);
    const CramersRule u = solve_block(graph, equations.negative, block, std::move(right));
    if (graph.is_zero(u.divisor)) return false;
    phase.divisors.push_back({u.divisor, "det(d2H/du2)"});
    for (std::size_t k = 0; k < block.size(); ++k) phase.found.emplace_back(equations.negative.y[block[k]], u(k));
    return true;
}

/// Finds the controls in `phase`, with the determinants, or says what the obstacle is.
void solve_controls(Graph& graph, const ControlProblem& control, const ControlHamiltonian& hamiltonian,
                    PhaseSystem& phase)
{
    if (control.bounded()) {
        phase.obstacle = "the controls are bounded, so that they are no smooth functions of x and mu";
        return;
    }
    const ControlEquations equations = control_equations(graph, hamiltonian);
    if (!equations.right) {
        phase.obstacle = "dH/du is not affine in the controls, which are not solved for then";
        return;
    }
    for (const NodeId divisor : equations.negative.divisors)
        phase.divisors.push_back({divisor, "a divisor of d2H/du2"});
    for (const std::vector<std::size_t>& block : equations.negative.blocks) {
        if (block.size() > determinant_limit)
            phase.obstacle = "d2H/du2 couples " + std::to_string(block.size()) + " controls, more than the " +
                             std::to_string(determinant_limit) + " that are solved for exactly";
        else if (!find_controls(graph, equations, block, phase))
            phase.obstacle = "d2H/du2 is singular, so that dH/du = 0 does not determine the controls";
        if (phase.obstacle.empty()) continue;
        phase.found.clear();
        return;
    }
}

} // namespace

ControlHamiltonian control_hamiltonian(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu)
{
    ControlHamiltonian result;
    result.value = graph.subtract(contraction(graph, mu, control.sigma), control.cost);
    result.negative = fibre_hessian(graph, result.value, control.u);
    result.dH_du = result.negative.momenta;
    result.negative.lagrangian = graph.negate(result.value);
    result.negative.momenta = negated(graph, std::move(result.negative.momenta));
    result.negative.hessian = negated(graph, std::move(result.negative.hessian));
    return result;
}

ControlEquations control_equations(Graph& graph, const ControlHamiltonian& hamiltonian)
{
    ControlEquations equations{hamiltonian.negative, {}};
    simplify_hessian(graph, equations.negative);
    equations.right = affine_offset(graph, equations.negative);
    if (equations.right) equations.right = negated(graph, *std::move(equations.right));
    return equations;
}

PhaseSystem pontryagin_system(Graph& graph, const System& system, NodeId hamiltonian, Replacements controls)
{
    const auto at_controls = [&](const std::vector<NodeId>& nodes) { return substitute(graph, nodes, controls); };
    const BaseSlopes slopes = base_slopes(graph, system, hamiltonian);
    const std::vector<NodeId> scalars = at_controls({hamiltonian, system.control->cost, slopes.t});
    MomentumBalance balance;
    balance.df_dx = negated(graph, at_controls(slopes.x));
    balance.df_dt = graph.negate(scalars[2]);
    balance.p = system.mu;
    balance.y = at_controls(system.control->sigma);
    balance.forces.assign(system.r(), graph.constant(0));
    PhaseSystem phase = phase_system(graph, system, balance, scalars[0], scalars[1]);
    phase.found = std::move(controls);
    return phase;
}

PhaseSystem solved_pontryagin_system(Graph& graph, const System& system)
{
    const ControlHamiltonian hamiltonian = control_hamiltonian(graph, *system.control, system.mu);
    PhaseSystem solved;
    solve_controls(graph, *system.control, hamiltonian, solved);
    PhaseSystem phase = pontryagin_system(graph, system, hamiltonian.value, std::move(solved.found));
    if (phase.found.empty()) phase.open = system.control->u;
    phase.divisors = std::move(solved.divisors);
    phase.obstacle = std::move(solved.obstacle);
    return phase;
}

} // namespace lagen
