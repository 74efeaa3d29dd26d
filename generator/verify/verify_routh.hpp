// SPDX-License-Identifier: GPL-2.0-or-later
/// That a reduced Lagrangian has the motions of a system on a level set of momenta.
#pragma once

#include "mechanics/routh.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Checks, by their names and indices, of `routhian` of `system` (nodes of `graph`, a copy of the system's), where R is
/// the Lagrangian of `reduced`, whose parameters beside those of the system are the momenta; `cyclic` are the checks of
/// cyclic_coordinates:
///   `cyclic` (x)      L, forces and constraints are free of x
///   `conserved` (p)   no force acts along it
///   `momentum` (p)    dL/dy^k is p_k at y^k = Theta^k
///   `routh` (y)       the Lagrange expression of R in y is that of L on the level set, for all accelerations
[[nodiscard]] StructureReport verify_routh(Graph& graph, const System& system, const Routhian& routhian,
                                           const System& reduced, const StructureReport& cyclic,
                                           const ProofBudget& budget = {});

} // namespace lagen
