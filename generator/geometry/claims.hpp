// SPDX-License-Identifier: GPL-2.0-or-later
/// A model on one graph: rho, C, L and constraints lowered once, the proof setting, and the deciding of each kind of
/// claim.
#pragma once

#include "geometry/fibre_hessian.hpp"
#include "geometry/structure_equations.hpp"
#include "geometry/verify.hpp"

#include <memory>

namespace lagen {

class Claims {
  public:
    /// Throws ModelError where the base constraints are not triangular, and where a divisor of the model is zero
    /// everywhere.
    Claims(const Model& model, const Algebroid& algebroid);

    /// antisymmetry, anchor, jacobi
    void decide_structure(VerifiedAlgebroid& verified);
    /// tangency of the constraints, Casimirs
    void decide_surfaces(VerifiedAlgebroid& verified);
    void decide_regularity(VerifiedAlgebroid& verified);
    void decide_invariants(VerifiedAlgebroid& verified, const std::vector<NamedTree>& extra);

  private:
    void lower_model();
    void make_decider();
    void refuse_zero_divisors();
    [[nodiscard]] Decision decide(NodeId residual, const ZeroDecider& decider) const;
    [[nodiscard]] std::string sign_hint(const std::vector<Residual>& residuals, std::size_t a, std::size_t b);
    void decide_anchor_derivative(VerifiedAlgebroid& verified, const std::string& name, const std::string& text,
                                  NodeId f);
    [[nodiscard]] std::vector<std::pair<NodeId, NodeId>> parameter_values();

    const Model& model_;
    const Algebroid& algebroid_;
    Graph graph_;
    Binding binding_; ///< names of Casimirs
    std::unique_ptr<Lowering> lower_;
    LoweredAlgebroid lowered_;
    std::optional<NodeId> time_;
    std::optional<FibreHessian> hessian_;
    std::unique_ptr<BaseGradient> partial_;
    ProofSetting setting_;
    std::unique_ptr<ZeroDecider> decider_;
    std::string note_;
};

} // namespace lagen
