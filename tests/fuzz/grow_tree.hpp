// SPDX-License-Identifier: GPL-2.0-or-later
/// Expressions in x, y, z by choice, and others that equal them.
#pragma once

#include "expression/tree.hpp"
#include "fuzz/choices.hpp"

namespace lagen::fuzz {

/// An expression with every operation and scalar function of the language, at most `depth` operations deep.
[[nodiscard]] Tree grow(Choices& choices, std::size_t depth);

/// An expression that has the value of `tree` wherever both are defined: one identity, applied somewhere in it.
[[nodiscard]] Tree rewritten(Choices& choices, const Tree& tree);

/// Some function in it is not differentiable where it is defined: minimum, maximum, sign, select.
[[nodiscard]] bool has_kinks(const Tree& tree);

} // namespace lagen::fuzz
