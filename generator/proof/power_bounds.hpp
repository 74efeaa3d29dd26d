// SPDX-License-Identifier: GPL-2.0-or-later
/// Bounds |a| <= C u^p of nodes by another one u >= 0, in a box: of x^2 + y^2 >= 0 the parts x, y have p = 1/2, a
/// product has the sum of its factors' powers, a sum the least of its terms'.
#pragma once

#include "proof/enclosure.hpp"

#include <functional>

namespace lagen::proof {

/// An upper bound of |x| as a number.
[[nodiscard]] Ball size_of(const Ball& x);
[[nodiscard]] bool is_exactly_zero(const Ball& x);
[[nodiscard]] Ball times(const Ball& a, const Ball& b, slong bits);
/// size^e, e >= 0.
[[nodiscard]] Ball raised(const Ball& size, const Rational& e, slong bits);
/// q of u^q; nothing where it is no number, and of what is no root or real power.
[[nodiscard]] std::optional<Rational> exponent_of(const Graph& graph, NodeId node);

struct PowerBound {
    Ball C;
    Rational p;
};

class PowerBounds {
  public:
    /// `value`: of a node in the box. Keeps the graph.
    PowerBounds(const Graph& graph, std::function<const Ball&(NodeId)> value, slong bits)
        : graph_(graph), value_(std::move(value)), bits_(bits)
    {
    }

    /// |node| <= C base^p, where that is seen.
    [[nodiscard]] std::optional<PowerBound> of(NodeId node, NodeId base);

  private:
    [[nodiscard]] std::optional<PowerBound> bound_of(NodeId node, NodeId base, int depth);
    [[nodiscard]] std::optional<PowerBound> by_parts(NodeId node, NodeId base, int depth);
    [[nodiscard]] std::optional<PowerBound> powered(std::optional<PowerBound> a, const Rational& q) const;
    void descend(std::map<NodeId, PowerBound>& known, NodeId node, const PowerBound& bound, int depth) const;

    const Graph& graph_;
    std::function<const Ball&(NodeId)> value_;
    slong bits_;
    std::map<NodeId, std::map<NodeId, PowerBound>> known_; ///< by base, then by part
    std::map<NodeId, std::map<NodeId, int>> unseen_;       ///< of those without a bound how deep it was looked for
};

} // namespace lagen::proof
