// SPDX-License-Identifier: GPL-2.0-or-later
/// The residuals of the structure equations as graph nodes, those that are zero by structure only counted.
#pragma once

#include "geometry/lowered_algebroid.hpp"

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

/// The equations of one pair or triple of sections: those with at least one nonzero term, by the free index. A value
/// may still be the constant 0, where the terms cancel.
/// rho_a(rho^i_b) - rho_b(rho^i_a) - rho^i_c C^c_ab, by i
[[nodiscard]] Column anchor_equations(Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid,
                                      std::size_t a, std::size_t b);
/// sum_cyc(a,b,c) [ rho_a(C^v_bc) + C^m_bc C^v_am ], by v
[[nodiscard]] Column jacobi_equations(Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid,
                                      std::size_t a, std::size_t b, std::size_t c);

/// C^c_ab + C^c_ba for a <= b where the model lists both orders (a = b: the one entry, doubled); indices (a, b, c).
void append_antisymmetry(ResidualList& list, Graph& graph, const LoweredAlgebroid& algebroid);

/// anchor_equations for a < b; indices (a, b, i).
void append_anchor(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid);

/// jacobi_equations for a < b < c; indices (a, b, c, v).
void append_jacobi(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid);

/// rho_a(f) for every section and every function of the list; indices (a, number of f).
void append_anchor_derivatives(ResidualList& list, const std::string& name, Graph& graph, BaseGradient& partial,
                               const LoweredAlgebroid& algebroid, const std::vector<NodeId>& functions);

} // namespace lagen
