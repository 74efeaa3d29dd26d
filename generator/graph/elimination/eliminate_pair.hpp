// SPDX-License-Identifier: GPL-2.0-or-later
/// A variable y that acts through two terms u_1 = g_1 + e_1 y, u_2 = g_2 + e_2 y only. The least value of u^T M u / 2
/// over y is
///   (det M / d) (e_2 g_1 - e_1 g_2)^2 / 2,   d = e^T M e,
/// one square (the identity of Lagrange), where M - M e e^T M / d has four entries, differences of what may be large.
/// The next such variable then meets M = H + (a / b) n n^T with
///   det M = det H + (a / b) n^T adj(H) n,   d = e^T H e + (a / b) (n^T e)^2,
/// sums in which a / b alone waits for b: a chain of pivots takes a division and an addition a link, and none of its
/// sums cancels where H is positive. The right-hand side of models/chain.toml takes a quarter less time with 8 links
/// and with 16; with 4, and in every other model of models/, it is the same.
#pragma once

#include "graph/elimination/sparse_hessian.hpp"

#include <array>
#include <map>
#include <optional>

namespace lagen {

/// numerator * reciprocal * (first u + second w)^2 / 2.
struct WeightedSquare {
    NodeId numerator = 0;
    NodeId reciprocal = 0; ///< 1/b
    NodeId first = 0;
    NodeId second = 0;
};

/// The square's weight times `value`, the reciprocal last: all else is ready before it.
[[nodiscard]] NodeId weigh(Graph& graph, const WeightedSquare& square, NodeId value);

/// ((uu, uw), (uw, ww)) + the square.
struct PairMatrix {
    NodeId uu = 0;
    NodeId uw = 0;
    NodeId ww = 0;
    std::optional<WeightedSquare> square;
};

struct PairPivot {
    NodeId value = 0;               ///< d = e^T M e
    std::array<NodeId, 2> pushes{}; ///< M e
    NodeId determinant = 0;         ///< of M
};

[[nodiscard]] PairPivot pivot_of(Graph& graph, const PairMatrix& matrix, NodeId e1, NodeId e2);

/// A term as a sum of variables that are left, with their coefficients, and slope * y.
struct LinearForm {
    using Sum = std::map<std::size_t, NodeId>; ///< coefficients, by variable
    Sum rest;
    NodeId slope = 0;
};

void add_to(Graph& graph, LinearForm::Sum& sum, std::size_t variable, NodeId coefficient);

/// By term, for terms that depend on y (users first): what their definitions come to.
[[nodiscard]] std::map<std::size_t, LinearForm> forms_of(Graph& graph, const SparseHessian& hessian,
                                                         const std::vector<std::size_t>& terms, std::size_t y);

} // namespace lagen
