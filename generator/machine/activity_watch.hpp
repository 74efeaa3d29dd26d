// SPDX-License-Identifier: GPL-2.0-or-later
/// A computation of more than two seconds is shown on one line of standard error, where that is a terminal, until it
/// ends.
#pragma once

namespace lagen {

/// Looks at the activities of what this process computes while it lives; one at a time.
class ActivityWatch {
  public:
    /// Nothing is shown where standard error is no terminal.
    ActivityWatch();
    ~ActivityWatch();
    ActivityWatch(const ActivityWatch&) = delete;
    ActivityWatch& operator=(const ActivityWatch&) = delete;
};

/// Wipes the line, if there is one: something else is written now.
void wipe_activity_line();

} // namespace lagen
