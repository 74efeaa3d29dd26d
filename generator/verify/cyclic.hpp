// SPDX-License-Identifier: GPL-2.0-or-later
/// Cyclic base coordinates: the equations of motion are the same for all values of q. Of q are free L (H where there is
/// no L), rho, C, forces and base constraints, each by a proof on M.
#pragma once

#include "verify/verify.hpp"

namespace lagen {

/// A check `cyclic` a base coordinate, of a system with L or H: its indices are the coordinate and, where it is not
/// proved, what depends on it or might: "L", "H", "rho", "C", "forces" or "constraints", with the derivative as
/// residual.
[[nodiscard]] StructureReport cyclic_coordinates(const System& system, const ProofBudget& budget = {});

} // namespace lagen
