// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/non_finite.hpp"

#include "graph/calculus/limits.hpp"
#include "graph/core/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// The place of the first of these nodes that is not finite; their number where all are.
std::size_t first_non_finite(const Graph& graph, const std::vector<NodeId>& nodes,
                             const std::map<std::string, double>& at)
{
    const std::vector<double> values = evaluate<double>(graph, nodes, at);
    const auto found = std::ranges::find_if(values, [](double value) { return !std::isfinite(value); });
    return static_cast<std::size_t>(found - values.begin());
}

} // namespace

std::string non_finite_entry(const KernelModule& module, const std::map<std::string, double>& at)
{
    if (!module.implicit.empty() || !has_kernel(module, "rhs")) return {};
    Graph& graph = *module.graph;
    const std::vector<NodeId> rates = nodes_of(kernel_named(module, "rhs"));
    const auto has_value = [&](NodeId id) { return graph.op(id) != Op::input || at.contains(graph.input_name(id)); };
    if (!std::ranges::all_of(reachable(graph, rates), has_value)) return {};
    const std::vector<Quantity> lanes = lanes_of(module);
    if (const std::size_t k = first_non_finite(graph, rates, at); k < rates.size() && rates.size() == lanes.size())
        return fmt::format("the rate of {}", lanes[k].name);
    for (const Quantity& lane : lanes) {
        const std::vector<std::vector<NodeId>> column =
            jacobian_with_limits(graph, rates, std::vector<NodeId>{lane.input});
        std::vector<NodeId> slopes;
        for (const std::vector<NodeId>& row : column) slopes.push_back(row[0]);
        const std::size_t k = first_non_finite(graph, slopes, at);
        if (k < slopes.size() && slopes.size() == lanes.size())
            return fmt::format("the derivative of the rate of {} by {}", lanes[k].name, lane.name);
    }
    return {};
}

} // namespace lagen
