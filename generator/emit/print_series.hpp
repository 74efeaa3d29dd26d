// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor coefficients of the motion, order by order, as a function of a generated class.
#pragma once

#include "emit/print_kernel.hpp"

namespace lagen {

/// The kernel has a recurrence.
void print_series(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  Includes& includes);

} // namespace lagen
