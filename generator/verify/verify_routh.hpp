// SPDX-License-Identifier: GPL-2.0-or-later
/// That a reduced Lagrangian has the motions of a system on a level set of momenta.
#pragma once

#include "mechanics/routh.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// The factors of the determinant that the domain does not show to be nonzero: where one of them vanishes the momenta
/// do not determine the velocities. Throws SingularMomenta where the determinant is proved to be 0 everywhere, and
/// MathematicsError where it is for the parameter values of the file.
[[nodiscard]] std::vector<Tree> singular_factors_of_momenta(Graph& graph, const System& system,
                                                            const Routhian& routhian, const ProofBudget& budget = {});

/// Checks, by their names and indices, of `routhian` of `system` (nodes of `graph`, a copy of the system's), where R is
/// the Lagrangian of `reduced`, whose parameters beside those of the system are the momenta; `cyclic` are the checks of
/// cyclic_coordinates, and `where` strict conditions on which Theta exists, which stand beside what is proved with it:
///   `cyclic` (x)      L, forces and constraints are free of x
///   `conserved` (p)   no force acts along it
///   `momentum` (p)    dL/dy^k is p_k at y^k = Theta^k
///   `routh` (y)       the Lagrange expression of R in y is that of L on the level set, for all accelerations
[[nodiscard]] StructureReport verify_routh(Graph& graph, const System& system, const Routhian& routhian,
                                           const System& reduced, const StructureReport& cyclic,
                                           const std::vector<std::string>& where, const ProofBudget& budget = {});

} // namespace lagen
