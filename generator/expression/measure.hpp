// SPDX-License-Identifier: GPL-2.0-or-later
/// The size of a tree: its height, its total degree, and the exact constants that later stages would fold. The bounds
/// on powers and constants are enforced here, for what is parsed and again for what definitions expand to.
#pragma once

#include "expression/parse.hpp"

namespace lagen {

struct Measure {
    std::size_t height = 1;
    bool constant = false;               ///< a number by + - * / ^ alone
    Rational factor = 1;                 ///< its value where constant, else the constant factor of a product
    long degree = 1;                     ///< bound of the total degree; saturates
    std::size_t terms = 1;               ///< of the largest nest of sums and products in it, written out; saturates
    const TreeNode* nonsmooth = nullptr; ///< the first function that is not smooth
};

/// The measure of a node from those of its arguments (same order).
/// Throws ModelError: division by a constant zero, 0^0, an exponent, a constant, a degree or a height beyond `limits`.
/// `terms` is that of the largest argument: who writes repetitions out counts theirs.
[[nodiscard]] Measure measure(const TreeNode& node, std::span<const Measure> arguments, const ParseLimits& limits);

} // namespace lagen
