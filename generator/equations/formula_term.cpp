// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/formula_term.hpp"

#include <algorithm>

namespace lagen {

void append_right_side(EquationBlock& block, const std::vector<FormulaTerm>& terms)
{
    const auto occurs = [&](const std::string& label) { // groups with like terms are one, "ρ_a(L) - p_c C^c_ab y^b"
        const std::string unsigned_label = label.substr(label.starts_with('-') ? 1 : 0);
        return std::ranges::any_of(block.equations, [&](const Equation& equation) {
            return std::ranges::any_of(equation.groups, [&](const TermGroup& group) {
                return group.label.find(unsigned_label) != std::string::npos;
            });
        });
    };
    const auto append = [](std::string& formula, const std::string& term, bool first) {
        const bool negative = term.starts_with('-');
        formula += first ? " = " + term : (negative ? " - " : " + ") + term.substr(negative ? 1 : 0);
    };
    bool first = true;
    for (const FormulaTerm& term : terms) {
        if (!occurs(term.label)) continue;
        append(block.formula, term.label, first);
        append(block.latex_formula, term.latex, first);
        first = false;
    }
    if (!first) return;
    append(block.formula, "0", true);
    append(block.latex_formula, "0", true);
}

} // namespace lagen
