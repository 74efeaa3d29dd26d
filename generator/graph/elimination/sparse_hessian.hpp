// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear systems W z = b with W = d2L/dy2 through the intermediate terms of a quadratic L. Where
///   L = sum H_uv u v / 2 + ...,   u = sum_w alpha_uw w   (w: other terms u, or entries of y),
/// the matrix W = J^T H J of a chain is full, but H and alpha hold O(n) entries, and z is the minimum of
/// u^T H u / 2 - b^T y. Terms are put in for their definitions, and entries of y eliminated, one at a time, from the
/// tips of the tree of definitions to its root, as in articulated-body algorithms [Featherstone 2008, chapter 7].
///
/// Why this needs no pivoting. Putting a definition in changes nothing but the names. An entry y^a is eliminated only
/// when no definition that is left contains it; then the terms that are left do not depend on it, and the coefficient
/// of (y^a)^2 is the pivot that L D L^T of W itself meets in the same order: a Schur complement of W, positive where W
/// is positive definite.
#pragma once

#include "graph/core/graph.hpp"

#include <optional>
#include <utility>

namespace lagen {

/// Variables are numbered: first those of the Hessian, in their order, then the terms, each after its operands.
struct SparseHessian {
    struct Entry {
        std::size_t row = 0;
        std::size_t column = 0; ///< row <= column; stands for both triangles
        NodeId value = 0;
    };
    using Terms = std::vector<std::pair<std::size_t, NodeId>>; ///< variable, coefficient

    std::size_t order = 0;          ///< how many variables come first
    std::vector<Terms> definitions; ///< by variable; empty for the first `order`
    std::vector<Entry> entries;     ///< H, each pair once
};

/// The second derivatives of `value` by `variables`; nothing where it is not a polynomial of degree 2 in them whose
/// products have two linear factors, written out.
[[nodiscard]] std::optional<SparseHessian> read_hessian(Graph& graph, NodeId value, std::span<const NodeId> variables);

/// A sequence of eliminations and what it computed.
struct Elimination {
    struct Step {
        std::size_t variable = 0;
        SparseHessian::Terms terms; ///< a term: its definition; else the multipliers of the neighbours
        NodeId pivot = 0;           ///< of an eliminated variable; positive where the matrix is positive definite
    };
    std::size_t order = 0;
    std::vector<bool> is_term; ///< by variable: put in for its definition, not eliminated
    std::vector<Step> steps;
};

/// Factorises W, next the variable that the fewest terms hide; nothing where a pivot is the constant 0, or where
/// that takes more than 500,000 nodes.
[[nodiscard]] std::optional<Elimination> eliminate(Graph& graph, const SparseHessian& hessian);

/// z with W z = right, both in the order of the variables.
[[nodiscard]] std::vector<NodeId> solve_by(Graph& graph, const Elimination& elimination, std::span<const NodeId> right);

} // namespace lagen
