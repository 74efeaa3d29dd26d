// SPDX-License-Identifier: GPL-2.0-or-later
/// Frames of the tangent spaces of level sets M = {f^A(x) = 0}, A = 1..m, with B^A_i = df^A/dx^i of rank m on M.
#pragma once

#include "elaborate/choose_kept.hpp"

namespace lagen {

/// With kept coordinates K and the others P, where det B_P is proved to vanish nowhere: e_a = d/dx^a - (B_P^-1 B_a)^P
/// d/dx^P, a in K. They lie in ker B around M, not on M alone, and their components along K are constants: so their
/// brackets, which lie there too and have the components 0, are 0.
/// On a curve (n - m = 1) that has no such K, and whose fibre coordinate has a name of its own: e = (-1)^(n-1+i) M_i
/// d/dx^i, M_i the minor of B without column i, up to a number. It is defined on all of M, and zero where M is singular
/// alone.
/// Throws ModelError: as many constraints as coordinates, dependent ones, singular level sets, several charts.
[[nodiscard]] LevelSetFrame make_frame(const Model& model, const LevelSetRequest& request);

/// All that the reading of a model asks for.
[[nodiscard]] Choosers choosers();

} // namespace lagen
