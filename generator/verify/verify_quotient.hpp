// SPDX-License-Identifier: GPL-2.0-or-later
/// That a reduced model on TQ/G has the motions of an invariant Lagrangian.
#pragma once

#include "mechanics/quotient.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// What is decided of x.W on the base of an action groupoid: all that is claimed of that, but of the action
///   action (w, x)   <-e_b (x.W)^i = xi_b^i(x.W),   xi_b = rho(e_b)
/// With x.1 = x this is x.(W V) = (x.W).V near the identity and, where all is analytic, on the connected group; an
/// angle may hold up to full turns, to which its rates are blind.
[[nodiscard]] StructureReport verify_right_action(const System& moving, const ProofBudget& budget = {});

/// True where a function f(t, x, y) on TQ is invariant, xi_b^c(f) = 0 for the generator number b; false where a proof
/// is not found.
[[nodiscard]] bool is_invariant(Graph& graph, const System& whole, const InfinitesimalAction& action, NodeId f,
                                const ProofBudget& budget = {});

/// True where the set f > 0 of the base is invariant: xi_b(f) = c_b f with constants c_b; false likewise.
[[nodiscard]] bool is_invariant_set(Graph& graph, const System& whole, const InfinitesimalAction& action, NodeId f,
                                    const ProofBudget& budget = {});

/// A check `symmetry` (w) a generator: the complete lift of xi_b leaves L.
[[nodiscard]] StructureReport verify_symmetry(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                              const std::vector<std::string>& names, const ProofBudget& budget = {});

/// A check `projects` a fibre coordinate of `reduced`, whose base coordinates, horizontal sections and generators stand
/// in the order of `quotient`: its Lagrange expression is that of the whole along d/dm^i, s xi_b, at the points of the
/// slice, for all velocities and accelerations. Nothing is taken from the theorem: two derivations are compared.
[[nodiscard]] StructureReport verify_quotient(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                              const Quotient& quotient, const System& reduced,
                                              const ProofBudget& budget = {});

} // namespace lagen
