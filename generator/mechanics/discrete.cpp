// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/discrete.hpp"

#include "graph/calculus/differentiate.hpp"

#include <utility>

namespace lagen {

namespace {

/// X^k df/dz^k of the field X, by the slopes df/dz.
NodeId along_field(Graph& graph, const VectorField& field, const std::vector<NodeId>& slopes)
{
    std::vector<NodeId> terms;
    for (const ColumnEntry& entry : field)
        if (!graph.is_zero(slopes[entry.index])) terms.push_back(graph.multiply(entry.value, slopes[entry.index]));
    return graph.sum(terms);
}

/// D^-T of the slopes along xi to the momenta, and the conditions in their place.
void bind_logarithm(Graph& graph, const Groupoid& groupoid, const ArrowLogarithm& logarithm, ArrowEquations& equations)
{
    const std::size_t m = logarithm.conditions.size(), horizontal = groupoid.horizontal();
    std::vector<NodeId> turned(m * m), slopes(m);
    for (std::size_t k = 0; k < m * m; ++k) turned[k] = logarithm.differential[k % m * m + k / m];
    for (std::size_t c = 0; c < m; ++c) slopes[c] = std::exchange(equations.stationary[c], logarithm.conditions[c]);
    const std::vector<NodeId> p = graph.solve(turned, slopes, MatrixStructure::general);
    for (std::size_t c = 0; c < m; ++c) {
        NodeId& vertical = equations.momenta[horizontal + c];
        vertical = graph.add(vertical, p[c]);
        for (std::size_t i = 0; i < horizontal && !groupoid.connection.empty(); ++i)
            equations.momenta[i] =
                graph.subtract(equations.momenta[i], graph.multiply(groupoid.connection[i][c], p[c]));
    }
}

} // namespace

DiscreteLegendre discrete_legendre(Graph& graph, const Groupoid& groupoid, NodeId L)
{
    const std::vector<NodeId> slopes = gradient(graph, L, groupoid.coordinates());
    DiscreteLegendre legendre;
    for (const VectorField& field : groupoid.left) legendre.plus.push_back(along_field(graph, field, slopes));
    for (const VectorField& field : groupoid.right) legendre.minus.push_back(along_field(graph, field, slopes));
    return legendre;
}

std::vector<NodeId> discrete_euler_lagrange(Graph& graph, const Groupoid& groupoid, const DiscreteLegendre& legendre,
                                            const Arrow& g, const Arrow& h)
{
    const std::vector<NodeId> before = at(graph, groupoid, legendre.plus, g);
    const std::vector<NodeId> behind = at(graph, groupoid, legendre.minus, h);
    std::vector<NodeId> residual;
    for (std::size_t a = 0; a < before.size(); ++a) residual.push_back(graph.subtract(before[a], behind[a]));
    return residual;
}

std::vector<NodeId> newton_matrix(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& functions,
                                  const std::vector<NodeId>& inner)
{
    const std::vector<NodeId> coordinates = groupoid.coordinates();
    const std::size_t r = groupoid.r(), size = r + inner.size();
    std::vector<NodeId> N(size * size);
    for (std::size_t b = 0; b < size; ++b) {
        std::vector<std::pair<NodeId, NodeId>> seeds;
        if (b >= r) seeds.emplace_back(inner[b - r], graph.constant(1));
        for (std::size_t k = 0; b < r && k < groupoid.left[b].size(); ++k)
            seeds.emplace_back(coordinates[groupoid.left[b][k].index], groupoid.left[b][k].value);
        const std::vector<NodeId> column = directional(graph, functions, seeds);
        for (std::size_t a = 0; a < size; ++a) N[a * size + b] = column[a];
    }
    return N;
}

bool keeps_energy(const System& system)
{
    const DiscreteSystem& discrete = *system.discrete;
    if (!discrete.lagrangian || !discrete.work.source.empty()) return false;
    return !depends_on_any(system.graph, std::vector<NodeId>{*discrete.lagrangian}, std::vector<NodeId>{system.time});
}

ArrowEquations arrow_equations(Graph& graph, const System& system)
{
    const Groupoid& groupoid = *system.groupoid;
    const DiscreteSystem& discrete = *system.discrete;
    const NodeId L = *discrete.lagrangian;
    ArrowEquations equations{discrete_legendre(graph, groupoid, L).minus, gradient(graph, L, discrete.inner), {}};
    const DiscreteWork& work = discrete.work;
    for (std::size_t a = 0; a < work.source.size(); ++a)
        equations.momenta[a] = graph.subtract(equations.momenta[a], work.source[a]);
    for (std::size_t k = 0; k < work.inner.size(); ++k)
        equations.stationary[k] = graph.add(equations.stationary[k], work.inner[k]);
    if (discrete.logarithm) bind_logarithm(graph, groupoid, *discrete.logarithm, equations);
    std::vector<NodeId> solved = equations.momenta;
    solved.insert(solved.end(), equations.stationary.begin(), equations.stationary.end());
    equations.matrix = newton_matrix(graph, groupoid, solved, discrete.inner);
    return equations;
}

} // namespace lagen
