// SPDX-License-Identifier: GPL-2.0-or-later
/// Implicit blocks in the interpreter: the reference for Newton's method in compiled kernels.
#pragma once

#include "graph/unknowns/implicit.hpp"

#include <map>
#include <string>

namespace lagen {

/// Adds the unknowns of `blocks`, by their input names, to `inputs`: damped Newton iterations from the guess, to
/// round-off. Throws MathematicsError where it finds no solution. Instantiated for double and long double.
template <class Scalar>
void solve_unknowns(const Graph& graph, std::span<const ImplicitBlock> blocks, std::map<std::string, Scalar>& inputs);

} // namespace lagen
