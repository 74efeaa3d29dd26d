// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of a sweep on their way through its program: starts in, finished lines out.
#pragma once

#include "commands/sweep/sweep_file.hpp"
#include "commands/sweep/sweep_rows.hpp"
#include "lagen_run/job.hpp"
#include "machine/progress_line.hpp"
#include "scene/run_record.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <set>
#include <string>

namespace lagen {

/// "3 s", "4 min 10 s", "5 h 2 min", "3 d 4 h".
[[nodiscard]] std::string duration_text(double seconds);

/// What does not change from row to row.
struct SweepSetting {
    const Model& model;
    const Scene& scene;
    const RunRecord& record;
    std::size_t threads = 1;
};

/// The heading of the table: index, swept names, t, the scene's columns, event.NAME.count and event.NAME.t of its
/// events, min and max of its columns, status. With its line end.
[[nodiscard]] std::string sweep_heading(const SweepSetting& setting, const SweepRows& rows);

class SweepRun {
  public:
    /// `file` has its first rows already.
    SweepRun(const SweepSetting& setting, const SweepRows& rows, const Shard& shard, StartState start, SweepFile& file);

    /// Computes what is left. Throws Error where it is interrupted, MachineError where the program or the file fails.
    void run();

    /// Why rows had no start, once a status: "row 3: ..".
    [[nodiscard]] const std::map<std::string, std::string>& reasons() const { return reasons_; }

    /// How many rows have values for which their equations are not proved.
    [[nodiscard]] std::uint64_t unproved() const { return unproved_; }

    /// How many rows have lanes that moved and never exceeded the absolute tolerance, and the names of these lanes.
    [[nodiscard]] std::uint64_t rows_below_absolute() const { return rows_below_absolute_; }
    [[nodiscard]] const std::set<std::string>& lanes_below_absolute() const { return lanes_below_absolute_; }

  private:
    [[nodiscard]] detail::SweepJob job() const;
    std::string next_starts();
    void append_start(std::string& bytes, std::uint64_t index);
    [[nodiscard]] std::string progress() const;
    std::string start_of(const std::vector<std::string>& texts);
    [[nodiscard]] const std::string& failed_status(const std::string& number) const;
    void take(const char* bytes, std::size_t count);
    void take_small_lanes(std::string& line);

    const SweepSetting& setting_;
    const SweepRows& rows_;
    Shard shard_;
    StartState start_;
    SweepFile& file_;
    std::uint64_t first_rows_; ///< that were there before
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    ProgressLine progress_{std::chrono::minutes(1)};
    SceneEvaluator evaluate_;
    ProgramInput input_;
    Values parameters_, initial_;
    std::uint64_t next_ = 0;            ///< row
    std::deque<std::string> pending_;   ///< the first fields of rows that the program has
    std::vector<std::string> failures_; ///< statuses of rows without a start, by the program's number from 1 on
    std::map<std::string, std::string> reasons_;
    std::uint64_t unproved_ = 0, rows_below_absolute_ = 0;
    std::set<std::string> lanes_below_absolute_;
    std::string unfinished_; ///< the beginning of a line
};

} // namespace lagen
