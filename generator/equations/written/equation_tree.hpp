// SPDX-License-Identifier: GPL-2.0-or-later
/// An equation as one tree, [symbol, [mass * rate, ..], [group, ..]], in which indices are sought and put.
#pragma once

#include "typeset/equation_set.hpp"

namespace lagen {

/// True where both sides are sums of values: no form, section or bracket.
[[nodiscard]] bool is_plain(const Equation& equation);

[[nodiscard]] Tree array_of(std::vector<Tree> entries);

[[nodiscard]] Tree tree_of(const Equation& equation);

/// The equation with what such a tree has.
[[nodiscard]] Equation with_tree(Equation equation, const Tree& tree);

/// value * rate, of a name with a rate_mark; 1 is left out.
[[nodiscard]] Tree times_rate(const Tree& value, const Tree& rate);
[[nodiscard]] bool is_mass_times_rate(const Tree& tree);

} // namespace lagen
