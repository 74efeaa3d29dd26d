// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations on the dual of a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a dH/dmu_a,   mudot_a = -rho_a(H) - mu_c C^c_ab dH/dmu_b + Q_a(t, x, dH/dmu)
///   {mu_a, x^j} = rho^j_a,   {mu_a, mu_b} = C^c_ab mu_c,   Fdot = {H, F} + dF/dt + Q_a dF/dmu_a
///   dH/dt = Q_a dH/dmu_a + (dH/dt at fixed x, mu)                          [de Leon-Marrero-Martinez 2005]
/// H is the model's own, or the Legendre transform of its L: written out where the momenta are affine in y with a W
/// that falls into small blocks, else left implicit, with y(x, mu) from mu_a = dL/dy^a, rho_a(H) = -rho_a(L) at that y.
#include "equations/derivations.hpp"

#include "equations/given_blocks.hpp"
#include "equations/legendre.hpp"
#include "equations/symbolic_model.hpp"
#include "model/scene_form.hpp"
#include "text/activity.hpp"
#include "verify/legendre_obstacle.hpp"

namespace lagen {
namespace {

class HamiltonDerivation {
  public:
    HamiltonDerivation(const Model& model, const WrittenAlgebroid& algebroid, const DefinitionChoice& choice)
        : symbolic_(model, algebroid, {model.hamiltonian ? model.hamiltonian : model.lagrangian, model.dissipation},
                    choice, name_set(algebroid.fibre))
    {
        if (model.hamiltonian)
            take_hamiltonian(symbolic_.reduced(symbolic_.lower(model.hamiltonian)));
        else
            transform(symbolic_.reduced(symbolic_.lower(model.lagrangian)));
        forces_ = symbolic_.forces(y_);
    }

