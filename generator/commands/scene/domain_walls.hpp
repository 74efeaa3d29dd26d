// SPDX-License-Identifier: GPL-2.0-or-later
/// Walls of the domain: a condition a != b is left where a - b changes its sign, which may happen within one step. A
/// run watches for it as for an event that stops it.
#pragma once

#include "commands/scene/run_report.hpp"
#include "model/model.hpp"

namespace lagen {

/// The scene, with its form, and of a motion in continuous time with such an event for each wall that can move away
/// from the sign of its start; those of parameters alone cannot.
[[nodiscard]] Scene with_walls(const Model& model, Scene scene);

/// A run that a wall has stopped has left the domain.
void call_walls(RunOutcome& outcome);

} // namespace lagen
