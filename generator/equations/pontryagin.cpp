// SPDX-License-Identifier: GPL-2.0-or-later
/// Pontryagin's equations of an optimal control problem on a Lie algebroid, normal extremals, for a person to read:
///   H(x, mu, u) = mu_a sigma^a(x, u) - cost(x, u),   u maximises H: dH/du^A = 0 where no bound is reached
///   xdot^i = rho^i_a sigma^a,   mudot_a = -rho_a(H) - mu_c C^c_ab sigma^b,   dH/dt = dH/dt at fixed x, mu, u
///                                                                                            [Martinez 2004]
#include "equations/derivations.hpp"

#include "equations/given_blocks.hpp"
#include "equations/linear_equations.hpp"
#include "equations/symbolic_model.hpp"
#include "model/scene_form.hpp"
#include "verify/control_maximum.hpp"

#include <algorithm>

namespace lagen {
namespace {

class PontryaginDerivation {
  public:
    PontryaginDerivation(const Model& model, const WrittenAlgebroid& algebroid, const ControlMaximum& maximum,
                         const DefinitionChoice& choice)
        : control_(*model.control), maximal_(maximum.kind == ControlMaximum::Kind::maximal), angles_(maximum.angles),
          symbolic_(model, algebroid, functions_of(*model.control), choice, substituted_in(model, algebroid)),
          sigma_(symbolic_.r(), 0)
    {
        for (const ComponentEntry& entry : control_.sigma) sigma_[entry.section] += symbolic_.lower(entry.value);
        Sum terms;
        if (control_.cost) terms.push_back(-symbolic_.lower(control_.cost));
        for (std::size_t a = 0; a < symbolic_.r(); ++a) terms.push_back(symbolic_.mu()[a] * sigma_[a]);
        hamiltonian_ = total(terms);
        find_angles();
        if (maximum.kind != ControlMaximum::Kind::unsolved) solve_controls();
    }

