// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/group_chart.hpp"

#include "groupoid/cayley.hpp"
#include "groupoid/generator_span.hpp"

namespace lagen {

bool has_chart(const Groupoid& groupoid)
{
    return groupoid.has_cayley_map && groupoid.size <= most_chart_rows;
}

GroupChart group_chart(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& W, const std::string& name)
{
    GroupChart chart;
    for (std::size_t c = 0; c < groupoid.generators.size(); ++c)
        chart.s.push_back(graph.input(name + "(" + std::to_string(c + 1) + ")"));
    chart.element = replacements(W, cayley(graph, GeneratorSpan(graph, groupoid).matrix(chart.s), groupoid.size));
    return chart;
}

} // namespace lagen
