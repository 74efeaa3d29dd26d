// SPDX-License-Identifier: GPL-2.0-or-later
/// The structure equations of a Lie algebroid as graph nodes, read off the exterior differential:
///   (S0)  C^c_ab + C^c_ba = 0                                                             antisymmetry
///   (S1)  rho_a(rho^i_b) - rho_b(rho^i_a) - rho^i_c C^c_ab = (d d x^i)_ab = 0             anchor:  rho is a morphism
///   (S2)  sum_cyc(a,b,c) [ rho_a(C^v_bc) + C^m_bc C^v_am ] = -(d d e^v)_abc = 0           Jacobi's identity
/// and f is constant on the leaves where (d f)_a = rho_a(f) = 0.                     [Martinez 2001]
#pragma once

#include "geometry/section.hpp"

namespace lagen {

/// An expression that should vanish. `indices` are numbers of fibre or base coordinates, in the order of
/// `Check::indices`; of `tangency` and `casimir`: (a, number of the function).
struct Residual {
    std::string name;
    std::vector<std::size_t> indices;
    NodeId value;
};

struct ResidualList {
    std::vector<Residual> residuals;
    std::size_t trivial = 0; ///< without a single nonzero term
};

/// Functions of the base that the anchor must annihilate.
struct BaseFunctions {
    std::vector<NodeId> constraints; ///< tangency
    std::vector<NodeId> casimirs;
};

/// Antisymmetry for a <= b where both orders are given (a = b: the one entry, doubled), indices (a, b, c); anchor for
/// a < b, indices (a, b, i); jacobi for a < b < c, indices (a, b, c, v); tangency and casimir, indices (a, number of
/// f): in this order, each by ascending indices. A value may still be the constant 0, where the terms cancel.
[[nodiscard]] ResidualList structure_equations(BaseGradient& partial, const Algebroid& algebroid,
                                               const BaseFunctions& functions = {});

/// The same by brackets of basis sections, one pair or triple at a time: (S1) [rho_a, rho_b] - rho([e_a, e_b]), by i;
/// (S2) [e_a, [e_b, e_c]] + [e_b, [e_c, e_a]] + [e_c, [e_a, e_b]], by v.
[[nodiscard]] Column anchor_defect(BaseGradient& partial, const Algebroid& algebroid, std::size_t a, std::size_t b);
[[nodiscard]] Column jacobiator(BaseGradient& partial, const Algebroid& algebroid, std::size_t a, std::size_t b,
                                std::size_t c);

} // namespace lagen
