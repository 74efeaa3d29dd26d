// SPDX-License-Identifier: GPL-2.0-or-later
/// What the state of a run is worth: its rows w beside the rows w' of a second, finer run of the same motion.
#pragma once

#include "commands/scene/table.hpp"
#include "text/record.hpp"

#include <optional>
#include <string>

namespace lagen {

struct StateAccuracy {
    double estimate = 0;                 ///< the largest |w - w'|_2 of a row, divided by the largest |w'|_2
    std::optional<double> holds_until{}; ///< t of the first row where |w - w'|_2 exceeds 1e-2 of the largest |w'|_2
};

/// Rows are compared up to the first that only one of the tables has: both have the same times, unless they are
/// compared `by_number` (those of an event are). Entries that are no finite number in one of them are left out. Nothing
/// where there is no row behind the first to compare.
[[nodiscard]] std::optional<StateAccuracy> accuracy_of(const Table& run, const Table& second, bool by_number);

/// "error of the state: about 3e-9", or "digits hold until t = 19.2".
[[nodiscard]] std::string text_of(const StateAccuracy& accuracy);

/// The line that says so. `second_run` is what the second run was, or why nothing is known; empty: there is no line.
[[nodiscard]] std::string accuracy_line(const std::optional<StateAccuracy>& accuracy, const std::string& second_run);

/// An object of JSON.
[[nodiscard]] Record record_of(const StateAccuracy& accuracy);

} // namespace lagen
