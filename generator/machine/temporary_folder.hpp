// SPDX-License-Identifier: GPL-2.0-or-later
/// A folder of ours that is gone afterwards, whatever happens to the process short of SIGKILL.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace lagen {

/// Holds back SIGINT, SIGTERM and SIGHUP while it lives: what must be tidied up is tidied up before they are answered.
/// `run_process` lets them through to its child meanwhile.
class InterruptsHeld {
  public:
    InterruptsHeld();
    ~InterruptsHeld();
    InterruptsHeld(const InterruptsHeld&) = delete;
    InterruptsHeld& operator=(const InterruptsHeld&) = delete;

  private:
    sigset_t before_{};
};

/// Answers these signals by `handler` while it lives, also those that were held back before; then as before.
class InterruptsAnswered {
  public:
    explicit InterruptsAnswered(void (*handler)(int));
    ~InterruptsAnswered();
    InterruptsAnswered(const InterruptsAnswered&) = delete;
    InterruptsAnswered& operator=(const InterruptsAnswered&) = delete;

  private:
    std::array<struct sigaction, 3> before_{};
    sigset_t mask_before_{};
};

/// The signals above.
[[nodiscard]] sigset_t interrupt_signals();

class TemporaryFolder {
  public:
    /// Makes `parent`/`stem`-XXXXXX, for this user alone; MachineError where that cannot be done.
    TemporaryFolder(const std::string& parent, const std::string& stem);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    InterruptsHeld held_;
    std::string path_;
};

/// TMPDIR, else /tmp; MachineError where it is no folder.
[[nodiscard]] std::string shared_temporary_folder();

} // namespace lagen
