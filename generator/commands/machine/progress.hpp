// SPDX-License-Identifier: GPL-2.0-or-later
/// Progress of a long run: one line on standard error, on a terminal only, after half a second.
#pragma once

#include <chrono>

namespace lagen {

class Progress {
  public:
    Progress(double start, double end);
    /// The run has come to this time.
    void show(double time);
    /// Wipes the line.
    void clear();

  private:
    double start_;
    double end_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point next_;
};

} // namespace lagen
