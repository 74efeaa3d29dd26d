// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/machine/interrupt_flag.hpp"

#include "commands/machine/temporary_folder.hpp"

namespace lagen {

namespace {

constexpr std::array watched_signals{SIGINT, SIGTERM, SIGHUP};

/// A handler can reach nothing but a static object.
volatile std::sig_atomic_t interrupt_raised = 0;
extern "C" void raise_interrupt_flag(int)
{
    interrupt_raised = 1;
}

} // namespace

InterruptFlag::InterruptFlag()
{
    interrupt_raised = 0;
    struct sigaction action {};
    action.sa_handler = raise_interrupt_flag;
    sigemptyset(&action.sa_mask);
    for (std::size_t k = 0; k < watched_signals.size(); ++k) ::sigaction(watched_signals[k], &action, &before_[k]);
    const sigset_t signals = interrupt_signals();
    sigprocmask(SIG_UNBLOCK, &signals, &mask_before_);
}

InterruptFlag::~InterruptFlag()
{
    sigprocmask(SIG_SETMASK, &mask_before_, nullptr);
    for (std::size_t k = 0; k < watched_signals.size(); ++k) ::sigaction(watched_signals[k], &before_[k], nullptr);
}

const volatile std::sig_atomic_t* InterruptFlag::flag() const
{
    return &interrupt_raised;
}

} // namespace lagen
