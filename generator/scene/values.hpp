// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers out of the closed trees of a scene, in long double.
#pragma once

#include "expression/tree.hpp"

#include <map>
#include <string>

namespace lagen {

/// Numbers by name.
using Values = std::map<std::string, long double>;

/// The value of `tree` with names bound to `values`. A comparison has the value 1 or 0. Undefined operations give nan
/// or infinities, as in IEEE arithmetic. Throws ModelError where a divisor is the constant 0.
[[nodiscard]] long double value_of(const Tree& tree, const Values& values);

} // namespace lagen
