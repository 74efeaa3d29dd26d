// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor coefficients of functions along a curve, one order after another. With x(t + h) = sum_k x_k h^k, a
/// coefficient of order k >= 1 of any node is
///   linear in the coefficients of order k of its operands, as a derivative is, plus
///   sums over lower orders   <a, b>_k = sum_{j=1}^{k-1} a_j b_{k-j}   of pairs of series,
/// so that a recurrence is one straight piece of code a coefficient, and all sums of an order can be made at once,
/// before it. With the series of h a', whose coefficients are k a_k, written a*:
///   a b          a_0 b_k + a_k b_0 + <a, b>_k
///   q = a/b      (a_k - q_0 b_k - <b, q>_k) / b_0
///   f = sqrt(a)  (a_k - <f, f>_k) / (2 f_0)
///   p = a^n      (n p_0 a_k + (n + 1)/k <a*, p>_k - <a, p>_k) / a_0     from p' a = n a' p; natural n: products
///   f = log(a)   (a_k - <f*, a>_k / k) / a_0
///   f(a)         g_0 a_k + <a*, g>_k / k                                from f' = g a', g = df/da of the table
///   A z = b      A_0 z_k = b_k - sum_l (A_l,k z_l + <A_l, z_l>_k)       by the factorisation of A_0
///   F(z, x) = 0  z_k = -F_z^-1 F_k, where F_k is the coefficient of F with z_k = 0
/// [Jorba-Zou 2005, section 2; Griewank-Walther 2008, chapter 13]. Static factors are drawn out of the pairs, and what
/// depends on none of the curve's coordinates has no series.
#pragma once

#include "graph/unknowns/implicit.hpp"

#include <array>

namespace lagen {

/// Everything is a node of one graph: values of order 0 are the nodes of the functions themselves.
struct TaylorRecurrence {
    NodeId order = 0;                         ///< input: k
    std::vector<NodeId> curve;                ///< inputs: the coefficients of order k of the coordinates of the curve
    std::vector<NodeId> sums;                 ///< inputs, one a pair: <a, b>_k, or <a, b>_k / k
    std::vector<bool> are_means;              ///< which of them are divided by k: where a or b is the series of h a'
    std::vector<std::array<NodeId, 2>> pairs; ///< a_k and b_k
    std::vector<NodeId> outputs;              ///< the coefficients of order k >= 1 of the functions
};

/// The same functions, where the factors of a product or quotient that do not move are one factor in front.
/// Coefficients of all orders then round the same constant: where they round it apart, the series is that of no
/// equation, and what a step loses of an invariant has the same sign in all of them. Two factors such as 6/5 and 10/11,
/// one after the other, have rounding errors that do not cancel either.
[[nodiscard]] std::vector<NodeId> with_joined_factors(Graph& graph, std::span<const NodeId> functions,
                                                      std::span<const NodeId> moving);

/// Throws MathematicsError where a function has kinks or steps along the curve: a series is that of one branch, and a
/// step of many periods may cross to another and back unseen.
void require_analytic(const Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> coordinates,
                      std::span<const ImplicitBlock> blocks);

/// Of `functions` along a curve in the inputs `coordinates` (time among them); unknowns of `blocks` are functions of
/// them. Throws MathematicsError, which names the operation, where one has no such rule.
[[nodiscard]] TaylorRecurrence taylor_recurrence(Graph& graph, std::span<const NodeId> functions,
                                                 std::span<const NodeId> coordinates,
                                                 std::span<const ImplicitBlock> blocks);

} // namespace lagen
