// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a y^a,   p_a = dL/dy^a,   d/dt p_a = rho_a(L) - p_c C^c_ab y^b + Q_a               (momentum form)
///   W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b + Q_a     (acceleration form)
///   Q_a = forces_a - dR/dy^a,   E_L = y^a p_a - L,   dE_L/dt = Q_a y^a - dL/dt                   [Martinez 2001]
#include "equations/derivations.hpp"

#include "equations/given_blocks.hpp"
#include "expression/parse.hpp"
#include "model/form.hpp"
#include "symbolic/shortest_form.hpp"
#include "text/activity.hpp"

#include <fmt/core.h>

namespace lagen {
namespace {

class LagrangeDerivation {
  public:
    LagrangeDerivation(const Model& model, const WrittenAlgebroid& algebroid, const DefinitionChoice& choice)
        : symbolic_(model, algebroid, {model.lagrangian, model.dissipation}, choice),
          lagrangian_(symbolic_.reduced(symbolic_.lower(model.lagrangian))), forces_(symbolic_.forces(symbolic_.y()))
    {
        for (const GiNaC::ex& y : symbolic_.y()) p_.push_back(symbolic_.derivative(lagrangian_, y));
    }

    EquationSet derive(const Regularity& regularity)
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::lagrange).name);
        set.given = given_blocks({lagrangian_block(symbolic_, lagrangian_, "x, y"), bracket_block(symbolic_)},
                                 constraints_and_invariants(symbolic_));
        set.blocks = {
            {"kinematics", "ẋ^i = ρ^i_a y^a", R"(\dot x^i = \rho^i_a\, y^a)", symbolic_.kinematics(symbolic_.y())}};
        if (EquationBlock labels = symbolic_.casimirs(); !labels.equations.empty()) set.blocks.push_back(labels);
        for (EquationBlock& block : std::vector{momenta(), momentum_form(), acceleration_form(), energy()})
            set.blocks.push_back(std::move(block));
        if (EquationBlock balance = energy_balance(); !balance.equations[0].groups.empty())
            set.blocks.push_back(std::move(balance));
        if (EquationBlock states = symbolic_.states(symbolic_.y()); !states.equations.empty())
            set.blocks.push_back(std::move(states));
        append_kernel(set, regularity);
        return symbolic_.closed(std::move(set));
    }

  private:
    [[nodiscard]] std::size_t r() const { return symbolic_.r(); }
    [[nodiscard]] const std::string& fibre_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }

    /// -(d2L/dy^a dx^i) rho^i_b y^b
    [[nodiscard]] Sum drift_terms(std::size_t a) const
    {
        Sum terms;
        for (std::size_t b = 0; b < r(); ++b)
            for (const GiNaC::ex& term : symbolic_.along_anchor(b, p_[a])) terms.push_back(-term * symbolic_.y()[b]);
        return terms;
    }

    [[nodiscard]] EquationBlock momenta() const
    {
        EquationBlock block{"momenta", "p_a = ∂L/∂y^a", R"(p_a = \frac{\partial L}{\partial y^a})", {}};
        for (std::size_t a = 0; a < r(); ++a)
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, symbolic_.momentum_name(a), {p_[a]}));
        return block;
    }

    [[nodiscard]] EquationBlock momentum_form() const
    {
        EquationBlock block{"equations of motion (momentum form)", "ṗ_a", R"(\dot p_a)", {}};
        Activity activity("momentum form", r());
        for (std::size_t a = 0; a < r(); ++a) {
            activity.next();
            Equation next{LeftSide::time_derivative, symbolic_.momentum_name(a), {}, {}};
            // Each group for itself: nothing cancels between the momenta and L.
            for (const Group& group :
                 {Group{anchor_term_.label, total(symbolic_.along_anchor(a, lagrangian_))},
                  Group{bracket_term_.label, total(symbolic_.bracket_terms(a, symbolic_.mu(), symbolic_.y()))},
                  Group{force_term_.label, forces_[a]}})
                for (TermGroup& simple : symbolic_.simplified({group})) next.groups.push_back(std::move(simple));
            block.equations.push_back(std::move(next));
        }
        append_right_side(block, {anchor_term_, bracket_term_, force_term_});
        return block;
    }

    [[nodiscard]] EquationBlock acceleration_form()
    {
        const FormulaTerm drift{"-(∂²L/∂y^a∂x^i) ρ^i_b y^b",
                                R"(-\frac{\partial^2 L}{\partial y^a \partial x^i}\, \rho^i_b\, y^b)"};
        const FormulaTerm rate{"-∂²L/∂y^a∂t", R"(-\frac{\partial^2 L}{\partial y^a \partial t})"};
        EquationBlock block{"equations of motion (acceleration form)", "W_ab ẏ^b", R"(W_{ab}\, \dot y^b)", {}};
        Activity activity("acceleration form", r());
        for (std::size_t a = 0; a < r(); ++a) {
            activity.next();
            Equation next{LeftSide::time_derivative, fibre_name(a), {}, {}};
            for (std::size_t b = 0; b < r(); ++b)
                for (TermGroup& mass :
                     symbolic_.simplified({{fibre_name(b), symbolic_.derivative(p_[a], symbolic_.y()[b])}}))
                    next.mass.push_back(std::move(mass));
            next.groups =
                symbolic_.simplified({{anchor_term_.label, total(symbolic_.along_anchor(a, lagrangian_))},
                                      {drift.label, total(drift_terms(a))},
                                      {rate.label, -symbolic_.time_derivative(p_[a])},
                                      {bracket_term_.label, total(symbolic_.bracket_terms(a, p_, symbolic_.y()))},
                                      {force_term_.label, forces_[a]}});
            if (next.mass.empty()) next.left = LeftSide::zero;
            block.equations.push_back(std::move(next));
        }
        append_right_side(block, {anchor_term_, drift, rate, bracket_term_, force_term_});
        block.formula += ",  W_ab = ∂²L/∂y^a∂y^b";
        block.latex_formula += R"(, \quad W_{ab} = \frac{\partial^2 L}{\partial y^a \partial y^b})";
        return block;
    }

    [[nodiscard]] std::string energy_name() const { return symbolic_.free_name({"E", "E_L"}); }

    [[nodiscard]] EquationBlock energy() const
    {
        return {"energy",
                "E = y^a p_a - L",
                R"(E = y^a p_a - L)",
                {symbolic_.equation(LeftSide::symbol, energy_name(), energy_terms())}};
    }

    /// y^a p_a - L term by term of L: one that is homogeneous of degree k in y, k - 1 times as it is.
    [[nodiscard]] Sum energy_terms() const
    {
        Sum terms;
        const auto append = [&](const GiNaC::ex& term) {
            const GiNaC::ex rate = symbolic_.along_fibre(term);
            for (const int degree : {0, 1, 2})
                if (expanded_length(rate - degree * term) == std::optional<std::size_t>(0)) {
                    if (degree != 1) terms.push_back((degree - 1) * term);
                    return;
                }
            terms.push_back(rate);
            terms.push_back(-term);
        };
        if (GiNaC::is_a<GiNaC::add>(lagrangian_))
            for (const GiNaC::ex& term : lagrangian_) append(term);
        else
            append(lagrangian_);
        return terms;
    }

    [[nodiscard]] EquationBlock energy_balance()
    {
        Sum power;
        for (std::size_t a = 0; a < r(); ++a) power.push_back(forces_[a] * symbolic_.y()[a]);
        Equation balance{LeftSide::time_derivative, energy_name(), {}, {}};
        const FormulaTerm work{"Q_a y^a", R"(Q_a\, y^a)"};
        const FormulaTerm rate{"-∂L/∂t", R"(-\frac{\partial L}{\partial t})"};
        balance.groups =
            symbolic_.simplified({{work.label, total(power)}, {rate.label, -symbolic_.time_derivative(lagrangian_)}});
        EquationBlock block{"energy balance", "Ė", R"(\dot E)", {std::move(balance)}};
        append_right_side(block, {work, rate});
        return block;
    }

    /// The accelerations are free along these.
    void append_kernel(EquationSet& set, const Regularity& regularity)
    {
        for (std::size_t k = 0; k < regularity.kernel.size(); ++k) {
            EquationBlock block{"L is degenerate: kernel of W", "W_ab k^b = 0", R"(W_{ab}\, k^b = 0)", {}};
            if (regularity.kernel.size() > 1)
                block.title += fmt::format(", vector {} of {}", k + 1, regularity.kernel.size());
            for (const auto& [coordinate, component] : regularity.kernel[k]) {
                block.equations.push_back(
                    symbolic_.equation(LeftSide::symbol, "k_" + coordinate, {symbolic_.lower(component)}));
            }
            set.blocks.push_back(std::move(block));
        }
    }

    const FormulaTerm anchor_term_{"ρ_a(L)", R"(\rho_a(L))"};
    const FormulaTerm bracket_term_{"-p_c C^c_ab y^b", R"(-p_c\, C^c_{ab}\, y^b)"};
    const FormulaTerm force_term_{"Q_a", "Q_a"};
    SymbolicModel symbolic_;
    GiNaC::ex lagrangian_;
    Sum p_;      ///< p_a, shape (r)
    Sum forces_; ///< Q_a, shape (r)
};

} // namespace

EquationSet derive_lagrange(const Model& model, const WrittenAlgebroid& algebroid, const Regularity& regularity,
                            Definitions definitions)
{
    if (!model.lagrangian)
        throw MathematicsError("model '" + model.name +
                               "' has no Lagrangian; Lagrange's equations need [lagrangian] L");
    return derived(model, "Lagrange's equations", definitions, [&](const DefinitionChoice& choice) {
        return LagrangeDerivation(model, algebroid, choice).derive(regularity);
    });
}

} // namespace lagen
