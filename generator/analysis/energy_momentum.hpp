// SPDX-License-Identifier: GPL-2.0-or-later
/// The certificate of a relative equilibrium that was found in floating point, and what it says of stability.
///
/// Coordinates that are 0 by the equations themselves are taken out. Of the F whose differentials are independent there
/// (set S), the flows X_j through the point, and gauge vectors w_j = X_j,
///   dH - lambda_i dF_i + epsilon_j w_j = 0,   F_i = c_i,   w_j.(z - z_0) = 0      (i in S)
/// has one solution in a box by an interval Newton step; epsilon is 0 by Noether's theorem, where the F commute and
/// the matrix w_k.X_j is regular. The second variation H_zz - lambda_i F_i,zz is taken on N, a complement of the flows
/// in ker dF, lambda being free up to dependent differentials: dF_t = c_ti dF_i leaves H_lambda critical.
#pragma once

#include "analysis/augmented_energy.hpp"
#include "analysis/relative_equilibria.hpp"
#include "proof/ball_matrix.hpp"

#include <functional>

namespace lagen {

class EquilibriumCertificate {
  public:
    /// `is_zero`: proves that a node vanishes. Keeps references.
    EquilibriumCertificate(Graph& graph, const AugmentedEnergy& energy, const std::vector<ConservedFunction>& conserved,
                           bool commuting, std::function<bool(NodeId)> is_zero);

    /// That near z.
    [[nodiscard]] RelativeEquilibrium judged(const std::vector<double>& z, const std::vector<double>& lambda);

  private:
    void choose(const std::vector<FunctionJet>& jets);
    void take_out_zeros(const std::vector<double>& z);
    [[nodiscard]] bool certify(const std::vector<double>& lambda);
    [[nodiscard]] proof::NewtonEquations equations(const std::vector<proof::Ball>& u) const;
    [[nodiscard]] std::vector<proof::Ball> point(const std::vector<proof::Ball>& u) const;
    [[nodiscard]] bool is_regular_gauge() const;
    [[nodiscard]] std::vector<Rational> rational_point(const std::vector<double>& z) const;
    void judge(RelativeEquilibrium& out);
    [[nodiscard]] std::optional<proof::BallMatrix> complement(const std::vector<FunctionJet>& jets) const;
    void find_definite(const std::vector<FunctionJet>& jets, const proof::BallMatrix& N,
                       RelativeEquilibrium& out) const;

    Graph& graph_;
    const AugmentedEnergy& energy_;
    const std::vector<ConservedFunction>& conserved_;
    bool commuting_;
    std::function<bool(NodeId)> is_zero_;

    std::vector<double> near_;             ///< z
    std::vector<bool> zero_;               ///< the coordinate is 0 by the equations
    std::vector<std::size_t> free_;        ///< the others
    std::vector<std::size_t> chosen_;      ///< S
    std::vector<std::size_t> flows_;       ///< the F whose flows are independent at z
    std::vector<Doubles> directions_;      ///< of these, orthonormal to the dF_S
    std::vector<Doubles> gauge_;           ///< w_j: those that stay where the coordinates are 0
    std::vector<std::size_t> gauge_flows_; ///< the F that they are of
    std::vector<proof::Ball> solution_;    ///< z of the free ones, lambda_i, epsilon_j
};

} // namespace lagen
