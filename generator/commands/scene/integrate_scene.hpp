// SPDX-License-Identifier: GPL-2.0-or-later
/// One run of a scene's program.
#pragma once

#include "commands/scene/scene_program.hpp"

namespace lagen {

/// Runs the program; the rows and the report go into `outcome`, whose state has its names. Throws where the program did
/// not come to a report.
void integrate_scene(const std::string& program, ProgramInput input, RunOutcome& outcome);

} // namespace lagen
