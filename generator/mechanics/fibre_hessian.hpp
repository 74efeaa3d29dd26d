// SPDX-License-Identifier: GPL-2.0-or-later
/// The Lagrangian with its momenta p_a = dL/dy^a and fibre Hessian W_ab = d2L/dy^a dy^b on the graph, W split into the
/// blocks of coupled fibre coordinates.
#pragma once

#include "geometry/algebroid.hpp"
#include "graph/calculus/determinant.hpp"

#include <optional>

namespace lagen {

struct FibreHessian {
    NodeId lagrangian;
    std::vector<NodeId> momenta;                  ///< p_a, shape (r)
    std::vector<NodeId> hessian;                  ///< W_ab, shape (r, r), by rows
    std::vector<std::vector<std::size_t>> blocks; ///< classes of coupled coordinates, each ascending
    std::vector<NodeId> y;                        ///< fibre coordinates, shape (r)
    std::vector<NodeId> divisors; ///< of a W that was simplified: where one of them is zero, d2L/dy2 is not defined as
                                  ///< it was written, and W may be

    [[nodiscard]] NodeId W(std::size_t a, std::size_t b) const { return hessian[a * momenta.size() + b]; }
    /// The entries of these rows and columns, by rows.
    [[nodiscard]] std::vector<NodeId> submatrix(const std::vector<std::size_t>& rows) const;
};

[[nodiscard]] FibreHessian fibre_hessian(Graph& graph, NodeId lagrangian, const std::vector<NodeId>& y);

/// Simplifies W, and notes what that divides by.
void simplify_hessian(Graph& graph, FibreHessian& hessian);

/// b of momenta p = W y + b that are affine in y, and defined at y = 0; else nothing. W is
/// simplified where it is not free of y as it is.
[[nodiscard]] std::optional<std::vector<NodeId>> affine_offset(Graph& graph, FibreHessian& hessian);

/// det of the block W(rows, rows).
[[nodiscard]] NodeId block_determinant(Graph& graph, const FibreHessian& hessian, const Places& rows);
/// z with W(rows, rows) z = b, b one entry a row; keeps references.
[[nodiscard]] CramersRule solve_block(Graph& graph, const FibreHessian& hessian, const Places& rows,
                                      std::vector<NodeId> b);

} // namespace lagen
