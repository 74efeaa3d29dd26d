// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions that jump although their derivatives do not show it: atan2(v, u) across v = 0, u < 0. A function whose
/// rate vanishes is constant along a motion only where it does not jump.
#pragma once

#include "proof/decide.hpp"

namespace lagen {

/// What jumps in `f`, and where, unless it is shown that the domain keeps off the cut; empty: nothing.
[[nodiscard]] std::string jump_of(const Graph& graph, NodeId f, const ZeroDecider& decider);

/// A proof that rests on the derivatives of `f` becomes `undecided` where f jumps.
void respect_jumps(Decision& decision, const Graph& graph, NodeId f, const ZeroDecider& decider);

} // namespace lagen
