// SPDX-License-Identifier: GPL-2.0-or-later
/// What a map of systems does to velocities: y' by y and, of nonholonomic systems, the weights y'^beta by the weights
/// y^alpha, with Phi(b + y^alpha e_alpha) = b' + y'^beta e'_beta by least squares.
///                                                                    [Cortes, de Leon, Marrero, Martinez 2009]
#pragma once

#include "mechanics/morphism.hpp"

namespace lagen {

/// Phi on the velocities of both systems, y and, of nonholonomic ones, the weights y^alpha of b + y^alpha e_alpha.
struct VelocityMap {
    std::vector<NodeId> velocities; ///< y'^a over x, y, shape (k'): least squares in b' + y'^beta e'_beta = Phi(Y)
    std::vector<NodeId> matrix;     ///< d y'^a / d y^b, shape (k', k), by rows
    /// What lies outside of D': one vector of E' for each section e_alpha, then that of the drift; empty where D' is
    /// all of E'.
    std::vector<std::vector<NodeId>> outside;
    std::vector<NodeId> basis; ///< the sections e'_beta along phi, by rows of r'; empty likewise
};
/// `matrix`: Phi^a_b of the ambient algebroids.
[[nodiscard]] VelocityMap velocity_map(Graph& graph, const SystemMorphism& morphism, const std::vector<NodeId>& matrix);

} // namespace lagen
