// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/lagrangian.hpp"

#include "graph/differentiate.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// W(a, b) for b <= a by a sweep along y^b, mirrored.
std::vector<NodeId> fibre_hessian_of(Graph& graph, const LagrangianNodes& nodes)
{
    const std::size_t r = nodes.y.size();
    std::vector<NodeId> W(r * r);
    for (std::size_t b = 0; b < r; ++b) {
        const std::pair<NodeId, NodeId> seed[] = {{nodes.y[b], graph.constant(1)}};
        const std::vector<NodeId> column = directional(graph, nodes.momentum, seed);
        for (std::size_t a = b; a < r; ++a) W[a * r + b] = W[b * r + a] = column[a];
    }
    return W;
}

} // namespace

LagrangianNodes lagrangian_nodes(Graph& graph, const Model& model, const SystemNodes& system)
{
    LagrangianNodes nodes;
    for (const Symbol& symbol : model.fibre.coordinates) nodes.y.push_back(graph.input(symbol.name));
    nodes.value = Lowering(graph)(model.lagrangian);
    Slopes slopes = slopes_of(graph, nodes.value, nodes.y, system);
    nodes.momentum = std::move(slopes.lanes);
    nodes.dL_dx = std::move(slopes.x);
    nodes.dL_dt = slopes.t;
    nodes.energy = graph.subtract(contraction(graph, nodes.y, nodes.momentum), nodes.value);
    nodes.W = fibre_hessian_of(graph, nodes);
    graph.remember_hessian(nodes.W, nodes.y, nodes.value);
    return nodes;
}

MatrixStructure mass_structure(const Regularity& regularity)
{
    return regularity.positive_definite && !regularity.for_given_parameters ? MatrixStructure::positive_definite
                                                                            : MatrixStructure::symmetric;
}

void require_regular_lagrangian(const Model& model, const Regularity& regularity, const char* form)
{
    if (!model.lagrangian)
        throw MathematicsError(fmt::format("error: model '{}' has no Lagrangian; the {} form needs [lagrangian] L{}",
                                           model.name, form,
                                           form == std::string("Hamiltonian") ? " or [hamiltonian] H" : ""));
    if (regularity.kind == Regularity::Kind::degenerate)
        throw MathematicsError(fmt::format(
            "error: the Lagrangian of model '{}' is degenerate: d2L/dy2 has rank {}, and the {} form "
            "needs rank {}\nhint: the velocities cannot be solved for; give every fibre coordinate a kinetic term",
            model.name, regularity.rank, form, model.fibre.coordinates.size()));
}

} // namespace lagen
