// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions on the graph as short trees: what several of them share is written once, under a name.
#pragma once

#include "graph/core/graph.hpp"
#include "typeset/equation_set.hpp"

#include <functional>
#include <map>

namespace lagen {

/// Parts of some functions: `nodes` on the graph, and `written` where each is written out as often as it is used.
struct PartCount {
    double written = 0;
    std::size_t nodes = 0;
};
[[nodiscard]] PartCount count_parts(const Graph& graph, std::span<const NodeId> roots);

/// The functions as trees, one a root, and what the names in them stand for, each over those before it.
struct SharedParts {
    std::vector<Tree> values;
    std::vector<WhereEntry> where;
};

/// `known` are nodes with names of their own; other parts that are used more than once and long are s1, s2, .. in order
/// of evaluation, or s_1, .. where one of these `is_taken`.
[[nodiscard]] SharedParts shared_parts(const Graph& graph, std::span<const NodeId> roots,
                                       const std::map<NodeId, std::string>& known,
                                       const std::function<bool(const std::string&)>& is_taken);

} // namespace lagen
