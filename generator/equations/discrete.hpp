// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Lagrangian mechanics for a person: the target of an arrow g, the momenta F^-L(g) at its source and F^+L(g)
/// at its target, and the discrete Euler-Lagrange equations F^+L(g) = F^-L(h) of two arrows with t(g) = s(h).
#pragma once

#include "equations/symbolic_model.hpp"
#include "mechanics/system.hpp"

namespace lagen {

/// Throws MathematicsError where the model has no discrete Lagrangian that is written out.
[[nodiscard]] EquationSet derive_discrete(const Model& model, const System& system);

/// Throws MathematicsError likewise.
void require_written_discrete(const System& system);

/// A function of arrows without the entries of their matrices that are the same on the whole group.
[[nodiscard]] NodeId on_group(Graph& graph, const Groupoid& groupoid, std::initializer_list<Arrow> arrows, NodeId node);

/// Coordinates of these arrows, and the step, behind the names of the model in the order of terms.
void add_arrow_names(SymbolicModel& symbolic, const Graph& graph, std::initializer_list<Arrow> arrows);

} // namespace lagen
