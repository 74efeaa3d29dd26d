// SPDX-License-Identifier: GPL-2.0-or-later
/// What lasts longer than two seconds is shown on one line of standard error, where that is a terminal, until it ends.
#pragma once

namespace lagen {

/// Looks at the stages of what this process computes while it lives; one at a time.
class StageWatch {
  public:
    /// Nothing is shown where standard error is no terminal.
    StageWatch();
    ~StageWatch();
    StageWatch(const StageWatch&) = delete;
    StageWatch& operator=(const StageWatch&) = delete;
};

/// Wipes the line, if there is one: something else is written now.
void wipe_stage_line();

} // namespace lagen
