// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/retraction.hpp"

#include "geometry/cayley.hpp"
#include "graph/calculus/differentiate.hpp"

namespace lagen {

namespace {

using Pairs = std::vector<std::pair<NodeId, NodeId>>;

void append_pairs(Pairs& pairs, const std::vector<NodeId>& inputs, std::span<const NodeId> nodes)
{
    for (std::size_t k = 0; k < inputs.size(); ++k) pairs.emplace_back(inputs[k], nodes[k]);
}

} // namespace

Retraction::Retraction(Graph& graph, const GroupoidParts& parts, const Exponential* exponential)
    : graph_(graph), parts_(parts), exponential_(exponential), span_(graph, parts)
{
    if (exponential == nullptr) return;
    Pairs seeds;
    for (const NodeId s : exponential->s) {
        rates_.push_back(graph.input("rate of " + graph.input_name(s)));
        seeds.emplace_back(s, rates_.back());
    }
    const std::vector<NodeId> back = one_and(graph, 1, exponential->inverse_less_one, parts.size);
    velocity_ =
        span_.components(matrix_product(graph, back, directional(graph, exponential->less_one, seeds), parts.size));
}

std::vector<NodeId> Retraction::element(std::span<const NodeId> xi)
{
    if (exponential_ == nullptr) return cayley(graph_, span_.matrix(xi), parts_.size);
    Pairs there;
    append_pairs(there, exponential_->s, xi);
    return one_and(graph_, 1, substitute(graph_, exponential_->less_one, there), parts_.size);
}

std::vector<NodeId> Retraction::body_velocity(std::span<const NodeId> xi, std::span<const NodeId> slope)
{
    if (exponential_ != nullptr) {
        Pairs there;
        append_pairs(there, exponential_->s, xi);
        append_pairs(there, rates_, slope);
        return substitute(graph_, velocity_, there);
    }
    const std::size_t n = parts_.size;
    const std::vector<NodeId> X = span_.matrix(xi);
    const std::vector<NodeId> left =
        matrix_quotient(graph_, one_and(graph_, Rational(1, 2), X, n), span_.matrix(slope), n);
    const std::vector<NodeId> right = one_and(graph_, Rational(-1, 2), X, n);
    return span_.components(transposed(matrix_quotient(graph_, transposed(right), transposed(left), n)));
}

std::vector<NodeId> Retraction::transposed(const std::vector<NodeId>& X) const
{
    const std::size_t n = parts_.size;
    std::vector<NodeId> out(X.size());
    for (std::size_t k = 0; k < X.size(); ++k) out[k] = X[k % n * n + k / n];
    return out;
}

} // namespace lagen
