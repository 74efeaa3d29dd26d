// SPDX-License-Identifier: GPL-2.0-or-later
/// Variations of curves in E by a curve of sections s(t), with the first and second variation of the action of L:
///   delta x^i = rho^i_a s^a,      delta y^a = sdot^a + C^a_bc y^b s^c
///   delta L = EL_a s^a + d/dt (p_a s^a),      EL_a = rho_a(L) - d/dt p_a - p_c C^c_ab y^b
///   delta^2 L = delta (delta L) at fixed s: along a solution its integral is the second variation of the action
/// Jacobi's equation d/dt (delta p_a) = delta (rho_a(L) - p_c C^c_ab y^b) is delta EL_a = 0.  [Martinez 2001, 2008]
#pragma once

#include "mechanics/lagrange.hpp"

namespace lagen {

/// A variation delta, by what it does to x and y.
struct Variation {
    std::vector<NodeId> x; ///< delta x^i, shape (n)
    std::vector<NodeId> y; ///< delta y^a, shape (r)
};

/// C^c_ab s^a t^b, shape (r): the bracket of sections whose components are free of x.
[[nodiscard]] std::vector<NodeId> constant_bracket(Graph& graph, const Algebroid& algebroid,
                                                   const std::vector<NodeId>& s, const std::vector<NodeId>& t);

/// The variation of the curve (x, y) by s with its rate; shapes (r).
[[nodiscard]] Variation variation(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& s,
                                  const std::vector<NodeId>& sdot);

/// delta f of functions of t, x, y; `more`: what else varies, with its variation.
[[nodiscard]] std::vector<NodeId> varied(Graph& graph, const Algebroid& algebroid, const Variation& delta,
                                         std::span<const NodeId> f, const Replacements& more = {});
[[nodiscard]] NodeId varied(Graph& graph, const Algebroid& algebroid, const Variation& delta, NodeId f,
                            const Replacements& more = {});

/// The variations of the action of a system that has L, neither forces nor a distribution.
struct ActionVariations {
    NodeId base = 0, fibre = 0; ///< the two parts of delta L: rho_a(L) s^a and p_a delta y^a
    NodeId second = 0;          ///< delta^2 L
    std::vector<NodeId> pushes; ///< rho_a(L) - p_c C^c_ab y^b, shape (r): the rates of p_a
    std::vector<NodeId> p;      ///< p_a, shape (r)
};
[[nodiscard]] ActionVariations action_variations(Graph& graph, const System& system, const Variation& delta,
                                                 const std::vector<NodeId>& s);

/// The separate terms of delta L, shape (3 r): rho_a(L) s^a, then p_a sdot^a, then p_a C^a_bc y^b s^c. Each may cancel
/// with others of them: their sizes, and not that of a sum, tell what the round-off of delta L is to be compared with.
[[nodiscard]] std::vector<NodeId> terms_of_first_variation(Graph& graph, const System& system,
                                                           const std::vector<NodeId>& s,
                                                           const std::vector<NodeId>& sdot);

/// The name that stands for the rate of the state delta y^a of a Jacobi field, which follows from the accelerations.
[[nodiscard]] std::string jacobi_rate_name(const std::string& state);

/// These rates, of the field of `system`: the variations of the accelerations.
[[nodiscard]] std::vector<NodeId> jacobi_rates(Graph& graph, const System& system, std::span<const NodeId> ydot);

} // namespace lagen
