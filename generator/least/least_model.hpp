// SPDX-License-Identifier: GPL-2.0-or-later
/// The least model of a scene: the smallest system that the rules find whose motion gives every column that the scene
/// watches, each event, jump and wall, for this start and these relations between parameters; and why.
#pragma once

#include "graph/simplify/simplify.hpp"
#include "kernels/formulation.hpp"
#include "least/reduction.hpp"

namespace lagen {

/// The rank of the differentials of what is wanted and of its derivatives along the motion, at one point where a minor
/// of that size is certainly not zero: no smooth reduction has fewer states.
struct CertifiedRank {
    std::size_t rank = 0;
    NamedPoint point;
};

struct LeastModel {
    LaneSystem full;
    Reduction reduction;
    CertifiedRank rank;
    OperationCount full_operations, least_operations; ///< of the rates
};

/// The motion of a scene in one form of the equations, with everything that the scene watches of it.
[[nodiscard]] LaneSystem lane_system(const Model& model, const System& system, const Report& report,
                                     const Scene& scene);

[[nodiscard]] CertifiedRank certified_rank(Reduction& reduction);

[[nodiscard]] LeastModel least_model(LaneSystem system);

} // namespace lagen
