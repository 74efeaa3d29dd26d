// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions that are written over t and do not depend on it: of places on a hoop that turns steadily.
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

/// f at t = 0 where f is proved to be that at all points and times, else f.
[[nodiscard]] NodeId without_cancelled_time(Graph& graph, const System& system, NodeId f);

} // namespace lagen
