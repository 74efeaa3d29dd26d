// SPDX-License-Identifier: GPL-2.0-or-later
/// A nonholonomic model in GiNaC, with what its derivations share: sections e_alpha = A_alpha^a e_a and the drift b, Y
/// = b + y^alpha e_alpha, and L, P_a = dL/dY^a and Q_a there (mechanics/nonholonomic.hpp).
#pragma once

#include "equations/linear_equations.hpp"
#include "equations/symbolic_model.hpp"
#include "mechanics/system.hpp"

namespace lagen {

class ConstrainedModel {
  public:
    /// The model has L. Keeps references.
    ConstrainedModel(const Model& model, const System& system, const DefinitionChoice& choice = {});

  protected:
    [[nodiscard]] const std::string& ambient_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }
    [[nodiscard]] const std::string& momentum_name(std::size_t alpha) const { return symbolic_.momentum_name(alpha); }
    [[nodiscard]] bool has_drift() const { return !written_.drift.empty(); }

    /// A function of Y at Y = b + y^alpha e_alpha.
    [[nodiscard]] GiNaC::ex on_constraint(const GiNaC::ex& f) const;
    /// rho(s)(f)
    [[nodiscard]] Sum along(const Sum& s, const GiNaC::ex& f) const;
    /// [s, t]^a; y is constant in it.
    [[nodiscard]] Sum bracket(const Sum& s, const Sum& t) const;
    /// df/dt at fixed y.
    [[nodiscard]] GiNaC::ex at_fixed_velocity(const GiNaC::ex& f);
    /// df/dt, terms apart.
    [[nodiscard]] Sum along_motion(const GiNaC::ex& f, const GiNaC::exvector& ydot);
    /// The parts of d/dt p_alpha: rho(e_alpha)(l), -P_a [e_alpha, Y]^a, P_a dA_alpha^a/dt, Q_alpha.
    [[nodiscard]] std::vector<Group> balance(std::size_t alpha);
    /// d2l/dy2
    [[nodiscard]] SquareMatrix hessian();
    [[nodiscard]] std::optional<GiNaC::exvector> solved(const SquareMatrix& matrix, const Sum& right);
    /// A short fraction over one denominator; anything else as it is.
    [[nodiscard]] GiNaC::ex as_fraction(const GiNaC::ex& e);
    /// ydot^alpha, where it can be written out.
    [[nodiscard]] std::optional<GiNaC::exvector> accelerations();

    /// e_alpha = s on `frame`, or [e_alpha, e_beta] = s.
    [[nodiscard]] Equation section_equation(LeftSide left, std::size_t alpha, std::size_t beta, const Sum& s,
                                            const std::vector<Symbol>& frame) const;
    [[nodiscard]] EquationBlock sections();
    [[nodiscard]] EquationBlock velocities();

    const WrittenDistribution& written_;
    SymbolicModel symbolic_;
    std::size_t r_, k_;
    std::vector<Sum> sections_; ///< sections_[alpha][a] = A_alpha^a
    Sum drift_;                 ///< b^a
    Sum y_;                     ///< y^alpha
    Sum Y_;                     ///< Y^a on the constraint
    GiNaC::ex lagrangian_;      ///< L over Y
    Sum ambient_momenta_;       ///< dL/dY^a over Y
    GiNaC::ex l_;
    Sum P_, p_, forces_; ///< on the constraint; shapes (r), (k), (r)
};

} // namespace lagen
