// SPDX-License-Identifier: GPL-2.0-or-later
/// Terms of one formula that are alike: the pairs of many bodies, the springs of a lattice. Nodes of the same
/// operations over operands that are alike themselves become the lanes of one operation on vectors [Larsen-Amarasinghe
/// 2000, superword level parallelism]. A group begins with slow operations (roots, quotients) that are alike, takes in
/// what its lanes are made of as long as that is alike too, and then what is made of it, lane by lane.
///
/// Alike nodes stand equally high over the leaves, so that none of a group depends on another, and no circle of groups
/// waits for itself. In registers of AVX-512 the Taylor coefficients of models/outer_solar_system.toml take half of the
/// time (g++ 12, -O2); beside it models/pleiades.toml alone has such groups.
#pragma once

#include "graph/core/graph.hpp"

#include <array>
#include <limits>
#include <map>
#include <optional>

namespace lagen {

/// An operand of a group.
struct TermOperand {
    std::optional<std::size_t> group; ///< lane l of this group
    std::vector<NodeId> nodes;        ///< else one node for all lanes, or one a lane

    bool operator==(const TermOperand&) const = default;
};

/// The same operation on every lane; of `sums`, the input that is one.
struct AlikeTerms {
    std::vector<NodeId> lanes;
    std::vector<TermOperand> operands;
    bool is_inverse_cube = false; ///< 1/(x sqrt(x)) of its one operand, the root and the product included
    bool is_included = false;     ///< in such a group, and read by nothing else
};

struct AlikeGroups {
    std::vector<AlikeTerms> groups;                                 ///< by their first lanes
    std::map<NodeId, std::pair<std::size_t, std::size_t>> place_of; ///< group and lane of a node

    [[nodiscard]] bool contains(NodeId id) const { return place_of.contains(id); }
};

/// What may stand in a group: an input only with others of its family.
struct TermRequest {
    std::span<const NodeId> outputs;           ///< all that is read
    std::vector<std::vector<NodeId>> families; ///< of inputs
    /// Inputs that are sums of products of two series, by whose latest terms a_k, b_k they are grouped.
    std::map<NodeId, std::array<NodeId, 2>> sums = {};
};

[[nodiscard]] AlikeGroups group_terms(const Graph& graph, const TermRequest& request);

} // namespace lagen
