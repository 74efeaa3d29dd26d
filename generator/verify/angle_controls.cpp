// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/angle_controls.hpp"

#include "graph/calculus/differentiate.hpp"
#include "verify/smooth_controls.hpp"

#include <algorithm>

namespace lagen {
namespace {

NodeId derivative(Graph& graph, NodeId f, NodeId u)
{
    const NodeId inputs[] = {u};
    return gradient(graph, f, inputs)[0];
}

/// Is u_k, for which dH/du_k is `slope`, an angle? H = a + b cos u_k + c sin u_k, where a, b and c are free of it, and
/// b and c, which are read off, hold no other control.
bool is_angle(Graph& graph, const ControlProblem& control, std::size_t k, NodeId slope,
              const std::vector<NodeId>& parts, const ProofSetting& setting, const ProofBudget& budget)
{
    if (control.lower[k] || control.upper[k]) return false;
    const NodeId second = derivative(graph, slope, control.u[k]);
    const NodeId third = derivative(graph, second, control.u[k]);
    if (graph.is_constant(third)) return false; // a polynomial in u
    // The other controls are as any state.
    const ControlProblem alone{{control.u[k]}, control.sigma, control.cost, {std::nullopt}, {std::nullopt}, {}};
    ControlProofs proofs(graph, alone, setting, budget);
    if (!proofs.zero(graph.add(third, slope)) || proofs.zero(second) || !proofs.partial_in(parts).empty()) return false;
    const AngleTerms terms = angle_terms(graph, slope, control.u[k]);
    const NodeId both[] = {terms.b, terms.c};
    return !depends_on_any(graph, both, control.u);
}

} // namespace

std::vector<std::size_t> find_angles(Graph& graph, const ControlProblem& control, const ControlHamiltonian& hamiltonian,
                                     const std::vector<NodeId>& parts, const ProofSetting& setting,
                                     const ProofBudget& budget)
{
    std::vector<std::size_t> angles;
    for (std::size_t k = 0; k < control.u.size(); ++k)
        if (is_angle(graph, control, k, hamiltonian.dH_du[k], parts, setting, budget)) angles.push_back(k);
    return angles;
}

AngleTerms angle_terms(Graph& graph, NodeId slope, NodeId u)
{
    const NodeId both[] = {graph.negate(derivative(graph, slope, u)), slope};
    const std::pair<NodeId, NodeId> zero[] = {{u, graph.constant(0)}};
    const std::vector<NodeId> terms = substitute(graph, both, zero);
    return {terms[0], terms[1]};
}

std::vector<std::size_t> other_controls(std::size_t count, const std::vector<std::size_t>& angles)
{
    std::vector<std::size_t> others;
    for (std::size_t k = 0; k < count; ++k)
        if (!std::ranges::binary_search(angles, k)) others.push_back(k);
    return others;
}

ControlProblem without_angles(Graph& graph, const ControlProblem& control, const std::vector<std::size_t>& angles)
{
    Replacements zeros;
    for (const std::size_t k : angles) zeros.emplace_back(control.u[k], graph.constant(0));
    ControlProblem rest;
    for (const std::size_t k : other_controls(control.u.size(), angles)) {
        rest.u.push_back(control.u[k]);
        rest.lower.push_back(control.lower[k]);
        rest.upper.push_back(control.upper[k]);
    }
    const NodeId cost[] = {control.cost};
    rest.sigma = substitute(graph, control.sigma, zeros);
    rest.cost = substitute(graph, cost, zeros)[0];
    rest.parts = substitute(graph, control.parts, zeros);
    return rest;
}

} // namespace lagen
