// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the bracket of a built algebroid comes from, as statements from which its structure equations follow without
/// a term of them. With R(s, t) = [rho s, rho t] - rho [s, t] and the Jacobiator J,
///   R'_ab = A_a^p A_b^q R_pq,    J'_abc = A_a^p A_b^q A_c^s J_pqs + terms linear in R with derivatives of A,
/// so that a frame e'_a = A_a^b e_b of a Lie algebroid is one wherever det A != 0; so is a product of algebroids over
/// separate bases, and a prolongation.                                                               [Martinez 2001]
#pragma once

#include "geometry/algebroid.hpp"

namespace lagen {

/// All nodes are of `graph`. The equations follow where every statement is shown, on the whole domain or, of what is
/// analytic there, at one point.
struct Construction {
    Graph graph;
    std::vector<NodeId> x, parameters; ///< inputs
    std::vector<NodeId> domain;        ///< comparisons
    std::vector<Algebroid> algebroids; ///< which everything is made of: they satisfy the structure equations
    std::vector<NodeId> zero;          ///< entries as they are written, less those that the construction gives
    std::vector<NodeId> nonzero;       ///< where determinants of frames are not zero, a block each
    std::vector<NodeId> analytic;      ///< entries and matrices of frames
};

} // namespace lagen
