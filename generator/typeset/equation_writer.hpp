// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees and the sides of equations as mathematics; a table of spellings makes text or LaTeX of it.
#pragma once

#include "typeset/print_equations_terms.hpp"

#include <array>
#include <functional>

namespace lagen {

/// How tightly a text holds together, loosest first.
enum class Hold { sum, sign, quotient, product, power, atom };

/// A row holds all that text and LaTeX write differently.
struct EquationSpelling {
    struct Fraction {
        const char *before, *between, *behind;
        Hold above, below; ///< at least, of its parts
        Hold hold;         ///< of a fraction, and of a sum over an index
    };
    struct Root {
        const char *before, *behind;
        Hold inside, hold;
    };
    struct Matrix {
        const char *before, *behind, *column, *row, *inverse;
    };
    struct Ranges {
        const char *before, *between, *dots;
    };

    const char *open, *close;                ///< around what holds too loosely
    const char *open_set, *close_set;        ///< around {F, G}
    const char *open_size, *close_size;      ///< of an absolute value
    const char *upper, *lower, *end_index;   ///< around an index or an exponent
    const char *times, *cross, *dot, *wedge; ///< between factors
    const char *pi, *dots;                   ///< the number; what stands for the rest of a long tree
    std::array<const char*, 6> comparisons;  ///< in the order of Comparison
    Fraction fraction;
    Root root;
    Matrix matrix;
    Ranges ranges;                            ///< of indices, behind an equation
    Hold exponent, call;                      ///< at least, of an exponent; of f(x)
    bool script_digits;                       ///< the alphabet has digits above and below the line
    bool bare_arguments;                      ///< sin x without parentheses
    const char* FunctionEntry::*function;     ///< names of functions
    std::string (*sum_sign)(const Tree& sum); ///< with its index
    std::function<std::string(const std::string&name)> symbol, dotted, base; ///< a name, its rate, under an exponent
};

class EquationWriter {
  public:
    explicit EquationWriter(EquationSpelling spelling) : spelling_(std::move(spelling)) {}

    /// `last`: no factor stands behind it, which a sine without parentheses would take in. A tree beyond 10^5 nodes (a
    /// shared one written out) is cut.
    [[nodiscard]] std::string write(const Tree& tree, Hold at_least, bool last = true) const;
    [[nodiscard]] std::string left_side(const Equation& equation) const;
    /// The terms of a left side that has a mass.
    [[nodiscard]] SignedTexts mass_terms(const Equation& equation) const;
    /// At least one; the ranges of indices stand behind the last.
    [[nodiscard]] SignedTexts right_terms(const Equation& equation) const;
    /// The terms of the one value of an item; the values of an item that has several.
    [[nodiscard]] SignedTexts terms_of(const WhereItem& item) const;
    [[nodiscard]] std::vector<std::string> entries_of(const WhereItem& item) const;

  private:
    [[nodiscard]] std::string coefficient(const Tree& tree) const;
    [[nodiscard]] std::string basis(const std::string& name, bool of_sections) const;

    EquationSpelling spelling_;
};

} // namespace lagen
