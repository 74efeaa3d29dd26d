// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete mechanics on a Lie groupoid with the discrete Lagrangian L(g), by its invariant fields:
///   F^+L(g)_a = (<-e_a L)(g),      F^-L(h)_a = (->e_a L)(h)                        discrete Legendre transforms
///   DEL(g, h)_a = F^+L(g)_a - F^-L(h)_a = 0,      t(g) = s(h)                      discrete Euler-Lagrange equations
///   N_ab = <-e_b (F^-L_a)                                                          Newton's matrix of a step
/// A step takes (x, mu) to the arrow h with s(h) = x and F^-L(h) = mu, and then to (t(h), F^+L(h)). Newton's method for
/// it moves h along its source fibre, h <- h eta(d) with N d = mu - F^-L(h); L is regular where det N != 0, since
/// N_ab E-^a ^ E+^b is its Cartan 2-section Omega_L.                                             [Martinez 2001]
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

/// Over the coordinates of an arrow, shapes (r).
struct DiscreteLegendre {
    std::vector<NodeId> plus;  ///< F^+L(g)_a
    std::vector<NodeId> minus; ///< F^-L(g)_a
};
[[nodiscard]] DiscreteLegendre discrete_legendre(Graph& graph, const Groupoid& groupoid, NodeId L);

/// DEL(g, h)_a, shape (r).
[[nodiscard]] std::vector<NodeId> discrete_euler_lagrange(Graph& graph, const Groupoid& groupoid,
                                                          const DiscreteLegendre& legendre, const Arrow& g,
                                                          const Arrow& h);

/// The derivatives of `functions` (F^-L, and dL/dw of inner unknowns w, m of them) along <-e_b and along w, by rows,
/// shape (r + m, r + m): N_ab.
[[nodiscard]] std::vector<NodeId> newton_matrix(Graph& graph, const Groupoid& groupoid,
                                                const std::vector<NodeId>& functions,
                                                const std::vector<NodeId>& inner = {});

/// True where neither forces nor explicit time act on the steps of a system with a discrete Lagrangian.
[[nodiscard]] bool keeps_energy(const System& system);

/// What a step solves for the arrow h and the inner unknowns w of a scheme, with the work f of forces:
///   F^-L(h)_a - f^-_a = mu_a,      dL/dw + f_w = 0
/// Of curves exp(xi) with exp(xi) = W the slopes dL/dxi + f_xi = D^T p belong to the momenta: a field that moves W by
/// z^c E_c W adds z^c p_c, and f(xi, W) = 0 stands in their place.                     [Bou-Rabee, Marsden 2009]
struct ArrowEquations {
    std::vector<NodeId> momenta;    ///< F^-L_a - f^-_a, shape (r)
    std::vector<NodeId> stationary; ///< dL/dw + f_w, f(xi, W) first where there are xi; shape (m)
    std::vector<NodeId> matrix;     ///< N: the derivatives of both, shape (r + m, r + m)

    [[nodiscard]] std::size_t unknowns() const { return momenta.size() + stationary.size(); }
};

/// Of a system with a discrete Lagrangian.
[[nodiscard]] ArrowEquations arrow_equations(Graph& graph, const System& system);

} // namespace lagen
