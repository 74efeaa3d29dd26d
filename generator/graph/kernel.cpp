// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/kernel.hpp"

#include "diagnostic.hpp"

#include <algorithm>

namespace lagen {

std::vector<NodeId> nodes_of(const Kernel& kernel)
{
    std::vector<NodeId> nodes;
    for (const KernelOutput& output : kernel.outputs)
        for (const KernelEntry& entry : output.entries) nodes.push_back(entry.node);
    return nodes;
}

std::vector<Quantity> lanes_of(const KernelModule& module)
{
    std::vector<Quantity> lanes;
    for (const LaneGroup& group : module.groups) lanes.insert(lanes.end(), group.lanes.begin(), group.lanes.end());
    return lanes;
}

std::vector<KernelInput> point_inputs(const KernelModule& module)
{
    const std::vector<Quantity> lanes = lanes_of(module);
    return {{"t", ArrayRole::time, {}, {{"t", {}, {}, module.time}}},
            {"s", ArrayRole::state, {1, lanes.size(), 1}, lanes}};
}

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
