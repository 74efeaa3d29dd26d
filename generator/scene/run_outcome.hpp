// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run gave.
#pragma once

#include "lagen_run/report.hpp"
#include "scene/table.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

/// Whether it is followed without being claimed: E, or H.
[[nodiscard]] inline bool is_energy(const detail::Drift& drift)
{
    return drift.name == "energy" || drift.name == "hamiltonian";
}

/// The action over a run, its first variations as their two parts, its second variations, and for each the square of a
/// bound of the integrals of |term| of the terms of the first variation.
struct ActionReport {
    double action = 0;
    std::vector<double> base, fibre, second, squares; ///< one a variation
};

/// The report of a run, with what lagen knows besides.
/// What a run of a least model left out.
struct LeastNote {
    std::size_t states = 0, of = 0;
    std::vector<std::string> relations, not_followed;
};

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
    std::optional<LeastNote> least{};        ///< of a least model
    Table table;
};

/// Whether a run came to its end, or to that of its own event.
[[nodiscard]] inline bool succeeded(const std::string& status)
{
    return status == "ok" || status == "stopped_by_event";
}

/// By the user: there are the rows so far.
[[nodiscard]] inline bool is_interrupted(const RunOutcome& outcome)
{
    return outcome.status == "interrupted";
}

} // namespace lagen
