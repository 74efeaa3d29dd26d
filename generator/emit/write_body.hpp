// SPDX-License-Identifier: GPL-2.0-or-later
/// The statements of one generated function: inputs loaded into locals, named terms, factorisations, and the
/// expressions of the outputs, each as soon as it is known.
#pragma once

#include "emit/statement.hpp"
#include "graph/terms/group_terms.hpp"

#include <map>

namespace lagen {

/// How inputs are called inside a function, and which names are taken there.
struct LocalNames {
    std::map<NodeId, std::string> inputs; ///< local name of every input
    std::set<std::string> taken;          ///< all of them, and the names that the header uses itself
};

/// Which factorisations a function checks.
enum class Checking {
    none,       ///< the function returns no status
    state,      ///< those that depend on time or state
    parameters, ///< those that depend on neither
};

/// Alike terms on vectors, as long as the body is not cut.
struct BodyTerms {
    AlikeGroups groups;
    std::map<std::size_t, std::string> names = {}; ///< of the groups that are inputs
    std::vector<NodeId> kept = {};                 ///< computed, but stored nowhere
};

/// `moving` are the inputs that change during a run (time and state): factorisations that depend on none of them
/// are checked once, before it. `pivots` are further factorisations to check, and divisors whose vanishing is a
/// singular matrix too.
struct BodyRequest {
    const Graph& graph;
    const LocalNames& names;
    std::span<const NodeId> outputs;
    std::span<const NodeId> pivots;
    std::span<const NodeId> moving;
    Checking checking = Checking::none;
    /// Other orders in which the outputs may be stored.
    std::vector<std::vector<std::size_t>> arrangements = {};
    std::size_t longest_part = 0; ///< steps; 0: the body stays whole
    BodyTerms terms = {};
    std::string type = "S"; ///< of what is computed, but factorisations, which are always of S
};

[[nodiscard]] Body write_body(const BodyRequest& request);

} // namespace lagen
