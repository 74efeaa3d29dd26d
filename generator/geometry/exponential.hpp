// SPDX-License-Identifier: GPL-2.0-or-later
/// The exponential of A = s^c E_c on the graph, in closed form where each block of the matrices obeys
///   A^(k+2) = -z A^k,   0 <= k <= 3,   z = -tr(A^2)/m a polynomial in s (0 of nilpotent A)
///   exp(A) = sum_{j<k} A^j/j! + c_k(z) A^k + c_{k+1}(z) A^{k+1}
/// with the Stumpff functions c_k (Op::stumpff), which are entire. so(2), so(3), su(2), sl(2), so(2,1), se(2), se(3),
/// heis(3), aff(1), R^n, what is diagonal, and their sums have it; so(4) and gl(2) do not.
#pragma once

#include "geometry/groupoid.hpp"

#include <functional>
#include <optional>

namespace lagen {

/// Over the inputs s, n x n matrices by rows.
struct Exponential {
    std::vector<NodeId> s;                  ///< inputs, shape (m)
    std::vector<NodeId> less_one;           ///< exp(A) - 1, of which small A lose nothing
    std::vector<NodeId> inverse_less_one;   ///< exp(-A) - 1
    std::vector<std::size_t> block_without; ///< rows of a block without such a form, from 1; then there is no exp
};

/// `vanishes`: decides that a polynomial in s and the parameters is zero.
[[nodiscard]] Exponential exponential(Graph& graph, const GroupoidParts& parts, std::vector<NodeId> s,
                                      const std::function<bool(NodeId)>& vanishes);

/// The condition that exp(A) = W, as f^c E_c = cay^-1(exp(-A) W) on the entries `rows`, shape (m): its derivatives
/// along W E_c are 1 there, and Newton's method for s finds each rotation by less than pi from s = 0.
[[nodiscard]] std::vector<NodeId> logarithm_conditions(Graph& graph, const GroupoidParts& parts,
                                                       const Exponential& exponential);

/// D with d exp(A) exp(-A) = D^a_c ds^c E_a, by rows a, shape (m, m).
[[nodiscard]] std::vector<NodeId> right_differential(Graph& graph, const GroupoidParts& parts,
                                                     const Exponential& exponential);

} // namespace lagen
