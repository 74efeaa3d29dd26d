// SPDX-License-Identifier: GPL-2.0-or-later
/// A flag that SIGINT, SIGTERM and SIGHUP set while it is there, in the place of what they do otherwise, also those
/// that were held back before. One at a time.
#pragma once

#include <array>
#include <csignal>

namespace lagen {

class InterruptFlag {
  public:
    InterruptFlag();
    ~InterruptFlag();
    InterruptFlag(const InterruptFlag&) = delete;
    InterruptFlag& operator=(const InterruptFlag&) = delete;

    /// Not zero where one of them came.
    [[nodiscard]] const volatile std::sig_atomic_t* flag() const;

  private:
    std::array<struct sigaction, 3> before_{};
    sigset_t mask_before_{};
};

} // namespace lagen
