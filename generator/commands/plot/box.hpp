// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves in a box with axes.
#pragma once

#include "commands/plot/panel.hpp"

namespace lagen {

[[nodiscard]] Drawing draw_in_box(const PanelRequest& request);

} // namespace lagen
