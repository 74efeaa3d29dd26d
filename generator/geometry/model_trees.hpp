// SPDX-License-Identifier: GPL-2.0-or-later
/// The expressions of a model, for what must hold of all of them.
#pragma once

#include "geometry/algebroid.hpp"

namespace lagen {

/// Closed trees in this order: definitions (used or not), domain, constraints, Casimirs, rho, C, L, invariants,
/// observables, events. A definition that cannot be closed by itself (a function of vectors) is seen where it is used.
[[nodiscard]] std::vector<Tree> all_trees(const Model& model, const Algebroid& algebroid);

/// Every operation of the trees that is not defined everywhere, as it is written: divisions, powers other than natural
/// ones, sqrt, log, tan, asin, acos, atan2. What is folded later (sqrt(x)^2, x/x) keeps its conditions here.
[[nodiscard]] std::vector<Tree> partial_operations(const std::vector<Tree>& trees);

} // namespace lagen
