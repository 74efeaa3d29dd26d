// SPDX-License-Identifier: GPL-2.0-or-later
/// How far a sweep is and how long it will take, on standard error: a line that is rewritten on a terminal, else a line
/// every minute.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lagen {

/// "3 s", "4 min 10 s", "5 h 2 min", "3 d 4 h".
[[nodiscard]] std::string duration_text(double seconds);

class SweepProgress {
  public:
    /// `done` of `rows` rows are there.
    SweepProgress(std::uint64_t done, std::uint64_t rows);
    void show(std::uint64_t done, std::uint64_t failed);
    /// Wipes the line.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    std::uint64_t first_, rows_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now(), next_;
};

} // namespace lagen
