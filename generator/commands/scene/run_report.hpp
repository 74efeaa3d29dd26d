// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run gave, and how it is told.
#pragma once

#include "commands/scene/table.hpp"
#include "lagen_run/report.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

/// Whether it is followed without being claimed: E, or H.
[[nodiscard]] bool is_energy(const detail::Drift& drift);

/// The action over a run, its first variations as their two parts, its second variations, and for each the square of a
/// bound of the integrals of |term| of the terms of the first variation.
struct ActionReport {
    double action = 0;
    std::vector<double> base, fibre, second, squares; ///< one a variation
};

/// The report of a run, with what lagen knows besides.
struct RunOutcome : detail::RunReport {
    std::string model, scene, form, method;
    std::vector<std::string> lanes; ///< names of the lanes of states, base first
    std::string not_finite{};       ///< what of the equations is no finite number at the last good state, or ""
    std::uint64_t branch = 0;       ///< the number of the first arrow that was asked for, 0 where none was
    bool searches = false;          ///< controls are searched for, and followed
    std::optional<ActionReport> action{};
    std::optional<StateAccuracy> accuracy{}; ///< by a second run, where one was made
    std::string second_run{};                ///< what that was, or why there is none; empty: nothing is said
    std::string absolute{};                  ///< absolute tolerance of an adaptive method
    std::vector<std::string> left_out{};     ///< claims and first-order states that have no value in the form
    bool energy_changes = false;             ///< forces, explicit time, a drift or jumps: the energy is not conserved
    Table table;
};

/// Whether a run came to its end, or to that of its own event.
[[nodiscard]] bool succeeded(const std::string& status);

/// By the user: there are the rows so far.
[[nodiscard]] bool is_interrupted(const RunOutcome& outcome);

/// The object of `run --format json`; numbers keep their digits, what is not finite is null.
[[nodiscard]] std::string report_json(const RunOutcome& outcome);

/// A few lines for standard error: status, steps, events, drift of what should be constant.
[[nodiscard]] std::string report_text(const RunOutcome& outcome);

/// "warning: LANES moved and never exceeded the absolute tolerance ..": the sentence of runs and sweeps.
[[nodiscard]] std::string below_absolute_warning(const std::string& lanes, const std::string& tolerance);

/// A line for standard error where the run starts on events that do not happen there, or beyond them; else nothing.
[[nodiscard]] std::string start_note(const RunOutcome& outcome);

/// What the equations conserve and this run did not, and lanes below the absolute tolerance: a line "warning: ..."
/// each.
[[nodiscard]] std::string run_warnings(const RunOutcome& outcome);

} // namespace lagen
