// SPDX-License-Identifier: GPL-2.0-or-later
/// Making and removing a temporary folder with interrupts held back.
#include "machine/temporary_folder.hpp"

#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace lagen {

namespace {

constexpr std::array interrupts_of_users{SIGINT, SIGTERM, SIGHUP};

} // namespace

sigset_t interrupt_signals()
{
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : interrupts_of_users) sigaddset(&signals, signal);
    return signals;
}

InterruptsHeld::InterruptsHeld()
{
    const sigset_t signals = interrupt_signals();
    sigprocmask(SIG_BLOCK, &signals, &before_);
}

InterruptsHeld::~InterruptsHeld()
{
    sigprocmask(SIG_SETMASK, &before_, nullptr);
}

InterruptsAnswered::InterruptsAnswered(void (*handler)(int))
{
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    for (std::size_t k = 0; k < before_.size(); ++k) ::sigaction(interrupts_of_users[k], &action, &before_[k]);
    const sigset_t signals = interrupt_signals();
    sigprocmask(SIG_UNBLOCK, &signals, &mask_before_);
}

InterruptsAnswered::~InterruptsAnswered()
{
    sigprocmask(SIG_SETMASK, &mask_before_, nullptr);
    for (std::size_t k = 0; k < before_.size(); ++k) ::sigaction(interrupts_of_users[k], &before_[k], nullptr);
}

TemporaryFolder::TemporaryFolder(const std::string& parent, const std::string& stem)
    : path_(parent + "/" + stem + "-XXXXXX")
{
    if (::mkdtemp(path_.data()) == nullptr)
        throw MachineError(fmt::format("cannot make a folder in '{}': {}", parent, std::strerror(errno)));
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string shared_temporary_folder()
{
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (error) {
        throw MachineError(fmt::format("there is no folder for temporary files: {}", error.message()),
                           "set TMPDIR to a folder that can be written");
    }
    return folder.string();
}

} // namespace lagen
