// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/kernel.hpp"

#include "graph/calculus/differentiate.hpp"
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

namespace {

/// Lanes that are neither coordinates nor velocities or momenta.
std::optional<std::string> further_lanes(const KernelModule& module)
{
    for (std::size_t k = 2; k < module.groups.size(); ++k)
        if (!module.groups[k].lanes.empty())
            return fmt::format("{} is neither a coordinate nor a velocity or momentum",
                               module.groups[k].lanes.front().name);
    return std::nullopt;
}

/// Coordinates, and velocities or momenta: lanes of the first two groups, or of a single one its halves.
std::pair<std::vector<Quantity>, std::vector<Quantity>> halves(const KernelModule& module)
{
    const std::vector<Quantity>& lanes = module.groups.at(0).lanes;
    if (module.groups.size() > 1) return {lanes, module.groups[1].lanes};
    const auto middle = lanes.begin() + static_cast<std::ptrdiff_t>(lanes.size() / 2);
    return {{lanes.begin(), middle}, {middle, lanes.end()}};
}

} // namespace

SecondOrder second_order_of(const KernelModule& module, const std::vector<NodeId>& rates)
{
    using Kind = SecondOrder::Kind;
    const auto both = halves(module);
    const std::vector<Quantity>&x = both.first, &v = both.second;
    if (const auto obstacle = further_lanes(module)) return {Kind::no, *obstacle};
    if (x.size() != v.size() || x.empty())
        return {Kind::no,
                fmt::format("the numbers of base coordinates and of other lanes are {} and {}", x.size(), v.size())};
    for (std::size_t i = 0; i < x.size(); ++i)
        if (rates[i] != v[i].input) return {Kind::no, fmt::format("{}' is not {}", x[i].name, v[i].name)};
    for (std::size_t i = 0; i < v.size(); ++i) {
        const auto depends = [&](NodeId input) {
            return depends_on_any(*module.graph, std::array{rates[x.size() + i]}, std::array{input});
        };
        for (const Quantity& lane : v)
            if (depends(lane.input)) return {Kind::general, fmt::format("{}' depends on {}", v[i].name, lane.name)};
        // What an unknown depends on is said by its equations.
        for (const ImplicitBlock& block : module.implicit)
            if (std::ranges::any_of(block.unknowns, depends))
                return {Kind::general, fmt::format("{}' depends on what is solved for in every call", v[i].name)};
    }
    return {Kind::velocity_free, ""};
}

Separation separation_of(const KernelModule& module)
{
    using Kind = Separation::Kind;
    const auto both = halves(module);
    const std::vector<Quantity>&x = both.first, &y = both.second;
    if (const auto obstacle = further_lanes(module)) return {Kind::no, *obstacle};
    if (x.empty()) return {Kind::no, "there are no base coordinates x"};
    const auto depends = [&module](NodeId node, NodeId input) {
        return depends_on_any(*module.graph, std::array{node}, std::array{input});
    };
    std::vector<NodeId> velocities, rates, inputs{module.time};
    for (const KernelEntry& entry : kernel_named(module, "rhs").outputs.at(0).entries) {
        const bool base = entry.row < x.size();
        const std::string& name = base ? x[entry.row].name : y[entry.row - x.size()].name;
        for (const Quantity& lane : base ? x : y)
            if (depends(entry.node, lane.input)) return {Kind::no, fmt::format("{}' depends on {}", name, lane.name)};
        // What an unknown depends on is said by its equations.
        for (const ImplicitBlock& block : module.implicit)
            for (const NodeId unknown : block.unknowns)
                if (depends(entry.node, unknown))
                    return {Kind::no, fmt::format("{}' depends on what is solved for in every call", name)};
        if (base) velocities.push_back(entry.node);
    }
    for (const Quantity& lane : y) rates.push_back(lane.input);
    inputs.insert(inputs.end(), rates.begin(), rates.end());
    const auto slopes = jacobian(*module.graph, velocities, rates);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
        if (depends(velocities[i], module.time)) return {Kind::separable, fmt::format("{}' depends on t", x[i].name)};
        for (std::size_t j = 0; j < rates.size(); ++j)
            if (depends_on_any(*module.graph, std::array{slopes[i][j]}, inputs))
                return {Kind::separable, fmt::format("{}' is not affine in {}", x[i].name, y[j].name)};
    }
    return {Kind::affine, ""};
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
