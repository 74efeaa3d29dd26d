// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/values.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

namespace lagen {

long double value_of(const Tree& tree, const Values& values)
{
    Graph graph;
    const NodeId output[] = {Lowering(graph)(tree)};
    return evaluate<long double>(graph, output, values)[0];
}

} // namespace lagen
