// SPDX-License-Identifier: GPL-2.0-or-later
/// The outcome of a run, as text and as JSON.
#pragma once

#include "commands/line/options.hpp"
#include "scene/second_run.hpp"
#include "text/record.hpp"

#include <string>
#include <vector>

namespace lagen {

/// By --second-run and --no-second-run; UsageError where both are given.
[[nodiscard]] SecondRun second_run_of(const Options& options);

/// "error of the state: about 3e-9", or "digits hold until t = 19.2".
[[nodiscard]] std::string text_of(const StateAccuracy& accuracy);

/// An object of JSON.
[[nodiscard]] Record record_of(const StateAccuracy& accuracy);

/// The object of `run --format json`; numbers keep their digits, what is not finite is null.
[[nodiscard]] std::string report_json(const RunOutcome& outcome);

/// A few lines for standard error: status, steps, events, drift of what should be constant.
[[nodiscard]] std::string report_text(const RunOutcome& outcome);

/// "warning: LANES moved and never exceeded the absolute tolerance ..": the sentence of runs and sweeps.
[[nodiscard]] std::string below_absolute_warning(const std::string& lanes, const std::string& tolerance);

/// A line for standard error where the run starts on events that do not happen there, or beyond them; else nothing.
[[nodiscard]] std::string start_note(const RunOutcome& outcome);

/// Warnings of functions that the equations conserve and this run did not, and of lanes below the absolute tolerance: a
/// line "warning: ..." each.
[[nodiscard]] std::string run_warnings(const RunOutcome& outcome);

// An interrupted run leaves the rows that it has written so far.

/// Writes the rows where the run would have written them, but for a file, which is FILE.partial: what was there before
/// stays. `known` as for to_csv, `report` is the object of JSON, `t` the last time of the run, NaN where it is not
/// known.
ExitCode leave_rows(const Options& options, const Table& rows, const std::vector<std::string>& known,
                    const std::string& report, double t);

} // namespace lagen
