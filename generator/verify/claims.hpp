// SPDX-License-Identifier: GPL-2.0-or-later
/// A system with its proof setting, and the deciding of each kind of claim.
#pragma once

#include "mechanics/hamilton.hpp"
#include "mechanics/lagrange_motion.hpp"
#include "mechanics/pontryagin.hpp"
#include "verify/judge.hpp"
#include "verify/where_constant.hpp"

#include <memory>

namespace lagen {

class Claims {
  public:
    /// `budget` is that of each decision. Keeps a reference to `system`. Throws ModelError where the base constraints
    /// are not triangular, and where a divisor of the model is zero everywhere.
    Claims(const System& system, const ProofBudget& budget);

    /// antisymmetry, anchor, jacobi, tangency of the constraints, Casimirs
    void decide_structure(StructureReport& structure);
    /// action and unit of a groupoid, and whether the algebroid given beside it is its own
    void decide_groupoid(StructureReport& structure);
    /// closed and equals of [forms], and whether each form is closed.
    void decide_forms(StructureReport& structure);
    [[nodiscard]] Regularity decide_regularity();
    [[nodiscard]] Regularity decide_discrete_regularity();
    /// Where L and H are given: H(t, x, dL/dy) - (y^a dL/dy^a - L)
    void decide_legendre(StructureReport& structure);
    /// The sections of [symmetries]
    void decide_symmetries(StructureReport& structure);
    /// closed and hamilton_jacobi of [hamilton_jacobi], and whether its integral curves lift.
    void decide_hamilton_jacobi(StructureReport& structure, const Regularity& regularity);
    /// Of a nonholonomic system, once its regularity is decided: independent, constraint; integrability; its energy.
    void decide_distribution(Report& report);
    /// Of a control problem: do the controls maximise H?
    void decide_controls(Report& report);
    /// Of `written.invariants` and `extra`, along the motions of L or H, and along the steps of a discrete L that is
    /// written out.
    void decide_invariants(Report& report, const std::vector<NamedTree>& extra);

  private:
    void decide_along_motions(Report& report, const std::vector<NamedTree>& claims);
    /// True where there are motions in continuous time, whose equations claims are about.
    [[nodiscard]] bool has_motions() const
    {
        return lagrangian_ || system_.hamiltonian || system_.control || !system_.rates.empty();
    }
    void decide_along_steps(Report& report, const std::vector<NamedTree>& claims);
    [[nodiscard]] std::unique_ptr<EquationsOfMotion> equations_of_motion();
    [[nodiscard]] Algebroid leaves();
    [[nodiscard]] WhereConstant along_anchor();
    [[nodiscard]] WhereConstant along_motions(EquationsOfMotion& motion, const Regularity& regularity);
    [[nodiscard]] bool motions_fill(const Regularity& regularity);
    [[nodiscard]] std::vector<NamedNode> divisors_of(const Rate& rate, const Regularity& regularity) const;
    void require_triangular_constraints();
    void refuse_zero_divisors(const ProofBudget& budget);
    void decide_by_construction(const ResidualList& list);
    void say_where(WhereConstant& where, const std::vector<NodeId>& functions, std::vector<Check>& checks, Check none);
    [[nodiscard]] std::optional<NodeId> momentum_in(NodeId f, const Binding& names);
    struct Vanishing {
        std::vector<Check> checks;
        std::size_t trivial = 0; ///< components that have no terms
    };
    [[nodiscard]] Vanishing vanishing(const std::string& name, const FormClaim& claim, const ExteriorForm& residual);
    void decide_action(StructureReport& structure);
    void decide_independence(StructureReport& structure);
    void decide_constraints(StructureReport& structure);
    void add_singular_minor(Regularity& regularity);
    void append_equality(StructureReport& structure, const char* name, std::vector<std::string> indices, NodeId value,
                         NodeId wanted);
    [[nodiscard]] Check check_of(const Residual& residual);
    [[nodiscard]] ProofStatus closedness(const FormClaim& claim);

    const System& system_;
    Graph graph_; ///< the system's, and what is derived here
    BaseGradient partial_;
    std::optional<LagrangianNodes> lagrangian_;
    std::optional<FibreHessian> hamiltonian_hessian_; ///< of H, over mu
    ProofSetting setting_;
    std::unique_ptr<Judge> judge_;
    std::string note_;
};

} // namespace lagen
