// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run tells of the branches of a discrete motion: of the arrows that are found with the momenta of its start.
#pragma once

#include "commands/scene/run_report.hpp"

#include <string>

namespace lagen {

/// Whether the arrow that was asked for is none of those that are found.
[[nodiscard]] bool is_branch_missing(const RunOutcome& outcome);

/// How many there are, and their distances.
[[nodiscard]] std::string missing_branch_text(const RunOutcome& outcome);

/// Of a motion that does not go on: what other arrows there are, and how to follow them, a line each; or "".
[[nodiscard]] std::string branches_text(const RunOutcome& outcome);

/// The members "branches" and "other_branches", with a blank before and a comma behind each; or "".
void add_branches(Record& record, const RunOutcome& outcome);

} // namespace lagen
