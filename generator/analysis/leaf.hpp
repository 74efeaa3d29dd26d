// SPDX-License-Identifier: GPL-2.0-or-later
/// The leaves of the base: where the fields rho_a lead to from a point, those of the sections and the drift of a
/// distribution with their brackets. No motion leaves its leaf, and nothing that moves a state may.
///
/// Functions with rho_a(f) = 0 are constant on leaves: base constraints, Casimirs that the file claims, and those that
/// are found among monomials of the base coordinates and of the functions that the fields are made of (R^T R of a
/// matrix with R' = R hat(w), |x|^2 of a vector with x' = x cross w). [Sussmann 1973]
#pragma once

#include "geometry/orthonormal_span.hpp"
#include "mechanics/system.hpp"
#include "proof/least_squares.hpp"

namespace lagen {

/// At the parameter values of the system.
struct Leaves {
    std::vector<std::vector<NodeId>> fields; ///< X_a^i, shape (any, n), closed under brackets where they are generic
    std::vector<NodeId> constraints;         ///< functions that are 0
    std::vector<NodeId> casimirs;            ///< those that are constant: declared, then found
    std::size_t codimension = 0;             ///< of most leaves
};

/// A field over the time has no leaves of its own: there are no fields then. `graph`: a copy of the system's.
[[nodiscard]] Leaves leaves_of(Graph& graph, const System& system);

/// Steps that stay on the leaf of a point z = (x, whatever): x goes along the flow of c_a X_a for the time 1, in the
/// digits of a long double, the rest by what is added. A step is (c, rest).
class LeafSteps {
  public:
    /// Keeps the graph.
    LeafSteps(const Graph& graph, std::vector<NodeId> x, std::vector<std::vector<NodeId>> fields);

    /// No numbers where the flow ends on the way.
    [[nodiscard]] std::vector<double> moved(const std::vector<double>& z, const std::vector<double>& step) const;
    /// Where Levenberg and Marquardt's steps from z end; z where they meet no numbers. The slopes of `residual` are
    /// by z.
    [[nodiscard]] std::vector<double>
    least_squares(const std::vector<double>& z,
                  const std::function<proof::Residual(const std::vector<double>&)>& residual) const;
    /// The directions of the leaf at x, and unit vectors that are orthogonal to it.
    [[nodiscard]] OrthonormalSpan tangent(const std::vector<double>& z) const;
    [[nodiscard]] std::vector<std::vector<double>> normals(const std::vector<double>& z) const;

  private:
    using Numbers = std::vector<long double>;
    [[nodiscard]] Numbers fields_at(const Numbers& x) const;
    [[nodiscard]] std::vector<double> slopes(const std::vector<double>& by_z, const std::vector<double>& z) const;
    [[nodiscard]] std::optional<Numbers> along(Numbers x, const std::vector<double>& c) const;

    const Graph& graph_;
    std::vector<NodeId> x_;
    std::size_t count_;
    std::vector<NodeId> entries_;
};

} // namespace lagen
