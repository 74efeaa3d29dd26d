// SPDX-License-Identifier: GPL-2.0-or-later
/// The right side of an equation as signed terms, and lines of them.
#pragma once

#include "typeset/equation_set.hpp"

#include <utility>

namespace lagen {

struct SignedTree {
    bool negative = false;
    Tree tree;
    std::vector<std::string> basis = {}; ///< of a wedge product of basis forms behind it
};

using SignedTexts = std::vector<std::pair<bool, std::string>>; ///< true of a negative term, and its text

/// All groups as one list of terms in their order, except that a positive term leads where there is one.
[[nodiscard]] std::vector<SignedTree> right_side_terms(const Equation& equation);

/// True of the number 1, which is not written before a basis form or an unknown.
[[nodiscard]] bool is_one(const Tree& tree);

/// A coefficient of the left side without its sign.
[[nodiscard]] SignedTree without_sign(const Tree& tree);

/// True of a x b or a . b of written equations.
[[nodiscard]] bool is_vector_product(const Tree& tree);

/// True of a sum over an index of written equations.
[[nodiscard]] bool is_indexed_sum(const Tree& tree);

/// The equations as text and LaTeX show them.
[[nodiscard]] const std::vector<Equation>& written_equations(const EquationBlock& block);

/// A power that is written at the function's name, sin^2(x): of a circular or hyperbolic function, with a whole
/// exponent of 2 or more (sin^-1 would read as the inverse).
[[nodiscard]] bool raised_by_name(const Tree& tree);

/// The terms with their signs on one line.
[[nodiscard]] std::string one_line(const SignedTexts& terms);

/// Lines of " + term" and " - term" pieces, broken before a sign where a line would exceed `width` columns. `first` and
/// `later` are the widths that stand before the first and the following lines; `measure` is the width of a piece.
[[nodiscard]] std::vector<std::string> wrap_terms(const SignedTexts& terms, std::size_t first, std::size_t later,
                                                  std::size_t width, std::size_t (*measure)(std::string_view));

/// The lines, those that are too wide broken before an inner sign, else between factors, in as few parentheses as can
/// be.
[[nodiscard]] std::vector<std::string> with_inner_breaks(const std::vector<std::string>& lines, std::size_t first,
                                                         std::size_t later, std::size_t width);

/// Lines of "[a, b, c]" with these brackets, broken behind a comma likewise.
[[nodiscard]] std::vector<std::string> wrap_entries(const std::vector<std::string>& entries, const char* open,
                                                    const char* close, std::size_t first, std::size_t later,
                                                    std::size_t width, std::size_t (*measure)(std::string_view));

/// A symbol with all that it stands for, for the printers: a vector whose entries all stand one after the other is one
/// item with several values.
struct WhereItem {
    std::string symbol;
    std::vector<Tree> values;
    bool diagonal = false; ///< a matrix with these in its diagonal
    std::vector<IndexRange> ranges = {};
};
[[nodiscard]] std::vector<WhereItem> where_items(const EquationSet& equations);

} // namespace lagen
