// SPDX-License-Identifier: GPL-2.0-or-later
/// The step of a discrete motion that would have gone on where the one of its scene failed.
#pragma once

#include "commands/scene/run_report.hpp"
#include "commands/scene/scene_program.hpp"

namespace lagen {

/// The largest step near that of `scene`, in three digits, with which its run from the same momenta goes beyond
/// outcome.failed_at: by bisection between a step that was tried and works, and one that fails. "" of other motions, of
/// first arrows (which belong to their step), where outcome.status is not about the arrow of a step, and where no step
/// down to 1/1024 of it, or none within a million steps in all, works. `input`: of the run that failed.
[[nodiscard]] std::string largest_step(const Model& model, Scene scene, const std::string& program, ProgramInput input,
                                       StartState& start, const RunOutcome& outcome);

} // namespace lagen
