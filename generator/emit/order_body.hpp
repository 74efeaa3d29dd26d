// SPDX-License-Identifier: GPL-2.0-or-later
/// The order in which a function body computes its named nodes and stores its outputs: each next to its first use, and,
/// of several such orders, one that keeps few values alive at a time.
#pragma once

#include "emit/plan_body.hpp"

namespace lagen {

struct BodyStep {
    enum class Kind {
        load,   ///< reads an input
        define, ///< computes a named node, a batch, a family, a factorisation or a solution
        check,  ///< of a divisor that must not vanish
        store,  ///< of the output `index`
        keep,   ///< puts a value into place `index` of the workspace, for a later part of the function
        recall, ///< takes it out
    } kind = Kind::define;
    NodeId node = 0;
    std::size_t index = 0;
    std::vector<NodeId> defines = {}; ///< nodes that get a name by it
    std::vector<NodeId> needs = {};   ///< nodes with a name (inputs too) that it reads
};

/// A step of the kind define, check or store with what it defines and needs.
[[nodiscard]] BodyStep make_step(const Graph& graph, const BodyPlan& plan, BodyStep::Kind kind, NodeId node,
                                 std::size_t index = 0);

/// Roots of a body: the outputs, and divisors to be checked where they are computed.
struct BodyRoots {
    std::span<const NodeId> outputs;
    std::span<const NodeId> checked;
    /// Other orders of the outputs that the function may follow (by columns for a matrix).
    std::vector<std::vector<std::size_t>> arrangements;
    std::span<const NodeId> kept = {}; ///< computed, but stored nowhere
};

/// Steps of the kinds define, check and store.
[[nodiscard]] std::vector<BodyStep> order_body(const Graph& graph, const BodyPlan& plan, const BodyRoots& roots);

} // namespace lagen
