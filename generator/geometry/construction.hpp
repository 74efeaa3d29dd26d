// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations that hold by construction. With R(s, t) = [rho s, rho t] - rho [s, t] and the Jacobiator J,
///   R'_ab = A_a^p A_b^q R_pq,    J'_abc = A_a^p A_b^q A_c^s J_pqs + terms linear in R with derivatives of A,
/// so that a frame e'_a = A_a^b e_b of a Lie algebroid is one wherever det A != 0. [Martinez 2001]
#pragma once

#include "geometry/algebroid.hpp"

namespace lagen {

/// True where a frame stands in the block, or in what its products and prolongations are made of.
[[nodiscard]] bool contains_frame(const AlgebroidBlock& block);

/// True where all structure equations of the algebroid are shown to vanish wherever they are defined without expanding
/// those of a frame: those of the innermost blocks are proved by the zero decision, every C'^c_ab and rho'^i_a is the
/// one that the frame gives (the same node, or a difference that is proved to be zero), and det A is not zero at a
/// point. From one point to a dense set: all entries are compositions of +, -, *, /, integer powers and entire
/// functions, so that each of them lives on the complement of complex hypersurfaces, which is connected. False, which
/// says nothing, where there are other functions, base constraints or Casimirs, pairs in both orders or blocks of A
/// beyond size 5.
[[nodiscard]] bool holds_by_construction(const Model& model, const Algebroid& algebroid);

/// What `Decision::evidence` says then.
inline constexpr const char* construction_argument =
    "by construction: a frame of what is proved to be an algebroid, and its determinant is not zero";

} // namespace lagen
