// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a nonholonomic model (mechanics/nonholonomic.hpp), symbolic, for a person to read:
///   e_alpha = A_alpha^a e_a,   Y = b + y^alpha e_alpha,   xdot = rho(Y),   l(t, x, y) = L(t, x, Y)
///   [e_alpha, e_beta]^a = rho(e_alpha)(A_beta^a) - rho(e_beta)(A_alpha^a) + A_alpha^c A_beta^d C^a_cd
///   d/dt p_alpha = rho(e_alpha)(l) - P_a [e_alpha, Y]^a + P_a dA_alpha^a/dt + Q_alpha,   p_alpha = dl/dy^alpha, P =
///   dL/dY lambda_a = d/dt P_a - rho_a(L) + P_c C^c_ab Y^b - Q_a (reactions) [e_alpha, e_beta]_D = G^{gamma delta}
///   G(e_delta, [e_alpha, e_beta]) e_gamma        (projected; L = G(Y, Y)/2 - V)
/// [Cortes, de Leon, Marrero, Martinez 2009]
#include "equations/derivations.hpp"

#include "equations/constrained_model.hpp"
#include "equations/given_blocks.hpp"
#include "model/scene_form.hpp"

namespace lagen {

namespace {

class NonholonomicDerivation : ConstrainedModel {
  public:
    using ConstrainedModel::ConstrainedModel;

