// SPDX-License-Identifier: GPL-2.0-or-later
/// Which term of some functions has no derivatives at a point, or none that are seen to be continuous there.
#pragma once

#include "proof/enclosure.hpp"

namespace lagen::proof {

/// The first one behind sums, signs, numbers and linear systems whose value and slopes by `z`
/// (proof/sloped_functions.hpp) do not shrink with the box around `at`; nothing where all do. `exactly`: the point is
/// these numbers, and not only near them.
[[nodiscard]] std::optional<NodeId> rough_term(Graph& graph, const std::vector<NodeId>& functions,
                                               const std::vector<NodeId>& z, const std::vector<Ball>& at, bool exactly);

} // namespace lagen::proof
