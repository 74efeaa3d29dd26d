// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/values.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

namespace lagen {

long double TreeValues::operator()(const Tree& tree, const Values& values)
{
    auto place = lowered_.find(tree);
    if (place == lowered_.end()) {
        Lowered lowered;
        lowered.root = Lowering(lowered.graph)(tree);
        place = lowered_.emplace(tree, std::move(lowered)).first;
    }
    return evaluate<long double>(place->second.graph, {&place->second.root, 1}, values)[0];
}

std::optional<Rational> exact_value(const Tree& tree)
{
    Graph graph;
    const NodeId root = Lowering(graph)(tree);
    const std::vector<Rational> exact = evaluate_exactly(graph, {&root, 1}, {});
    return exact.empty() ? std::nullopt : std::optional(exact[0]);
}

} // namespace lagen
