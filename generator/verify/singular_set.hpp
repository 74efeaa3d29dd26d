// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the fibre Hessian is known to be singular, as points and as equations.
#pragma once

#include "proof/decide.hpp"

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

} // namespace lagen
