// SPDX-License-Identifier: GPL-2.0-or-later
/// The residuals of the structure equations as graph nodes, those that are zero by structure only counted.
#pragma once

#include "geometry/lowered_algebroid.hpp"

namespace lagen {

/// An expression that should vanish. `indices` are numbers of fibre or base coordinates, in the order of
/// `Check::indices`.
struct Residual {
    std::string name;
    std::vector<std::size_t> indices;
    NodeId value;
};

struct ResidualList {
    std::vector<Residual> residuals;
    std::size_t trivial = 0; ///< without a single nonzero term
};

/// C^c_ab + C^c_ba for a <= b where the model lists both orders (a = b: the one entry, doubled); indices (a, b, c).
void append_antisymmetry(ResidualList& list, Graph& graph, const LoweredAlgebroid& algebroid);

/// rho_a(rho^i_b) - rho_b(rho^i_a) - rho^i_c C^c_ab for a < b; indices (a, b, i).
void append_anchor(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid);

/// sum_cyc(a,b,c) [ rho_a(C^v_bc) + C^m_bc C^v_am ] for a < b < c; indices (a, b, c, v).
void append_jacobi(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid);

} // namespace lagen
