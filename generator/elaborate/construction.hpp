// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations that hold by construction. With R(s, t) = [rho s, rho t] - rho [s, t] and the Jacobiator J,
///   R'_ab = A_a^p A_b^q R_pq,    J'_abc = A_a^p A_b^q A_c^s J_pqs + terms linear in R with derivatives of A,
/// so that a frame e'_a = A_a^b e_b of a Lie algebroid is one wherever det A != 0. [Martinez 2001]
#pragma once

#include "mechanics/written_algebroid.hpp"
#include "model/model.hpp"

#include <functional>

namespace lagen {

/// What shows, without expanding the equations of a frame, that all structure equations of the algebroid vanish
/// wherever they are defined: those of the innermost blocks are proved by the zero decision, every C'^c_ab and rho'^i_a
/// is the one that the frame gives (the same node, or a difference that is proved to be zero), and det A is not zero at
/// a point. From one point to a dense set: all entries are compositions of +, -, *, /, integer powers and entire
/// functions, so that each of them lives on the complement of complex hypersurfaces, which is connected; or, on a
/// convex domain, of other functions too that are analytic on all of it (see are_analytic). It answers
/// false, which says nothing, where there are other functions, base constraints or Casimirs, pairs in both orders or
/// blocks of A beyond size 5. Empty where no frame stands in the model's algebroid.
[[nodiscard]] std::function<bool()> construction_of(const Model& model, const WrittenAlgebroid& algebroid);

} // namespace lagen
