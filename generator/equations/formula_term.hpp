// SPDX-License-Identifier: GPL-2.0-or-later
/// The right side of the formula over a block: of its groups those that occur.
#pragma once

#include "typeset/equation_set.hpp"

namespace lagen {

/// A group of terms in the formula over a block: its label, which begins with '-' where it is subtracted, and LaTeX for
/// the same.
struct FormulaTerm {
    std::string label, latex;
};

/// Appends " = " and the groups to the block's formula, the left side so far: those that occur in its equations, or 0
/// where none does.
void append_right_side(EquationBlock& block, const std::vector<FormulaTerm>& terms);

} // namespace lagen
