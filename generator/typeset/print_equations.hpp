// SPDX-License-Identifier: GPL-2.0-or-later
/// An EquationSet for people and programs.
#pragma once

#include "text/record.hpp"
#include "typeset/equation_set.hpp"
#include "typeset/equation_system.hpp"

namespace lagen {

/// What becomes of a term or a left side that is wider than a page.
enum class LongLines {
    broken, ///< at inner signs and products
    whole,  ///< one line, for a reader who leaves it out
};

/// UTF-8, aligned, at most 120 columns.
[[nodiscard]] std::string print_text(const EquationSet& equations, LongLines long_lines = LongLines::broken);
[[nodiscard]] std::string print_latex(const EquationSet& equations); ///< a compilable fragment: align* blocks (amsmath)
[[nodiscard]] std::string print_json(const EquationSet& equations);
[[nodiscard]] Record record_of(const EquationSet& equations); ///< what print_json prints
[[nodiscard]] Record record_of(const EquationSystem& system); ///< the member "system" beside it

/// One tree as UTF-8 mathematics / LaTeX.
[[nodiscard]] std::string latex_of(const Tree& tree, const EquationSet& symbols);

} // namespace lagen
