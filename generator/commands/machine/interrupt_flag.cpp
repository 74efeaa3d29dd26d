// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/machine/interrupt_flag.hpp"

namespace lagen {

namespace {

/// A handler can reach nothing but a static object.
volatile std::sig_atomic_t interrupt_raised = 0;
extern "C" void raise_interrupt_flag(int)
{
    interrupt_raised = 1;
}

} // namespace

InterruptFlag::InterruptFlag() : answered_((interrupt_raised = 0, raise_interrupt_flag)) {}

const volatile std::sig_atomic_t* InterruptFlag::flag() const
{
    return &interrupt_raised;
}

} // namespace lagen
