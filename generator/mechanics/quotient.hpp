// SPDX-License-Identifier: GPL-2.0-or-later
/// The quotient TQ/G by a group that acts on Q from the right, on a slice sigma(m) of its orbits: x^k = z^k for k in K,
/// m the other coordinates, |K| = dim G. In the trivialisation (m, g) -> sigma(m).g the invariant sections are the
/// d/dm^i and one e_b a generator E_b, and a velocity at a point of the slice is
///   xdot = u^i d/dm^i + s w^b xi_b,   xi_b(x) = d/ds x.exp(s E_b),   rho(u, w) = u^i d/dm^i,   [e_b, e_c] = C^a_bc e_a
/// with the structure constants C of G: s = -1, since right translations are by g and the brackets of right invariant
/// fields have the other sign, or s = 1 where C = 0. An invariant L is l(m, u, w) = L(sigma(m), xdot) on TQ/G, and
/// along sigma(m(t)).g(t) with g(0) = 1 the accelerations at t = 0 are
///   xddot = d/dt (xdot over m, u, w) + s w^b (dxi_b/dx^j) xdot^j           [Martinez 2001; Cendra, Marsden, Ratiu
///   2001]
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

/// A right action on the coordinates x of a system with E = TQ.
struct InfinitesimalAction {
    std::vector<std::vector<NodeId>> fields; ///< xi_b^i over x, shapes (dim G), (n)
    bool is_abelian = false;
};

/// x^k = z^k.
struct Slice {
    std::vector<std::size_t> frozen; ///< K, ascending
    std::vector<NodeId> values;      ///< z^k over parameters
};

struct Quotient {
    Slice slice;
    std::vector<std::size_t> free;       ///< coordinates m, ascending
    std::vector<NodeId> w;               ///< inputs w^b
    std::vector<NodeId> velocity;        ///< xdot over m, u, w, shape (n); u^i are the inputs y^i of the whole
    std::vector<NodeId> base, group;     ///< u and w over m and xdot, shapes (|free|), (dim G)
    std::vector<std::vector<NodeId>> xi; ///< s xi_b^i on the slice
    NodeId determinant = 0;              ///< of xi_b^k, k in K; where it is 0 an orbit touches the slice
    NodeId lagrangian = 0;               ///< l

    /// Replacements that put functions of x on the slice.
    [[nodiscard]] Replacements on_slice(const System& whole) const;
};

/// det xi_b^k, k in K, on the slice: what a slice is chosen by.
[[nodiscard]] NodeId slice_determinant(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                       const Slice& slice);

/// `w`: inputs, one a generator. The determinant is not the constant 0, and dim G at most `determinant_limit`.
[[nodiscard]] Quotient quotient(Graph& graph, const System& whole, const InfinitesimalAction& action, Slice slice,
                                std::vector<NodeId> w);

/// xddot over m, u, w and their rates (of u by the numbers of `free`).
[[nodiscard]] std::vector<NodeId> accelerations(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                                const Quotient& quotient, const std::vector<NodeId>& udot,
                                                const std::vector<NodeId>& wdot);

} // namespace lagen
