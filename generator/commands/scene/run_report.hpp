// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run gave, and how it is told.
#pragma once

#include "commands/scene/small_lanes.hpp"
#include "commands/scene/state_accuracy.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// An event that was found, with its time, the lanes of the state and those behind its jump, as printed by the scene's
/// program.
struct EventReport {
    std::string name;
    std::string time;
    std::vector<std::string> state;
    std::vector<std::string> after; ///< empty where it does not jump
};

/// How a function moved over the steps that should be constant, or 0 where it is a constraint. Numbers as printed;
/// "nan", or nothing, where there is none.
struct Drift {
    std::string name;
    std::string initial;
    std::string max_drift;          ///< largest |f(t) - f(t_0)|, or |f(t)| of a constraint
    std::string time{};             ///< of the largest
    std::string slope{}, error{};   ///< of a line through f - f(t_0), and the bound of its error
    std::string size{}, moved_at{}; ///< of f, and when it first moved by more than 1e-3 of that
};

/// Whether it is followed without being claimed: E, or H.
[[nodiscard]] bool is_energy(const Drift& drift);

/// The action over a run, its first variations as their two parts, its second variations, and for each the square of a
/// bound of the integrals of |term| of the terms of the first variation. Numbers as printed.
struct ActionReport {
    std::string action;
    std::vector<std::string> base, fibre, second, squares; ///< one a variation
};

struct RunOutcome {
    std::string model, scene, form, method;
    std::string status; ///< "ok", "stopped_by_event", "left_domain", ... (runtime's names)
    std::string time;   ///< of the last good state
    std::vector<std::pair<std::string, std::string>> state; ///< the last good state: lanes by name, base first
    std::string failed_at;    ///< time at which the run met what ended it; `time` where nothing failed
    std::string not_finite{}; ///< what of the equations is no finite number at the last good state, or ""
    std::string largest_step; ///< near that of a discrete motion that failed, which would have gone on; or ""
    /// Distances of the arrows that are found with the momenta of a discrete start, where they were looked for; of
    /// those with the momenta of the step that failed; and the number of the one that was asked for, 0 where none was.
    std::optional<std::vector<std::string>> branches;
    std::vector<std::string> others{};
    std::uint64_t branch = 0;
    std::string steps, rejected, rhs_calls, seconds; ///< numbers as printed
    std::string newton, decompositions; ///< Newton iterations and factorisations of implicit methods; else empty
    bool searches = false;              ///< controls are searched for, and followed
    std::vector<EventReport> events;
    std::vector<std::string>
        starts_on{}; ///< events on or beyond whose zero the run starts, and that do not happen there
    std::vector<Drift> invariants, casimirs, constraints; ///< the first of the invariants is the energy
    std::vector<Drift> balance; ///< of the energy less the work, where forces or explicit time change the energy
    std::string work;           ///< of them, over the run
    std::string manifold, manifold_time; ///< largest distance from it, where there are constraints
    std::optional<ActionReport> action{};
    std::optional<StateAccuracy> accuracy{}; ///< by a second run, where one was made
    std::string second_run{};                ///< what that was, or why there is none; empty: nothing is said
    std::vector<SmallLane> below_absolute{}; ///< of an adaptive method
    std::string absolute{};                  ///< its absolute tolerance
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

/// A line for standard error where the run starts on events that do not happen there, or beyond them; else nothing.
[[nodiscard]] std::string start_note(const RunOutcome& outcome);

/// What the equations conserve and this run did not, and lanes below the absolute tolerance: a line "warning: ..."
/// each.
[[nodiscard]] std::string run_warnings(const RunOutcome& outcome);

} // namespace lagen
