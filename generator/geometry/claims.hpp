// SPDX-License-Identifier: GPL-2.0-or-later
/// A model on one graph: rho, C, L and constraints lowered once, the proof setting, and the deciding of each kind of
/// claim.
#pragma once

#include "geometry/fibre_hessian.hpp"
#include "geometry/judge.hpp"
#include "geometry/jumps.hpp"
#include "geometry/phase_motion.hpp"
#include "geometry/repair_search.hpp"
#include "geometry/structure_equations.hpp"
#include "geometry/verify.hpp"

#include <memory>

namespace lagen {

class Claims {
  public:
    /// `points`: of a re-evaluation; 0: none. `budget`: of each decision. Throws ModelError where the base constraints
    /// are not triangular, and where a divisor of the model is zero everywhere.
    Claims(const Model& model, const Algebroid& algebroid, std::size_t points, const ProofBudget& budget);

    /// antisymmetry, anchor, jacobi, tangency of the constraints, Casimirs
    void decide_structure(VerifiedAlgebroid& verified);
    void decide_regularity(VerifiedAlgebroid& verified);
    /// Where L and H are given: H(t, x, dL/dy) - (y^a dL/dy^a - L)
    void decide_legendre(VerifiedAlgebroid& verified);
    /// Of a control problem: do the controls maximise H?
    void decide_controls(VerifiedAlgebroid& verified);
    void decide_invariants(VerifiedAlgebroid& verified, const std::vector<NamedTree>& extra);

  private:
    void lower_model();
    void lower_mechanics();
    void append_mechanics(std::vector<NodeId>& nodes) const;
    [[nodiscard]] std::unique_ptr<EquationsOfMotion> equations_of_motion();
    [[nodiscard]] ProofSetting setting_of(std::vector<NodeId> defined) const;
    [[nodiscard]] Continuity along_anchor();
    [[nodiscard]] Continuity along_motions(EquationsOfMotion& motion);
    void make_setting();
    void require_triangular_constraints();
    void refuse_zero_divisors(const ProofBudget& budget);
    void decide_by_construction(const ResidualList& list);
    [[nodiscard]] Check check_of(const Residual& residual) const;
    [[nodiscard]] Editable editable() const;
    [[nodiscard]] std::set<std::string> accessory() const;
    [[nodiscard]] std::vector<std::pair<NodeId, NodeId>> parameter_values();

    const Model& model_;
    const Algebroid& algebroid_;
    std::size_t points_;
    Graph graph_;
    Binding binding_; ///< names of Casimirs
    std::unique_ptr<Lowering> lower_;
    LoweredAlgebroid lowered_;
    BaseFunctions functions_; ///< as nodes
    std::optional<NodeId> time_;
    std::optional<FibreHessian> hessian_;             ///< of L
    std::vector<NodeId> mu_;                          ///< inputs; empty where neither H nor controls are given
    std::optional<FibreHessian> hamiltonian_hessian_; ///< of H, over mu
    std::vector<NodeId> forces_;                      ///< Q_a over x, y, t; shape (r)
    std::optional<ControlNodes> control_;
    std::unique_ptr<BaseGradient> partial_;
    ProofSetting setting_;
    std::unique_ptr<Judge> judge_;
    std::string note_;
};

} // namespace lagen
