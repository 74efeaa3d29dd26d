// SPDX-License-Identifier: GPL-2.0-or-later
/// One run of a scene's program.
#pragma once

#include "commands/scene/scene_program.hpp"

#include <functional>

namespace lagen {

/// Runs the program; the rows and the report go into `outcome`, whose state has its names. Throws where the program did
/// not come to a report. Where it is interrupted `outcome` has the rows so far, and the status "interrupted", and
/// InterruptedError is thrown.
void integrate_scene(const std::string& program, const ProgramInput& input, RunOutcome& outcome);

/// False where InterruptedError ended `work`.
[[nodiscard]] bool is_uninterrupted(const std::function<void()>& work);

} // namespace lagen
