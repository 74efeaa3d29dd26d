// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions on a graph with all their first derivatives, in balls: of functions that have one at every point, of |x|,
/// min and max between those of their branches, and of roots u^q, q < 1, at zeros of u >= 0, where
///   (u^q)' = q u^(q-1) u',      |u'| <= sqrt(2 M) u^(1/2),      M >= |u''|,
/// is no more than a number times u^-s. A factor a with |a| <= C u^p, as u = c a^2 + .. shows, makes that bounded where
/// p >= s: of v |v|, v_i sqrt(v_x^2 + v_y^2), x |x|^(1/5), (x^2 + y^2)^(3/4) at rest. Where these enclosures shrink
/// with the box around a point, the functions have continuous derivatives there. [Clarke 1983]
#pragma once

#include "proof/ball_matrix.hpp"
#include "proof/enclosure.hpp"

namespace lagen::proof {

class SlopedFunctions {
  public:
    /// Over the inputs z alone. The graph lives longer.
    SlopedFunctions(Graph& graph, std::vector<NodeId> functions, const std::vector<NodeId>& z);

    /// The functions, k x 1, and their slopes, k x n; not finite where nothing is known.
    [[nodiscard]] NewtonEquations at(const std::vector<Ball>& z, slong bits) const;

  private:
    friend class SlopeSweep;
    /// The derivative of a node by its operand.
    struct Part {
        NodeId operand, derivative;
    };

    Graph& graph_;
    std::vector<NodeId> functions_, z_;
    std::vector<NodeId> order_;            ///< what moves with z, ascending
    std::vector<std::vector<Part>> parts_; ///< by place in `order_`
    std::vector<NodeId> nodes_;            ///< whose values are needed
    std::vector<std::size_t> places_;      ///< by node: in `nodes_`
    std::optional<Evaluation> values_;
};

// Which term of some functions has no derivatives at a point, or none that are seen to be continuous there.

/// The first one behind sums, signs, numbers and linear systems whose value and slopes by `z`
/// (proof/sloped_functions.hpp) do not shrink with the box around `at`; nothing where all do. `exactly`: the point is
/// these numbers, and not only near them.
[[nodiscard]] std::optional<NodeId> rough_term(Graph& graph, const std::vector<NodeId>& functions,
                                               const std::vector<NodeId>& z, const std::vector<Ball>& at, bool exactly);

} // namespace lagen::proof
