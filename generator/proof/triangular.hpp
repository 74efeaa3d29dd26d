// SPDX-License-Identifier: GPL-2.0-or-later
/// Base constraints in triangular form: each solves for a coordinate of its own, linearly or as a monic power.
#pragma once

#include "proof/normal_form.hpp"
#include "text/diagnostic.hpp"

namespace lagen::proof {

/// The constraints in an order in which each can be solved from what the earlier ones leave. Coordinates that stand
/// under a function or in a divisor of a constraint are not solved for. Throws TriangularityError.
[[nodiscard]] std::vector<SolvedConstraint> triangular_constraints(const Graph& graph, const ProofSetting& setting);

/// Leaves out each constraint that is not triangular beside those before it: what is proved on the larger set holds on
/// M. True where some were.
bool keep_triangular(const Graph& graph, ProofSetting& setting);

} // namespace lagen::proof
