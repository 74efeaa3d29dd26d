// SPDX-License-Identifier: GPL-2.0-or-later
/// What a model gives, as it stands before its equations: L, the brackets, the constraints of M, claimed invariants.
#pragma once

#include "equations/symbolic_model.hpp"

namespace lagen {

/// L(x, y) in its shortest form and the brackets of sections, [e_a, e_b] = C^c_ab e_c, those that are not zero.
[[nodiscard]] std::vector<EquationBlock> lagrangian_and_brackets(SymbolicModel& symbolic, const GiNaC::ex& lagrangian);

/// phi(x) = 0 on M, and the invariants that the model claims, where it has any.
[[nodiscard]] std::vector<EquationBlock> constraints_and_invariants(SymbolicModel& symbolic);

} // namespace lagen
