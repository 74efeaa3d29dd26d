// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels that are computed by columns, as a Jacobian is of directional derivatives: what is free of the direction
/// once (NAME_point), the rest for several unit vectors at a time (NAME_sweep), by
/// runtime/include/lagen/lanes/columns.hpp.
#pragma once

#include "emit/print_function.hpp"
#include "emit/print_kernel.hpp"

namespace lagen {

/// The functions NAME_point and NAME_sweep; answers the lines that compute `values` by them.
[[nodiscard]] std::vector<std::string> print_columns(TextBlock& out, const KernelModule& module,
                                                     const ModuleNames& names, const Kernel& kernel,
                                                     std::size_t longest_part, Includes& includes);

} // namespace lagen
