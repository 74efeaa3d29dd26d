// SPDX-License-Identifier: GPL-2.0-or-later
/// The second run of a motion, by finer steps, that says what the state of the first one is worth.
#pragma once

#include "scene/run_outcome.hpp"
#include "scene/scene_program.hpp"

namespace lagen {

/// Is it made? `short_runs`: where the first run took at most 5 s.
enum class SecondRun { none, short_runs, always };

/// What a run was made with.
struct RunSetting {
    const Model& model;
    const Scene& scene;
    const MethodEntry& method;
    const std::string& program;
    const ProgramInput& input;
    StartState& start;
};

/// Why no second run is made after a first one of this outcome, or "".
[[nodiscard]] std::string reason_for_one_run(const RunOutcome& outcome, SecondRun wanted);

/// The input of the same motion at a tenth of the tolerance, or by half the step; nothing where that cannot be asked
/// for. `said` becomes what it is, or why it cannot.
[[nodiscard]] std::optional<ProgramInput> finer_input(const RunSetting& run, std::string& said);

/// Makes the second run, and gives `outcome` what it tells. An interrupt ends the second run alone.
void judge_state(const RunSetting& run, SecondRun wanted, RunOutcome& outcome);

} // namespace lagen
