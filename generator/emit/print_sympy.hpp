// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as a module of Python for SymPy (docs/python.md).
#pragma once

#include "notation/equation_module.hpp"

namespace lagen {

/// The same bytes on every run. Throws MathematicsError where an expression is too long or has no counterpart in SymPy.
[[nodiscard]] std::string print_sympy(const EquationModule& module);

} // namespace lagen
