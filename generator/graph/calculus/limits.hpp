// SPDX-License-Identifier: GPL-2.0-or-later
/// Derivatives where a function has one and the chain rule says 0/0 or 0 inf: of v |v|, v sqrt(v^2 + w^2),
/// (x^2 + y^2)^(3/2), |x|^p, (x^4 + y^4)^(1/2) at 0, and of sqrt(max(0, f)) where f < 0.
/// Roots and moduli have no derivative at some of their zeros, but |v - v0| <= C h^q there, q <= 1. Where u vanishes,
/// |u| <= C h^p (p = 1 of what has a derivative), and p + q > 1, the product has the derivative u' v at this point: the
/// other term u v' of the rule is 0 there, and is written select(u == 0, 0, u v'). With p + q <= 1 nothing is known,
/// and the term stays as it is. Divisors are not 0 where a function is defined: a root among them needs no such term.
#pragma once

#include "graph/core/graph.hpp"

#include <optional>

namespace lagen {

/// directional() and jacobian() of graph/calculus/differentiate.hpp with these limits: the same nodes for functions
/// without such products. Inputs in `moving` move as those with a seed do.
[[nodiscard]] std::vector<NodeId> directional_with_limits(Graph& graph, std::span<const NodeId> outputs,
                                                          std::span<const std::pair<NodeId, NodeId>> seeds,
                                                          std::span<const NodeId> moving = {});
[[nodiscard]] std::vector<std::vector<NodeId>> jacobian_with_limits(Graph& graph, std::span<const NodeId> outputs,
                                                                    std::span<const NodeId> inputs);

/// What is known of nodes near their zeros.
class Limits {
  public:
    /// `active` by node: it moves with what is differentiated by.
    Limits(Graph& graph, std::span<const NodeId> outputs, const std::vector<NodeId>& nodes,
           const std::vector<bool>& active);

    /// The contribution of the operator table, with its limit.
    NodeId contribution(NodeId node, std::size_t k, NodeId tangent);

  private:
    void find_divisors(std::span<const NodeId> outputs, const std::vector<NodeId>& nodes);
    [[nodiscard]] std::optional<Rational> order_of(NodeId node) const;
    [[nodiscard]] Rational exponent_of(NodeId node) const;
    [[nodiscard]] Rational own_exponent(NodeId node) const;
    [[nodiscard]] bool is_flat_root(NodeId node) const;
    [[nodiscard]] bool is_rough(NodeId node) const { return exponents_[node] <= 1; }
    [[nodiscard]] bool needs_limit(NodeId node, std::size_t k) const;
    [[nodiscard]] std::optional<NodeId> flat_where(NodeId node, int depth);
    NodeId where_not_zero(NodeId outer, NodeId value);

    Graph& graph_;
    const std::vector<bool>& active_;
    std::vector<bool> divides_;                   ///< by node: it is not 0 where the outputs are defined
    std::vector<std::optional<Rational>> orders_; ///< by node that is seen to be >= 0: the order of its zeros; 0: none
    std::vector<Rational> exponents_;             ///< by node: q where it has no derivative, above 1: it has one
};

} // namespace lagen
