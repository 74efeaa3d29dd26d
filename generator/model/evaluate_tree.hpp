// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers out of closed trees, in long double, with one directional derivative where asked: enough to start a scene.
#pragma once

#include "expression/tree.hpp"

#include <map>
#include <string>

namespace lagen {

/// value + derivative * epsilon, epsilon^2 = 0.
struct Dual {
    long double value = 0;
    long double derivative = 0;
};

using Values = std::map<std::string, Dual>;

/// The value of `tree` with names bound to `values`. Shared trees are evaluated once. A comparison has the value 1 or
/// 0. Undefined operations give nan or infinities, as in IEEE arithmetic. Throws ModelError for a name without a value.
[[nodiscard]] Dual evaluate(const Tree& tree, const Values& values);

/// Correctly rounded to long double.
[[nodiscard]] long double to_long_double(const Rational& number);

} // namespace lagen
