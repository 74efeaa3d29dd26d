// SPDX-License-Identifier: GPL-2.0-or-later
/// What the printers of equations share: the right side as signed terms, and lines of them.
#pragma once

#include "expression/equation_set.hpp"

#include <utility>

namespace lagen {

struct SignedTree {
    bool negative = false;
    Tree tree;
};

/// All groups as one list of terms in their order, except that a positive term leads where there is one.
[[nodiscard]] std::vector<SignedTree> right_side_terms(const Equation& equation);

/// A coefficient of the left side without its sign.
[[nodiscard]] SignedTree without_sign(const Tree& tree);

/// Lines of " + term" and " - term" pieces, broken before a sign where a line would exceed `width` columns. `first` and
/// `later` are the widths that stand before the first and the following lines.
[[nodiscard]] std::vector<std::string> wrap_terms(const std::vector<std::pair<bool, std::string>>& terms,
                                                  std::size_t first, std::size_t later, std::size_t width);

/// Columns of a UTF-8 text on a terminal: code points, combining marks not counted.
[[nodiscard]] std::size_t columns_of(std::string_view text);

} // namespace lagen