    EquationSet derive()
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::hamilton).name);
        set.given = given_blocks({}, constraints_and_invariants(symbolic_));
        set.blocks = {hamiltonian()};
        if (EquationBlock labels = symbolic_.casimirs(); !labels.equations.empty()) set.blocks.push_back(labels);
        set.blocks.push_back(velocities());
        set.blocks.push_back(in_velocities_
                                 ? EquationBlock{"kinematics", "ẋ^i = ρ^i_a y^a", R"(\dot x^i = \rho^i_a\, y^a)",
                                                 symbolic_.kinematics(y_)}
                                 : EquationBlock{"kinematics", "ẋ^i = ρ^i_a ∂H/∂μ_a",
                                                 R"(\dot x^i = \rho^i_a\, \frac{\partial H}{\partial \mu_a})",
                                                 symbolic_.kinematics(y_)});
        set.blocks.push_back(motion());
        if (EquationBlock balance = energy_balance(); !balance.equations[0].groups.empty())
            set.blocks.push_back(std::move(balance));
        if (EquationBlock states = symbolic_.states(y_); !states.equations.empty())
            set.blocks.push_back(std::move(states));
        set.blocks.push_back(poisson_brackets(symbolic_));
        return symbolic_.closed(std::move(set));
    }

  private:
    [[nodiscard]] std::size_t r() const { return symbolic_.r(); }

    void take_hamiltonian(const GiNaC::ex& H)
    {
        hamiltonian_ = H;
        for (const GiNaC::ex& mu : symbolic_.mu()) y_.push_back(symbolic_.derivative(H, mu));
        velocities_ = y_;
    }

    /// H from L; where y(x, mu) has no formula, the symbols y stand for it.
    void transform(const GiNaC::ex& L)
    {
        transformed_ = true;
        lagrangian_ = L;
        if (const auto legendre = legendre_transform(symbolic_, L)) {
            hamiltonian_ = legendre->hamiltonian;
            velocities_ = legendre->velocities;
            in_velocities_ = legendre->coupled;
            y_ = in_velocities_ ? symbolic_.y() : velocities_;
            return;
        }
        implicit_ = in_velocities_ = true;
        y_ = symbolic_.y();
        Sum terms = {-L};
        for (std::size_t a = 0; a < r(); ++a) terms.push_back(symbolic_.mu()[a] * y_[a]);
        hamiltonian_ = total(terms);
    }

    [[nodiscard]] std::string energy_name() const { return symbolic_.free_name({"H", "H_E"}); }

    [[nodiscard]] EquationBlock hamiltonian() const
    {
        const Equation equation = symbolic_.equation(LeftSide::symbol, energy_name(), {hamiltonian_});
        if (!transformed_) return {"Hamiltonian", "H(x, μ)", R"(H(x, \mu))", {equation}};
        return {implicit_ ? "Hamiltonian (the Legendre transform of L, at the velocities below)"
                          : "Hamiltonian (the Legendre transform of L)",
                "H = μ_a y^a - L",
                R"(H = \mu_a\, y^a - L)",
                {equation}};
    }

    [[nodiscard]] EquationBlock velocities() const
    {
        EquationBlock block{"velocities", "y^a = ∂H/∂μ_a", R"(y^a = \frac{\partial H}{\partial \mu_a})", {}};
        if (implicit_)
            block = {"velocities",
                     "y(x, μ) solves μ_a = ∂L/∂y^a",
                     R"(y(x, \mu) \text{ solves } \mu_a = \frac{\partial L}{\partial y^a})",
                     {}};
        for (std::size_t a = 0; a < r(); ++a)
            block.equations.push_back(
                implicit_
                    ? symbolic_.equation(LeftSide::symbol, symbolic_.momentum_name(a),
                                         {symbolic_.derivative(lagrangian_, symbolic_.y()[a])})
                    : symbolic_.equation(LeftSide::symbol, symbolic_.algebroid().fibre[a].name, {velocities_[a]}));
        return block;
    }

    [[nodiscard]] EquationBlock motion() const
    {
        const FormulaTerm anchor =
            in_velocities_ ? FormulaTerm{"ρ_a(L)", R"(\rho_a(L))"} : FormulaTerm{"-ρ_a(H)", R"(-\rho_a(H))"};
        const FormulaTerm bracket =
            in_velocities_
                ? FormulaTerm{"-μ_c C^c_ab y^b", R"(-\mu_c\, C^c_{ab}\, y^b)"}
                : FormulaTerm{"-μ_c C^c_ab ∂H/∂μ_b", R"(-\mu_c\, C^c_{ab}\, \frac{\partial H}{\partial \mu_b})"};
        const FormulaTerm force{"Q_a", "Q_a"};
        EquationBlock block{"equations of motion", "μ̇_a", R"(\dot \mu_a)", {}};
        Activity activity("equations of motion", r());
        for (std::size_t a = 0; a < r(); ++a) {
            activity.next();
            Equation next{LeftSide::time_derivative, symbolic_.momentum_name(a), {}, {}};
            next.groups = symbolic_.simplified(
                {{anchor.label, in_velocities_ ? total(symbolic_.along_anchor(a, lagrangian_))
                                               : GiNaC::ex(-total(symbolic_.along_anchor(a, hamiltonian_)))},
                 {bracket.label, total(symbolic_.bracket_terms(a, symbolic_.mu(), y_))},
                 {force.label, forces_[a]}});
            block.equations.push_back(std::move(next));
        }
        append_right_side(block, {anchor, bracket, force});
        return block;
    }

    [[nodiscard]] EquationBlock energy_balance()
    {
        Sum power;
        for (std::size_t a = 0; a < r(); ++a) power.push_back(forces_[a] * y_[a]);
        // At fixed mu the explicit dependence of H on t is minus that of L, however y(x, mu) moves.
        const GiNaC::ex drift = in_velocities_ ? GiNaC::ex(-symbolic_.time_derivative(lagrangian_))
                                               : symbolic_.time_derivative(hamiltonian_);
        Equation balance{LeftSide::time_derivative, energy_name(), {}, {}};
        const FormulaTerm rate = in_velocities_ ? FormulaTerm{"-∂L/∂t", R"(-\frac{\partial L}{\partial t})"}
                                                : FormulaTerm{"∂H/∂t", R"(\frac{\partial H}{\partial t})"};
        const FormulaTerm work{"Q_a y^a", R"(Q_a\, y^a)"};
        balance.groups = symbolic_.simplified({{work.label, total(power)}, {rate.label, drift}});
        EquationBlock block{"energy balance", "Ḣ", R"(\dot H)", {std::move(balance)}};
        append_right_side(block, {rate, work});
        return block;
    }

    SymbolicModel symbolic_;
    GiNaC::ex hamiltonian_, lagrangian_;
    bool transformed_ = false;   ///< H comes from L
    bool implicit_ = false;      ///< y(x, mu) has no formula
    bool in_velocities_ = false; ///< the equations are written in y, which stands for y(x, mu)
    Sum velocities_;             ///< y^a(t, x, mu), shape (r), where it has a formula
    Sum y_;                      ///< what the equations have for y^a, shape (r)
    Sum forces_;                 ///< Q_a at these velocities, shape (r)
};

} // namespace

EquationSet derive_hamilton(const Model& model, const WrittenAlgebroid& algebroid, const Regularity& regularity,
                            Definitions definitions)
{
    if (!model.hamiltonian && !model.lagrangian)
        throw MathematicsError(
            "model '" + model.name +
            "' has neither a Hamiltonian nor a Lagrangian; Hamilton's equations need [hamiltonian] H "
            "or [lagrangian] L");
    if (!model.hamiltonian && regularity.kind == Regularity::Kind::degenerate)
        throw MathematicsError("the Lagrangian of model '" + model.name +
                               "' is degenerate: its momenta p_a = dL/dy^a have rank " +
                               std::to_string(regularity.rank) + " of " + std::to_string(algebroid.r()) +
                               ", so that it has no Hamiltonian form; Hamilton's equations need [hamiltonian] H");
    if (!model.hamiltonian) require_legendre_transform(model.name, regularity);
    return derived(model, "Hamilton's equations", definitions, [&](const DefinitionChoice& choice) {
        return HamiltonDerivation(model, algebroid, choice).derive();
    });
}

} // namespace lagen
