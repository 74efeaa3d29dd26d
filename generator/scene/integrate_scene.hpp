// SPDX-License-Identifier: GPL-2.0-or-later
/// One run of a scene: in the process, where its methods and model are so, or by its program.
#pragma once

#include "scene/run_outcome.hpp"
#include "scene/scene_program.hpp"

#include <functional>

namespace lagen {

/// Runs the program, or the compiled model of this path; the rows and the report go into `outcome`, whose table has its
/// columns. Throws where there is no report. Where it is interrupted `outcome` has the rows so far, and the status
/// "interrupted", and InterruptedError is thrown.
void integrate_scene(const std::string& program, const ProgramInput& input, RunOutcome& outcome);

/// False where InterruptedError ended `work`.
[[nodiscard]] bool is_uninterrupted(const std::function<void()>& work);

} // namespace lagen
