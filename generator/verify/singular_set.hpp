// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the fibre Hessian is known to be singular, as points and as equations.
#pragma once

#include "proof/decide.hpp"
#include "symbolic/shortest_form.hpp"

namespace lagen {

/// The factors of `determinants` that are not proved to be nonzero once the inputs of `defaults` have their values: one
/// of the determinants vanishes exactly where one of these does. Empty where they are too long for a reader. `setting`
/// is that before the replacement, `valued` decides after it.
[[nodiscard]] std::vector<std::string> singular_factors(Graph& graph, const ProofSetting& setting,
                                                        const ZeroDecider& valued,
                                                        const std::vector<std::pair<NodeId, NodeId>>& defaults,
                                                        const std::vector<NodeId>& determinants);

/// What a variable is on a slice: a constant node, and how it is shown.
struct SliceValue {
    NodeId node;
    PointValue shown;
};
/// pi/2, where a cosine vanishes.
[[nodiscard]] SliceValue quarter_turn(Graph& graph);

/// One point on each slice "a variable is zero" (or `value`) on which everything is defined and one of `determinants`
/// is proved to vanish; eight at most.
[[nodiscard]] std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting,
                                                      const ProofBudget& budget,
                                                      const std::vector<NodeId>& determinants);
[[nodiscard]] std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting,
                                                      const ProofBudget& budget,
                                                      const std::vector<NodeId>& determinants, const SliceValue& value);

/// The same on each slice "a parameter is zero".
[[nodiscard]] std::vector<NamedPoint> singular_parameters(Graph& graph, const ProofSetting& setting,
                                                          const ProofBudget& budget,
                                                          const std::vector<NodeId>& determinants);

/// The same where several variables are zero at once, as few as do: of those that the determinants depend on each
/// choice where they are eight at most, else all of them. For sums of squares, which vanish on no slice.
[[nodiscard]] std::optional<NamedPoint> singular_corner(Graph& graph, const ProofSetting& setting,
                                                        const ProofBudget& budget,
                                                        const std::vector<NodeId>& determinants);

// Fractions reduced by GiNaC, which is believed only where the zero decision confirms it, and their factors.

/// The names of inputs in the order in which a person writes them, parameters before variables.
[[nodiscard]] Order writing_order(const Graph& graph, const ProofSetting& setting);

/// `tree`, which is `node`, as a reduced fraction in its shortest form; none where that is not proved to be the same,
/// or cannot be made.
[[nodiscard]] std::optional<Tree> reduced_fraction(Graph& graph, NodeId node, const Tree& tree, const Order& order,
                                                   const ZeroDecider& decider);

/// The factors of the numerator of a reduced fraction, without exponents and numbers; nothing where the node is too
/// long for that. Where it is defined the node vanishes exactly where one of them does.
[[nodiscard]] std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order,
                                                          const ZeroDecider& decider);

} // namespace lagen
