// SPDX-License-Identifier: GPL-2.0-or-later
/// rho and C of the model's algebroid block, as a person would write them, and on a graph.
#pragma once

#include "geometry/algebroid.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/written_algebroid.hpp"
#include "model/model.hpp"

namespace lagen {

/// General and action as given, tangent (rho = identity on `over`, C = 0), lie_algebra (n = 0 or rho = 0), named
/// algebras by their table, the others computed; with its construction where frames stand in it. Throws ModelError
/// (unknown algebra, wrong rank).
[[nodiscard]] WrittenAlgebroid build_algebroid(const Model& model);

/// Declares x (where it is new) and, after rho and C, y.
[[nodiscard]] Algebroid lower_algebroid(Graph& graph, Lowering& lower, const WrittenAlgebroid& written);

} // namespace lagen
