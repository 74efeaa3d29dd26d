// SPDX-License-Identifier: GPL-2.0-or-later
/// Unknowns with brackets in the interpreter: the reference for lagen/bracket.hpp in compiled kernels.
#pragma once

#include "graph/unknowns/implicit.hpp"

#include <map>
#include <string>

namespace lagen {

/// Adds the unknowns of a block with a bracket to `inputs`: of each the root of its equation in its interval, by
/// Newton's method safeguarded by bisection, or the end next to it. Throws MathematicsError where a value is not finite
/// or an open interval has no root. Instantiated for double and long double.
template <class Scalar>
void solve_in_brackets(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs);

} // namespace lagen