    EquationSet derive()
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::lagrange).name);
        set.given =
            given_blocks({lagrangian_block(symbolic_, lagrangian_, "x, Y")}, constraints_and_invariants(symbolic_));
        for (EquationBlock& block : std::vector{constraints(), sections(), brackets(), velocities(), kinematics(),
                                                symbolic_.casimirs(), momenta(), momentum_form(), acceleration_form(),
                                                energy(), energy_balance(), moving_energy(), symbolic_.states(Y_)})
            if (!block.equations.empty()) set.blocks.push_back(std::move(block));
        return symbolic_.closed(std::move(set));
    }

  private:
    [[nodiscard]] EquationBlock constraints()
    {
        EquationBlock block{"constraints", "Ψ^A(t, x, Y) = 0", R"(\Psi^A(t, x, Y) = 0)", {}};
        for (const Tree& constraint : written_.constraints)
            block.equations.push_back(symbolic_.equation(LeftSide::zero, "", {symbolic_.lower(constraint)}));
        return block;
    }

    [[nodiscard]] EquationBlock brackets()
    {
        EquationBlock block{
            "brackets of sections",
            "[e_α, e_β]^a = ρ(e_α)(A_β^a) - ρ(e_β)(A_α^a) + A_α^c A_β^d C^a_cd",
            R"([e_\alpha, e_\beta]^a = \rho(e_\alpha)(A_\beta^a) - \rho(e_\beta)(A_\alpha^a) + A_\alpha^c\, A_\beta^d\, C^a_{cd})",
            {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            for (std::size_t beta = alpha + 1; beta < k_; ++beta)
                block.equations.push_back(section_equation(LeftSide::commutator, alpha, beta,
                                                           bracket(sections_[alpha], sections_[beta]),
                                                           symbolic_.algebroid().fibre));
        return block;
    }

    [[nodiscard]] EquationBlock kinematics() const
    {
        return {"kinematics", "ẋ^i = ρ^i_a Y^a", R"(\dot x^i = \rho^i_a\, Y^a)", symbolic_.kinematics(Y_)};
    }

    [[nodiscard]] EquationBlock momenta() const
    {
        EquationBlock block{
            "momenta",
            "p_α = ∂l/∂y^α,  l = L on the constraint",
            R"(p_\alpha = \frac{\partial l}{\partial y^\alpha}, \quad l = L|_{Y = b + y^\alpha e_\alpha})",
            {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, momentum_name(alpha), {p_[alpha]}));
        return block;
    }

    [[nodiscard]] EquationBlock momentum_form()
    {
        EquationBlock block{"equations of motion (momentum form)", "ṗ_α", R"(\dot p_\alpha)", {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            block.equations.push_back(
                {LeftSide::time_derivative, momentum_name(alpha), {}, symbolic_.simplified(balance(alpha))});
        append_right_side(block, {anchor_term_, bracket_term_, section_term_, force_term_});
        block.formula += ",  P_a = ∂L/∂Y^a";
        block.latex_formula += R"(, \quad P_a = \frac{\partial L}{\partial Y^a})";
        return block;
    }

    [[nodiscard]] EquationBlock acceleration_form()
    {
        const FormulaTerm drift{
            "-(∂²l/∂y^α∂x^i) ẋ^i - ∂²l/∂y^α∂t",
            R"(-\frac{\partial^2 l}{\partial y^\alpha \partial x^i}\, \dot x^i - \frac{\partial^2 l}{\partial y^\alpha \partial t})"};
        EquationBlock block{
            "equations of motion (acceleration form)", "W_αβ ẏ^β", R"(W_{\alpha\beta}\, \dot y^\beta)", {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha) {
            Equation next{LeftSide::time_derivative, written_.y[alpha].name, {}, {}};
            for (std::size_t beta = 0; beta < k_; ++beta)
                for (TermGroup& mass :
                     symbolic_.simplified({{written_.y[beta].name, symbolic_.derivative(p_[alpha], y_[beta])}}))
                    next.mass.push_back(std::move(mass));
            std::vector<Group> groups = balance(alpha);
            groups.insert(groups.begin() + 1, {drift.label, -at_fixed_velocity(p_[alpha])});
            next.groups = symbolic_.simplified(std::move(groups));
            if (next.mass.empty()) next.left = LeftSide::zero;
            block.equations.push_back(std::move(next));
        }
        append_right_side(block, {anchor_term_, drift, bracket_term_, section_term_, force_term_});
        return block;
    }

    [[nodiscard]] std::string energy_name() const { return symbolic_.free_name({"E", "E_L"}); }
    [[nodiscard]] std::string moving_energy_name() const { return symbolic_.free_name({"E_m", "E_moving"}); }

    [[nodiscard]] EquationBlock energy() const
    {
        Sum terms = {-l_};
        for (std::size_t a = 0; a < r_; ++a) terms.push_back(Y_[a] * P_[a]);
        return {"energy",
                "E = Y^a P_a - L",
                "E = Y^a P_a - L",
                {symbolic_.equation(LeftSide::symbol, energy_name(), terms)}};
    }

    /// Q_a Y^a - dL/dt; with a drift the reactions do work, and the moving energy tells more.
    [[nodiscard]] EquationBlock energy_balance()
    {
        const FormulaTerm work{"Q_a Y^a", R"(Q_a\, Y^a)"};
        const FormulaTerm rate{"-∂L/∂t", R"(-\frac{\partial L}{\partial t})"};
        EquationBlock block{"energy balance", "Ė", R"(\dot E)", {}};
        if (has_drift()) return block;
        Sum power;
        for (std::size_t a = 0; a < r_; ++a) power.push_back(forces_[a] * Y_[a]);
        Equation balance{LeftSide::time_derivative, energy_name(), {}, {}};
        balance.groups = symbolic_.simplified(
            {{work.label, total(power)}, {rate.label, -on_constraint(symbolic_.time_derivative(lagrangian_))}});
        block.equations.push_back(std::move(balance));
        append_right_side(block, {work, rate});
        return block;
    }

    [[nodiscard]] EquationBlock moving_energy()
    {
        EquationBlock block{
            "moving energy",
            "E_m = E - P_a b^a,  d/dt E_m = Q_a (Y^a - b^a) - ∂L/∂t - P_a ∂b^a/∂t - b^c(L)",
            R"(E_m = E - P_a\, b^a, \quad \dot E_m = Q_a (Y^a - b^a) - \frac{\partial L}{\partial t} - P_a \frac{\partial b^a}{\partial t} - b^c(L))",
            {}};
        if (!has_drift()) return block;
        Sum terms = {-l_}, work, moving;
        for (std::size_t alpha = 0; alpha < k_; ++alpha) terms.push_back(y_[alpha] * p_[alpha]);
        block.equations.push_back(symbolic_.equation(LeftSide::symbol, moving_energy_name(), terms));
        GiNaC::ex lift = total(along(drift_, l_));
        const Sum V = bracket(drift_, Y_);
        for (std::size_t a = 0; a < r_; ++a) {
            work.push_back(forces_[a] * (Y_[a] - drift_[a]));
            moving.push_back(-P_[a] * symbolic_.time_derivative(drift_[a]));
            lift -= P_[a] * V[a];
        }
        Equation balance{LeftSide::time_derivative, moving_energy_name(), {}, {}};
        balance.groups = symbolic_.simplified(
            {{"Q_a (Y^a - b^a)", total(work)},
             {"-∂L/∂t - P_a ∂b^a/∂t", total(moving) - on_constraint(symbolic_.time_derivative(lagrangian_))},
             {"-b^c(L)", -lift}});
        block.equations.push_back(std::move(balance));
        return block;
    }

    const FormulaTerm anchor_term_{"ρ(e_α)(l)", R"(\rho(e_\alpha)(l))"};
    const FormulaTerm bracket_term_{"-P_a [e_α, Y]^a", R"(-P_a\, [e_\alpha, Y]^a)"};
    const FormulaTerm section_term_{"P_a ∂A_α^a/∂t", R"(P_a\, \frac{\partial A_\alpha^a}{\partial t})"};
    const FormulaTerm force_term_{"Q_α", R"(Q_\alpha)"};
};

} // namespace

void require_lagrangian(const Model& model)
{
    if (!model.lagrangian)
        throw MathematicsError("model '" + model.name +
                               "' has no Lagrangian; nonholonomic equations need [lagrangian] L");
}

EquationSet derive_nonholonomic(const Model& model, const System& system, Definitions definitions)
{
    require_lagrangian(model);
    return derived(model, "the nonholonomic equations", definitions, [&](const DefinitionChoice& choice) {
        return NonholonomicDerivation(model, system, choice).derive();
    });
}

} // namespace lagen
