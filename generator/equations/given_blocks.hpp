// SPDX-License-Identifier: GPL-2.0-or-later
/// The data that a model gives, as they stand before its equations: L, the brackets, the constraints of M, claimed
/// invariants.
#pragma once

#include "equations/symbolic_model.hpp"

namespace lagen {

/// L in its shortest form, a function of these `arguments`: "x, y".
[[nodiscard]] EquationBlock lagrangian_block(const SymbolicModel& symbolic, const GiNaC::ex& lagrangian,
                                             const std::string& arguments);
/// L as this equation has it.
[[nodiscard]] EquationBlock lagrangian_block(Equation lagrangian, const std::string& arguments);

/// [e_a, e_b] = C^c_ab e_c where that is not zero; no equations where all are.
[[nodiscard]] EquationBlock bracket_block(const SymbolicModel& symbolic);

/// phi(x) = 0 on M, and the invariants that the model claims; blocks without equations where it has none.
[[nodiscard]] std::vector<EquationBlock> constraints_and_invariants(SymbolicModel& symbolic);
/// The same with what `write` makes of each function.
[[nodiscard]] std::vector<EquationBlock>
constraints_and_invariants(const Model& model, const WrittenAlgebroid& algebroid,
                           const std::function<std::vector<TermGroup>(const Tree&)>& write);

/// The blocks one after the other, those that have equations.
[[nodiscard]] std::vector<EquationBlock> given_blocks(std::vector<EquationBlock> first,
                                                      const std::vector<EquationBlock>& behind);

} // namespace lagen