    EquationSet derive()
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::pontryagin).name);
        set.given = given_blocks({}, constraints_and_invariants(symbolic_));
        set.blocks = {hamiltonian()};
        if (EquationBlock labels = symbolic_.casimirs(); !labels.equations.empty()) set.blocks.push_back(labels);
        set.blocks.push_back(section());
        set.blocks.push_back(condition());
        if (!optimal_ && !control_.bounds.empty()) set.blocks.push_back(bounds());
        if (!directions_.empty()) set.blocks.push_back(angles());
        if (optimal_ && !optimal_->empty()) set.blocks.push_back(optimal_controls());
        if (optimal_ && maximal_ && control_.bounds.empty()) set.blocks.push_back(maximal_hamiltonian());
        set.blocks.push_back(
            {"kinematics", "ẋ^i = ρ^i_a σ^a", R"(\dot x^i = \rho^i_a\, \sigma^a)", symbolic_.kinematics(sigma_)});
        set.blocks.push_back(motion());
        Equation balance =
            symbolic_.equation(LeftSide::time_derivative, energy_name(), {symbolic_.time_derivative(hamiltonian_)});
        if (!balance.groups.empty())
            set.blocks.push_back(
                {"energy balance", "Ḣ = ∂H/∂t", R"(\dot H = \frac{\partial H}{\partial t})", {std::move(balance)}});
        if (EquationBlock states = symbolic_.states(sigma_); !states.equations.empty())
            set.blocks.push_back(std::move(states));
        return symbolic_.closed(std::move(set));
    }

  private:
    /// Controls, for which their values are put in, and velocities, for which sigma is.
    static std::set<std::string> substituted_in(const Model& model, const WrittenAlgebroid& algebroid)
    {
        std::set<std::string> names = name_set(algebroid.fibre);
        names.merge(name_set(model.control->controls));
        return names;
    }

    static std::vector<Tree> functions_of(const Control& control)
    {
        std::vector<Tree> functions = {control.cost};
        for (const ComponentEntry& entry : control.sigma) functions.push_back(entry.value);
        return functions;
    }

    [[nodiscard]] std::string energy_name() const { return symbolic_.free_name({"H", "H_P"}); }
    [[nodiscard]] const std::string& control_name(std::size_t A) const { return control_.controls[A].name; }

    /// b and c of each angle u, of H = a + b cos u + c sin u.
    struct Direction {
        std::size_t control;
        GiNaC::ex b, c;
    };

    /// b = -d2H/du2 and c = dH/du at u = 0.
    void find_angles()
    {
        const Sum& u = symbolic_.controls();
        GiNaC::exmap upright;
        for (const std::size_t A : angles_) {
            GiNaC::exmap zero;
            zero[u[A]] = upright[u[A]] = 0;
            const GiNaC::ex slope = symbolic_.derivative(hamiltonian_, u[A]);
            directions_.push_back({A, (-symbolic_.derivative(slope, u[A])).subs(zero, GiNaC::subs_options::no_pattern),
                                   slope.subs(zero, GiNaC::subs_options::no_pattern)});
        }
        rest_ = hamiltonian_.subs(upright, GiNaC::subs_options::no_pattern);
        for (std::size_t A = 0; A < u.size(); ++A)
            if (!std::ranges::binary_search(angles_, A)) others_.push_back(A);
    }

    /// u with dH/du = 0 where that is a regular linear system in the controls that are no angles.
    void solve_controls()
    {
        Sum u;
        for (const std::size_t A : others_) u.push_back(symbolic_.controls()[A]);
        GiNaC::exmap none;
        for (const GiNaC::ex& control : u) none[control] = 0;
        SquareMatrix second{u.size(), {}};
        Sum first, right;
        for (const GiNaC::ex& control : u) {
            first.push_back(symbolic_.derivative(rest_, control));
            for (const GiNaC::ex& other : u) {
                GiNaC::ex entry = symbolic_.derivative(first.back(), other);
                if (expanded_length(entry)) entry = entry.expand();
                if (std::any_of(u.begin(), u.end(), [&](const GiNaC::ex& symbol) { return entry.has(symbol); })) return;
                second.entries.push_back(entry);
            }
        }
        // Affine in u, and so defined at 0.
        for (const GiNaC::ex& slope : first) right.push_back(-slope.subs(none, GiNaC::subs_options::no_pattern));
        optimal_ = u.empty() ? std::optional<Sum>(Sum{})
                             : solve_in_blocks(second, right, [&](const GiNaC::ex& e) { return symbolic_.simpler(e); });
    }

    [[nodiscard]] EquationBlock hamiltonian() const
    {
        return {"Hamiltonian",
                "H = μ_a σ^a - cost",
                R"(H = \mu_a\, \sigma^a - \mathit{cost})",
                {symbolic_.equation(LeftSide::symbol, energy_name(), {hamiltonian_})}};
    }

    [[nodiscard]] EquationBlock section() const
    {
        EquationBlock block{"section of the controls", "y^a = σ^a(x, u)", R"(y^a = \sigma^a(x, u))", {}};
        for (std::size_t a = 0; a < symbolic_.r(); ++a)
            block.equations.push_back(
                symbolic_.equation(LeftSide::symbol, symbolic_.algebroid().fibre[a].name, {sigma_[a]}));
        return block;
    }

    [[nodiscard]] EquationBlock condition() const
    {
        EquationBlock block{"condition for the controls", "0 = ∂H/∂u^A", R"(0 = \frac{\partial H}{\partial u^A})", {}};
        if (!control_.bounds.empty()) {
            block.formula += ", or u^A at a bound where H is largest";
            block.latex_formula += R"(, \text{ or } u^A \text{ at a bound where } H \text{ is largest})";
        }
        for (const GiNaC::ex& control : symbolic_.controls())
            block.equations.push_back(
                symbolic_.equation(LeftSide::zero, "", {symbolic_.derivative(hamiltonian_, control)}));
        return block;
    }

    /// Where there is no formula for the controls to cut.
    [[nodiscard]] EquationBlock bounds() const
    {
        EquationBlock block{
            "bounds of the controls", "u^A_min ≤ u^A ≤ u^A_max", R"(u^A_{\min} \leq u^A \leq u^A_{\max})", {}};
        const auto append = [&](const ControlBound& bound, const Tree& end, Relation relation) {
            if (!end) return;
            Equation next{LeftSide::symbol, control_name(bound.control), {}, {{"", end}}};
            next.relation = relation;
            block.equations.push_back(std::move(next));
        };
        for (const ControlBound& bound : control_.bounds) {
            append(bound, bound.lower, Relation::at_least);
            append(bound, bound.upper, Relation::at_most);
        }
        return block;
    }

    [[nodiscard]] EquationBlock angles() const
    {
        EquationBlock block{"optimal angles",
                            "H = a + b cos u + c sin u is largest at u = atan2(c, b), up to whole turns",
                            R"(H = a + b \cos u + c \sin u \text{ is largest at } u = \operatorname{atan2}(c, b))"
                            R"(\text{, up to whole turns})",
                            {}};
        const auto value = [&](const GiNaC::ex& term) {
            const Equation equation = symbolic_.equation(LeftSide::symbol, "", {term});
            return equation.groups.empty() ? number(0) : equation.groups[0].value;
        };
        for (const Direction& direction : directions_) {
            Equation next{LeftSide::symbol, control_name(direction.control), {}, {}};
            next.groups = {{"", call(Function::atan2, {value(direction.c), value(direction.b)})}};
            block.equations.push_back(std::move(next));
        }
        return block;
    }

    /// u cut to its bounds: a concave function of one variable is largest at the admissible point next to its maximum.
    [[nodiscard]] EquationBlock optimal_controls() const
    {
        EquationBlock block{"optimal controls", "u(x, μ)", R"(u(x, \mu))", {}};
        if (!maximal_) {
            block.title = "stationary controls";
            block.formula += " with ∂H/∂u^A = 0; that H is largest there is not proved";
            block.latex_formula += R"(\text{ with } \partial H/\partial u^A = 0\text{; that } H)"
                                   R"(\text{ is largest there is not proved})";
        }
        for (std::size_t k = 0; k < others_.size(); ++k) {
            const std::size_t A = others_[k];
            Equation next = symbolic_.equation(LeftSide::symbol, control_name(A), {(*optimal_)[k]});
            for (const ControlBound& bound : control_.bounds) {
                if (bound.control != A) continue;
                Tree value = next.groups.empty() ? number(0) : next.groups[0].value;
                if (bound.lower) value = call(Function::maximum, {value, bound.lower});
                if (bound.upper) value = call(Function::minimum, {value, bound.upper});
                next.groups = {{"", value}};
            }
            block.equations.push_back(std::move(next));
        }
        return block;
    }

    [[nodiscard]] EquationBlock maximal_hamiltonian() const
    {
        GiNaC::exmap inserted;
        for (std::size_t k = 0; k < others_.size(); ++k) inserted[symbolic_.controls()[others_[k]]] = (*optimal_)[k];
        Sum terms = {rest_.subs(inserted, GiNaC::subs_options::no_pattern)};
        for (const Direction& direction : directions_) {
            terms.push_back(-direction.b);
            terms.push_back(GiNaC::sqrt(direction.b * direction.b + direction.c * direction.c));
        }
        return {"maximal Hamiltonian",
                "H_max(x, μ) = H(x, μ, u(x, μ))",
                R"(H_{\max}(x, \mu) = H(x, \mu, u(x, \mu)))",
                {symbolic_.equation(LeftSide::symbol, "H_max", {total(terms)})}};
    }

    [[nodiscard]] EquationBlock motion() const
    {
        const FormulaTerm anchor{"-ρ_a(H)", R"(-\rho_a(H))"};
        const FormulaTerm bracket{"-μ_c C^c_ab σ^b", R"(-\mu_c\, C^c_{ab}\, \sigma^b)"};
        EquationBlock block{"equations of motion", "μ̇_a", R"(\dot \mu_a)", {}};
        for (std::size_t a = 0; a < symbolic_.r(); ++a) {
            Equation next{LeftSide::time_derivative, symbolic_.momentum_name(a), {}, {}};
            next.groups =
                symbolic_.simplified({{anchor.label, -total(symbolic_.along_anchor(a, hamiltonian_))},
                                      {bracket.label, total(symbolic_.bracket_terms(a, symbolic_.mu(), sigma_))}});
            block.equations.push_back(std::move(next));
        }
        append_right_side(block, {anchor, bracket});
        return block;
    }

    const Control& control_;
    bool maximal_; ///< proved
    const std::vector<std::size_t>& angles_;
    std::vector<std::size_t> others_; ///< the controls that are no angles
    SymbolicModel symbolic_;
    Sum sigma_; ///< sigma^a(t, x, u), shape (r)
    GiNaC::ex hamiltonian_;
    GiNaC::ex rest_; ///< H where the angles are 0
    std::vector<Direction> directions_;
    std::optional<Sum> optimal_; ///< u^A(t, x, mu) of the others, without bounds
};

} // namespace

EquationSet derive_pontryagin(const Model& model, const WrittenAlgebroid& algebroid, const ControlMaximum& maximum,
                              Definitions definitions)
{
    if (!model.control)
        throw MathematicsError("model '" + model.name +
                               "' has no controls; Pontryagin's equations need [control] controls, sigma and cost");
    if (maximum.kind == ControlMaximum::Kind::refuted || maximum.kind == ControlMaximum::Kind::nonsmooth)
        require_maximum(model.name, maximum);
    return derived(model, "Pontryagin's equations", definitions, [&](const DefinitionChoice& choice) {
        return PontryaginDerivation(model, algebroid, maximum, choice).derive();
    });
}

} // namespace lagen
