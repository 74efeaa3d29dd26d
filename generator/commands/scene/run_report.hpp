// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run gave, and how it is told.
#pragma once

#include "commands/scene/table.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// An event that was found, with its time as printed by the scene's program.
struct EventReport {
    std::string name;
    std::string time;
};

/// Largest |f(t) - f(t_0)| over the steps.
struct Drift {
    std::string name;
    std::string initial;
    std::string max_drift;
};

struct RunOutcome {
    std::string model, scene, form, method;
    std::string status; ///< "ok", "stopped_by_event", "left_domain", ... (runtime's names)
    std::string time;   ///< of the last good state
    std::vector<std::pair<std::string, std::string>> state; ///< the last good state: lanes by name, base first
    std::string failed_at; ///< time at which the run met what ended it; `time` where nothing failed
    std::string steps, rejected, rhs_calls, seconds; ///< numbers as printed
    std::string newton, decompositions; ///< Newton iterations and factorisations of implicit methods; else empty
    bool searches = false;              ///< controls are searched for, and followed
    std::vector<EventReport> events;
    std::vector<Drift> invariants;
    std::optional<long double> tolerance; ///< relative, of an adaptive method
    bool energy_changes = false;          ///< forces or explicit time: the energy is not conserved
    Table table;
};

/// Whether a run came to its end, or to that of its own event.
[[nodiscard]] bool succeeded(const std::string& status);

/// The object of `run --format json`; numbers keep their digits, what is not finite is null.
[[nodiscard]] std::string report_json(const RunOutcome& outcome);

/// A few lines for standard error: status, steps, events, drift of the invariants.
[[nodiscard]] std::string report_text(const RunOutcome& outcome);

} // namespace lagen
