// SPDX-License-Identifier: GPL-2.0-or-later
/// Momenta, fibre Hessian, its coupled blocks and their minors.
#include "mechanics/fibre_hessian.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/simplify/simplify.hpp"
#include "mechanics/system.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// The classes of coordinates that entries of W couple.
std::vector<std::vector<std::size_t>> coupled_blocks(const Graph& graph, const FibreHessian& hessian)
{
    return connected_classes(hessian.y.size(),
                             [&](std::size_t a, std::size_t b) { return !graph.is_zero(hessian.W(a, b)); });
}

} // namespace

std::vector<NodeId> FibreHessian::submatrix(const std::vector<std::size_t>& rows) const
{
    std::vector<NodeId> entries;
    for (const std::size_t a : rows)
        for (const std::size_t b : rows) entries.push_back(W(a, b));
    return entries;
}

FibreHessian fibre_hessian(Graph& graph, NodeId lagrangian, const std::vector<NodeId>& y)
{
    FibreHessian result;
    result.lagrangian = lagrangian;
    result.y = y;
    result.momenta = gradient(graph, lagrangian, y);
    for (const std::vector<NodeId>& row : jacobian(graph, result.momenta, y))
        result.hessian.insert(result.hessian.end(), row.begin(), row.end());
    // The two orders of differentiation may leave different nodes; one of them stands for both.
    const std::size_t r = y.size();
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const bool zero = graph.is_zero(result.W(a, b)) || graph.is_zero(result.W(b, a));
            const NodeId entry = zero ? graph.constant(0) : result.W(a, b);
            result.hessian[a * r + b] = entry;
            result.hessian[b * r + a] = entry;
        }
    result.blocks = coupled_blocks(graph, result);
    return result;
}

void simplify_hessian(Graph& graph, FibreHessian& hessian)
{
    std::vector<NodeId> divisors;
    hessian.hessian = simplify(graph, hessian.hessian, divisors);
    hessian.divisors.insert(hessian.divisors.end(), divisors.begin(), divisors.end());
}

std::optional<std::vector<NodeId>> affine_offset(Graph& graph, FibreHessian& hessian)
{
    if (depends_on_any(graph, hessian.hessian, hessian.y)) simplify_hessian(graph, hessian);
    hessian.blocks = coupled_blocks(graph, hessian);
    if (depends_on_any(graph, hessian.hessian, hessian.y)) return std::nullopt;
    Replacements zeros;
    for (const NodeId y : hessian.y) zeros.emplace_back(y, graph.constant(0));
    return substitute_where_defined(graph, hessian.momenta, zeros);
}

NodeId block_determinant(Graph& graph, const FibreHessian& hessian, const Places& rows)
{
    return determinant_of(graph, hessian.hessian, hessian.y.size(), rows, rows);
}

CramersRule solve_block(Graph& graph, const FibreHessian& hessian, const Places& rows, std::vector<NodeId> b)
{
    return {graph, hessian.hessian, hessian.y.size(), rows, rows, std::move(b)};
}

} // namespace lagen
