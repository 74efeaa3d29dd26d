// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/inverse_dynamics.hpp"

#include "graph/calculus/differentiate.hpp"
#include "verify/fibre_rank.hpp"
#include "verify/proof_setting.hpp"

namespace lagen {

namespace {

/// df/du by rows, where it is square, free of u and has an inverse.
std::optional<std::vector<NodeId>> slope_by_inputs(Graph& graph, const System& system, const std::vector<NodeId>& force)
{
    const std::size_t r = force.size();
    if (r == 0 || system.inputs.size() != r) return std::nullopt;
    const std::vector<NodeId> slope = joined_rows(jacobian(graph, force, system.inputs));
    if (depends_on_any(graph, slope, system.inputs)) return std::nullopt;
    const auto decider = ZeroDecider::make(graph, proof_setting(graph, system));
    if (!decider || !fibre_rank(graph, slope, r, r, *decider).surjective) return std::nullopt;
    return slope;
}

} // namespace

void add_inverse_dynamics(Graph& graph, const System& system, const std::vector<NodeId>& mass_matrix,
                          const std::vector<NodeId>& force, Formulation& form)
{
    const std::optional<std::vector<NodeId>> slope = slope_by_inputs(graph, system, force);
    if (!slope) return;
    const std::size_t r = force.size();
    const std::vector<NodeId> zeros(r, graph.constant(0));
    std::vector<NodeId> right = substitute(graph, force, replacements(system.inputs, zeros));
    KernelInput rates{"ydot", ArrayRole::value, {1, r, 1}, {}};
    for (const NodeId lane : form.lanes) {
        const std::string& name = graph.input_name(lane);
        rates.entries.push_back({name + "_dot", {}, {}, graph.input("rate of " + name)});
    }
    for (std::size_t a = 0; a < r; ++a) {
        right[a] = graph.negate(right[a]);
        for (std::size_t b = 0; b < r; ++b)
            right[a] = graph.add(right[a], graph.multiply(mass_matrix[a * r + b], rates.entries[b].input));
    }
    Kernel kernel =
        table_kernel(form, "inverse_dynamics", column("out", graph.solve(*slope, right, MatrixStructure::general)));
    kernel.inputs = {std::move(rates)};
    kernel.checks->pivots = single_blocks(graph, *slope, r);
    kernel.checks->failures = "Answers singular_mass_matrix where dQ/du has no inverse at this state.";
    form.kernels.push_back(std::move(kernel));
}

} // namespace lagen
