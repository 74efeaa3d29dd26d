// SPDX-License-Identifier: GPL-2.0-or-later
/// The values of a scene as they are written: 1/10 and sqrt(2) are no doubles, and a verdict at a bifurcation depends
/// on it. Where a number does not come of what is written alone (a start that is projected), the double is taken.
#pragma once

#include "pipeline.hpp"

namespace lagen {

/// Gives the parameters the scene's values, `values` in numbers; the regularity is decided anew where it rests on them.
void put_exact_parameters(CheckedModel& checked, const Scene& scene, const std::vector<long double>& values);

/// (x, mu) at the start as nodes without inputs; `state` is the same in numbers. `graph`: a copy of the system's.
[[nodiscard]] std::vector<NodeId> exact_start(Graph& graph, const System& system, const Scene& scene,
                                              const std::vector<long double>& state);

} // namespace lagen
