// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/kernel.hpp"

#include "diagnostic.hpp"

#include <algorithm>

namespace lagen {

bool has_kernel(const KernelModule& module, const std::string& name)
{
    return std::ranges::find(module.kernels, name, &Kernel::name) != module.kernels.end();
}

const Kernel& kernel_named(const KernelModule& module, const std::string& name)
{
    const auto found = std::ranges::find(module.kernels, name, &Kernel::name);
    if (found == module.kernels.end()) throw InternalError("the module has no kernel '" + name + "'");
    return *found;
}

} // namespace lagen
