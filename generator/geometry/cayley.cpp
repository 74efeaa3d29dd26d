// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/cayley.hpp"

namespace lagen {

std::vector<NodeId> less_one(Graph& graph, std::vector<NodeId> W, std::size_t n)
{
    const std::vector<NodeId> one = matrix_one(graph, n);
    for (std::size_t k = 0; k < W.size(); ++k) W[k] = graph.subtract(W[k], one[k]);
    return W;
}

std::vector<NodeId> one_and(Graph& graph, const Rational& factor, const std::vector<NodeId>& X, std::size_t n)
{
    std::vector<NodeId> out = matrix_one(graph, n);
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = graph.add(out[k], graph.multiply(graph.constant(factor), X[k]));
    return out;
}

std::vector<NodeId> cayley(Graph& graph, const std::vector<NodeId>& A, std::size_t n)
{
    return matrix_quotient(graph, one_and(graph, Rational(-1, 2), A, n), one_and(graph, Rational(1, 2), A, n), n);
}

std::vector<NodeId> cayley_less_one(Graph& graph, const std::vector<NodeId>& A, std::size_t n)
{
    return matrix_quotient(graph, one_and(graph, Rational(-1, 2), A, n), A, n);
}

std::vector<NodeId> cayley_inverse(Graph& graph, const std::vector<NodeId>& V, std::size_t n)
{
    return matrix_quotient(graph, one_and(graph, Rational(1, 2), V, n), V, n);
}

} // namespace lagen
