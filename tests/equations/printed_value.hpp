// SPDX-License-Identifier: GPL-2.0-or-later
/// What a printed equation says in numbers.
#pragma once

#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// The right side of an equation where the names have these values.
inline long double value_of(const Equation& equation, const std::map<std::string, long double>& values)
{
    Graph graph;
    Lowering lower(graph);
    NodeId sum = graph.constant(0);
    for (const TermGroup& group : equation.groups) sum = graph.add(sum, lower(group.value));
    return evaluate<long double>(graph, {&sum, 1}, values)[0];
}

} // namespace lagen
