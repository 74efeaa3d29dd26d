// SPDX-License-Identifier: GPL-2.0-or-later
/// Matrices of a distribution: are their rows independent, and do brackets of sections stay in the rows' span?
#pragma once

#include "mechanics/nonholonomic.hpp"
#include "verify/judge.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// A_alpha^a, by rows of r entries.
[[nodiscard]] std::vector<NodeId> section_rows(Graph& graph, const System& system);
/// B^A_a = dPsi^A/dY^a, likewise.
[[nodiscard]] std::vector<NodeId> constraint_rows(Graph& graph, const System& system);

/// Are the rows, called `names`, independent at every point? Proved by a minor that vanishes nowhere, or squares of
/// minors whose sum does not, perhaps where factors of parameters alone do not; refuted where all minors are zero, with
/// a combination of the rows that is, or at a point where they are. Of rows that are linear parts of constraints
/// `values` are the constraints at Y = 0: where a combination of them is not zero they contradict each other.
[[nodiscard]] Check independence(Graph& graph, const std::vector<NodeId>& rows, std::vector<std::string> names,
                                 Judge& judge, const std::vector<NodeId>& values = {});

/// Do all brackets [e_alpha, e_beta] lie in D? The first that does not, in components on Y, with a form that vanishes
/// on D and not on it: one of `given` (by rows of r entries) where there are some, else a minor of the sections with
/// one row more.
[[nodiscard]] Integrability decide_integrability(Graph& graph, const System& system, const ProofSetting& setting,
                                                 const ProofBudget& budget, const std::vector<NodeId>& given);

} // namespace lagen
