// SPDX-License-Identifier: GPL-2.0-or-later
/// A flag that SIGINT, SIGTERM and SIGHUP set while it is there, in the place of what they do otherwise, also those
/// that were held back before. One at a time.
#pragma once

#include "commands/machine/temporary_folder.hpp"

namespace lagen {

class InterruptFlag {
  public:
    InterruptFlag();

    /// Not zero where one of them came.
    [[nodiscard]] const volatile std::sig_atomic_t* flag() const;

  private:
    InterruptsAnswered answered_;
};

} // namespace lagen
