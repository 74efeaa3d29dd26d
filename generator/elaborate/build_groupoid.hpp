// SPDX-License-Identifier: GPL-2.0-or-later
/// The groupoid of a model on a graph.
#pragma once

#include "geometry/exponential.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/system.hpp"
#include "model/model.hpp"

namespace lagen {

/// Of a model that has one; declares the coordinates of its arrows. An Atiyah groupoid has the connection of
/// [algebroid] kind = "atiyah", where there is one. Throws ModelError where the generators are dependent.
[[nodiscard]] Groupoid lower_groupoid(Graph& graph, Lowering& lower, const Model& model);

/// Throws ModelError where the commutator of two generators is no combination of the generators, or is not shown to be
/// one.
void require_groupoid(const Model& model);

/// True where it is shown that the Cayley map leads from the algebra of the model's group into the group.
[[nodiscard]] bool has_cayley_map(const Model& model);

/// exp over the inputs s, of the group of the system.
[[nodiscard]] Exponential closed_exponential(Graph& graph, const System& system, std::vector<NodeId> s);

} // namespace lagen
