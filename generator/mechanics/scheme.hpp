// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Lagrangians made of L: the action of a curve through the arrow g = (x, x_next, W), by a quadrature,
///   L_d(g) = h sum_i b_i L(t + c_i h, x(c_i), y(c_i)),      x(0) = x, x(1) = x_next,  W(0) = 1, W(1) = W,
///   W(c) = tau(xi(c)),  x(c) = x.W(c) on an action groupoid,                  tau Cayley's map, or exp in closed form
///   y^i = x'^i/h,  y^a = (W^-1 W')^a/h + A_i^a(x) y^i       (in the frame of the connection)
/// x and xi are polynomials in c. Of degree 1 they are chords, whose velocity is taken to be that of the whole step,
/// tau^-1(W)/h. Of degree d > 1 their values at d - 1 points inside, less those of the chord, are further unknowns w
/// of a step, at which L_d is stationary (Galerkin's method; the names say which quadrature, and the order of a step):
///   midpoint      c = 1/2                                      order 2
///   trapezoidal   c = 0, 1                                     order 2, on pairs with L = T - V: Stoermer and Verlet
///   left          c = 0                                        order 1
///   gauss:s       Gauss' s nodes, degree s                     order 2 s
///   lobatto:s     Lobatto's s nodes, degree s - 1              order 2 s - 2
/// Of exp, whose inverse has no closed form, xi(1) are unknowns too, the first of them, held to W by exp(xi) = W.
/// Forces Q act along the same curve, by the same quadrature (the discrete principle of d'Alembert):
///   f^-_a = h sum_i b_i Q(c_i) . eta_a(c_i),     eta_a the variation of the curve where e_a moves its start; f^+_a:
///   its
/// end, and F^-L - f^-, F^+L + f^+ are the momenta at both ends.
/// [Marsden, West 2001; Leok, Shingel 2012; on groups Bou-Rabee, Marsden 2009]
#pragma once

#include "geometry/exponential.hpp"
#include "mechanics/quadrature.hpp"
#include "mechanics/system.hpp"

namespace lagen {

/// L_d with its inner unknowns w, which are inputs: of each point inside the values along the sections e_a.
struct SchemeLagrangian {
    NodeId lagrangian = 0;
    std::vector<NodeId> inner;
    DiscreteWork work; ///< of the forces
    std::optional<ArrowLogarithm> logarithm;
};

/// `step`: the node of h. The system has a Lagrangian and a groupoid with a Cayley map, or with the `exponential`.
[[nodiscard]] SchemeLagrangian scheme_lagrangian(Graph& graph, const System& system, const QuadratureRule& rule,
                                                 NodeId step, const Exponential* exponential = nullptr);

} // namespace lagen
