// SPDX-License-Identifier: GPL-2.0-or-later
/// Rotation vectors that are an angle times a constant unit vector.
#pragma once

#include "expression/closed.hpp"
#include "expression/special_angles.hpp"

#include <array>

namespace lagen {

/// v = angle e. The entries of e are square roots of rational numbers with a sign.
struct FixedAxis {
    ClosedTree angle;
    std::array<SignedRoot, 3> e;
};

/// Nothing where the three entries are not seen to be one function times such numbers.
[[nodiscard]] std::optional<FixedAxis> fixed_axis_of(const Maker& maker, const std::vector<ClosedTree>& v);

/// The number as a tree: rational, or with a square root.
[[nodiscard]] ClosedTree number_of(const Maker& maker, const SignedRoot& value);

} // namespace lagen
