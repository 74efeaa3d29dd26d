// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves on a sphere around the origin.
#pragma once

#include "commands/plot/panel.hpp"

namespace lagen {

[[nodiscard]] Drawing draw_on_sphere(const PanelRequest& request, double radius);

} // namespace lagen
