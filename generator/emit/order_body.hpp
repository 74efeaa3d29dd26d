// SPDX-License-Identifier: GPL-2.0-or-later
/// The order in which a function body computes its named nodes and stores its outputs: each next to its first use, and,
/// of several such orders, one that keeps few values alive at a time.
#pragma once

#include "graph/terms/group_terms.hpp"

#include <limits>
#include <map>

namespace lagen {

// Which nodes of a function body get a name. Operations that take long and that a processor does on several numbers at
// once stand together: the sines and cosines of all angles, square roots and reciprocals where there are several.
// Stumpff functions of one argument are all named: they come from one call. Groups of alike terms are all named too:
// each is one operation on vectors.

/// No node.
inline constexpr NodeId no_node = std::numeric_limits<NodeId>::max();

/// Operations that one call computes; none of them depends on another's result.
struct Batch {
    enum class Kind { angles, roots, reciprocals, terms } kind = Kind::angles;
    std::vector<NodeId> arguments; ///< angles, radicands or divisors, ascending; what the lanes of terms are made of
    std::vector<NodeId> values;    ///< the nodes, one an argument: sines, roots, quotients; no_node where not used
    std::vector<NodeId> cosines;   ///< the same for cosines; empty for other kinds
    std::size_t group = 0;         ///< of terms: which
    bool taken_apart = false;      ///< of terms: a lane is read by itself
};

struct BodyPlan {
    std::vector<bool> named; ///< by node: has a statement; all factors and solves have
    std::vector<bool> used;  ///< by node: reachable from the outputs
    std::vector<Batch> batches;
    std::map<NodeId, std::size_t> batch_of;
    /// Used Stumpff functions by argument, components by solve, solves by factor; ascending.
    std::map<NodeId, std::vector<NodeId>> users;

    /// The Stumpff functions of the argument of `id`, itself among them.
    [[nodiscard]] std::vector<NodeId> family_of(const Graph& graph, NodeId id) const;
};

/// What `kept` are is computed too, though it is no output.
[[nodiscard]] BodyPlan plan_body(const Graph& graph, std::span<const NodeId> outputs, const AlikeGroups& terms = {},
                                 std::span<const NodeId> kept = {});

/// True where a power is spelled out by a chain of squares, a statement each (|exponent| > 4).
[[nodiscard]] bool needs_chain(const Graph& graph, NodeId id);

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
