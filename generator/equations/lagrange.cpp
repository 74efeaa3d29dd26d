// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations by GiNaC, every group of the formula brought to its own shortest form. [Martinez 2001]
#include "equations/lagrange.hpp"
#include "equations/label_casimirs.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Terms of one group, kept apart until they are simplified together.
using Sum = GiNaC::exvector;

GiNaC::ex total(const Sum& terms)
{
    return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(terms));
}

class LagrangeDerivation {
  public:
    LagrangeDerivation(const Model& model, const Algebroid& algebroid) : model_(model), algebroid_(algebroid)
    {
        for (const Parameter& parameter : model.parameters) order_.parameters.push_back(parameter.symbol.name);
        for (const NamedTree& casimir : model.base.casimirs)
            if (!is_declared(casimir.name)) order_.parameters.push_back(casimir.name);
        if (!is_declared("t")) order_.variables.emplace_back("t");
        for (const Symbol& symbol : algebroid.base) x_.push_back(variable(symbol.name));
        for (const Symbol& symbol : algebroid.fibre) y_.push_back(variable(symbol.name));
        for (const Symbol& symbol : model.fibre.momenta) momenta_.push_back(variable(symbol.name));
        lower();
    }

    EquationSet derive()
    {
        EquationSet set{model_.name, model_.title, "lagrange", {}, {}};
        append_symbols(set);
        set.blocks = {kinematics(), momenta(), momentum_form(), acceleration_form(), energy()};
        if (!labels_.empty()) set.blocks.insert(set.blocks.begin() + 1, casimirs());
        return set;
    }

  private:
    [[nodiscard]] bool is_declared(const std::string& name) const
    {
        const std::vector<std::string> names = symbol_names(model_);
        return std::find(names.begin(), names.end(), name) != names.end();
    }

    GiNaC::realsymbol variable(const std::string& name)
    {
        order_.variables.push_back(name);
        return symbols_.symbol(name);
    }

    void lower()
    {
        anchor_.assign(y_.size(), std::vector<GiNaC::ex>(x_.size()));
        for (const AnchorValue& entry : algebroid_.rho) anchor_[entry.a][entry.i] += to_ginac(entry.value, symbols_);
        const std::size_t r = y_.size();
        std::vector<bool> given(r * r, false);
        bracket_.assign(r * r, std::vector<GiNaC::ex>(r));
        for (const StructureValue& entry : algebroid_.C) {
            given[entry.a * r + entry.b] = true;
            bracket_[entry.a * r + entry.b][entry.c] += to_ginac(entry.value, symbols_);
        }
        for (std::size_t a = 0; a < r; ++a)
            for (std::size_t b = 0; b < r; ++b)
                if (given[a * r + b] && !given[b * r + a])
                    for (std::size_t c = 0; c < r; ++c) bracket_[b * r + a][c] = -bracket_[a * r + b][c];
        take_labels();
        lagrangian_ = to_ginac(label_casimirs(model_.lagrangian, labels_), symbols_);
        for (const GiNaC::realsymbol& y : y_) p_.push_back(lagrangian_.diff(y));
    }

    /// The Casimirs that L uses by name. A label is a constant only where rho_a(f) = 0 is plain to see.
    void take_labels()
    {
        std::vector<NamedTree> constant;
        for (const NamedTree& casimir : model_.base.casimirs) {
            const GiNaC::ex f = to_ginac(casimir.value, symbols_);
            bool zero = !is_declared(casimir.name);
            for (std::size_t a = 0; a < y_.size() && zero; ++a) zero = total(along_anchor(a, f)).expand().is_zero();
            if (zero) constant.push_back(casimir);
        }
        const std::vector<std::string> used = names_in(label_casimirs(model_.lagrangian, constant));
        for (const NamedTree& casimir : constant)
            if (std::find(used.begin(), used.end(), casimir.name) != used.end()) labels_.push_back(casimir);
    }

    void append_symbols(EquationSet& set) const
    {
        for (const Parameter& parameter : model_.parameters)
            set.symbols.push_back({parameter.symbol.name, parameter.symbol.latex});
        for (const std::vector<Symbol>* list : {&algebroid_.base, &algebroid_.fibre})
            for (const Symbol& symbol : *list) set.symbols.push_back({symbol.name, symbol.latex});
        for (std::size_t a = 0; a < model_.fibre.momenta.size(); ++a) {
            const Symbol& momentum = model_.fibre.momenta[a];
            const Symbol& coordinate = algebroid_.fibre[a];
            const bool follows =
                momentum.latex.empty() && !coordinate.latex.empty() && momentum.name == "p_" + coordinate.name;
            set.symbols.push_back({momentum.name, follows ? "p_{" + coordinate.latex + "}" : momentum.latex});
        }
    }

    [[nodiscard]] Tree shortest(const GiNaC::ex& e) const { return shortest_form(e, symbols_, order_); }

    /// Adds a group unless it is zero.
    void append(std::vector<TermGroup>& groups, const char* label, const Sum& terms) const
    {
        const Tree value = shortest(total(terms));
        if (value->kind != TreeKind::number || value->number != 0) groups.push_back({label, value});
    }

    [[nodiscard]] Equation equation(LeftSide left, const std::string& symbol, const Sum& terms) const
    {
        Equation result{left, symbol, {}, {}};
        append(result.groups, "", terms);
        return result;
    }

    /// rho_a(f) = rho^i_a df/dx^i
    [[nodiscard]] Sum along_anchor(std::size_t a, const GiNaC::ex& f) const
    {
        Sum terms;
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (!anchor_[a][i].is_zero()) terms.push_back(anchor_[a][i] * f.diff(x_[i]));
        return terms;
    }

    /// -p_c C^c_ab y^b for given momenta
    template <class Momenta>
    [[nodiscard]] Sum bracket_terms(std::size_t a, const Momenta& p) const
    {
        Sum terms;
        for (std::size_t b = 0; b < y_.size(); ++b)
            for (std::size_t c = 0; c < y_.size(); ++c)
                if (!bracket_[a * y_.size() + b][c].is_zero())
                    terms.push_back(-p[c] * bracket_[a * y_.size() + b][c] * y_[b]);
        return terms;
    }

    /// One group of a formula before it is simplified.
    struct Group {
        std::string label;
        GiNaC::ex value;
    };

    /// Simplifies the groups each for itself; two that hold like terms are one group, or terms that cancel would be
    /// shown.
    [[nodiscard]] std::vector<TermGroup> simplified(std::vector<Group> groups) const
    {
        for (std::size_t k = 0; k < groups.size(); ++k)
            for (std::size_t l = k + 1; l < groups.size(); ++l) {
                const auto first = expanded_length(groups[k].value);
                const auto second = expanded_length(groups[l].value);
                const auto both = expanded_length(groups[k].value + groups[l].value);
                if (!first || !second || !both || *first == 0 || *second == 0 || *both >= *first + *second) continue;
                groups[k].value += groups[l].value;
                groups[k].label += " - " + groups[l].label.substr(1);
                groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(l));
                l = k;
            }
        std::vector<TermGroup> result;
        for (const Group& group : groups) append(result, group.label.c_str(), {group.value});
        return result;
    }

    /// -(d2L/dy^a dx^i) rho^i_b y^b
    [[nodiscard]] Sum drift_terms(std::size_t a) const
    {
        Sum terms;
        for (std::size_t b = 0; b < y_.size(); ++b)
            for (const GiNaC::ex& term : along_anchor(b, p_[a])) terms.push_back(-term * y_[b]);
        return terms;
    }

    [[nodiscard]] EquationBlock kinematics() const
    {
        EquationBlock block{"kinematics", "ẋ^i = ρ^i_a y^a", R"(\dot x^i = \rho^i_a\, y^a)", {}};
        for (std::size_t i = 0; i < x_.size(); ++i) {
            Sum terms;
            for (std::size_t a = 0; a < y_.size(); ++a) terms.push_back(anchor_[a][i] * y_[a]);
            block.equations.push_back(equation(LeftSide::time_derivative, algebroid_.base[i].name, terms));
        }
        return block;
    }

    [[nodiscard]] EquationBlock casimirs()
    {
        EquationBlock block{"labels of the leaves (constant along every motion)", "ρ_a(f) = 0", R"(\rho_a(f) = 0)", {}};
        for (const NamedTree& casimir : labels_)
            block.equations.push_back(equation(LeftSide::symbol, casimir.name, {to_ginac(casimir.value, symbols_)}));
        return block;
    }

    [[nodiscard]] EquationBlock momenta() const
    {
        EquationBlock block{"momenta", "p_a = ∂L/∂y^a", R"(p_a = \frac{\partial L}{\partial y^a})", {}};
        for (std::size_t a = 0; a < momenta_.size(); ++a)
            block.equations.push_back(equation(LeftSide::symbol, model_.fibre.momenta[a].name, {p_[a]}));
        return block;
    }

    [[nodiscard]] EquationBlock momentum_form() const
    {
        EquationBlock block{"equations of motion (momentum form)",
                            "ṗ_a = ρ_a(L) - p_c C^c_ab y^b",
                            R"(\dot p_a = \rho_a(L) - p_c\, C^c_{ab}\, y^b)",
                            {}};
        for (std::size_t a = 0; a < momenta_.size(); ++a) {
            Equation next{LeftSide::time_derivative, model_.fibre.momenta[a].name, {}, {}};
            append(next.groups, "ρ_a(L)", along_anchor(a, lagrangian_));
            append(next.groups, "-p_c C^c_ab y^b", bracket_terms(a, momenta_));
            block.equations.push_back(std::move(next));
        }
        return block;
    }

    [[nodiscard]] EquationBlock acceleration_form()
    {
        EquationBlock block{
            "equations of motion (acceleration form)",
            "W_ab ẏ^b = ρ_a(L) - (∂²L/∂y^a∂x^i) ρ^i_b y^b - ∂²L/∂y^a∂t - p_c C^c_ab y^b,  W_ab = ∂²L/∂y^a∂y^b",
            R"(W_{ab}\, \dot y^b = \rho_a(L) - \frac{\partial^2 L}{\partial y^a \partial x^i}\, \rho^i_b\, y^b - \frac{\partial^2 L}{\partial y^a \partial t} - p_c\, C^c_{ab}\, y^b, \quad W_{ab} = \frac{\partial^2 L}{\partial y^a \partial y^b})",
            {}};
        for (std::size_t a = 0; a < y_.size(); ++a) {
            Equation next{LeftSide::time_derivative, algebroid_.fibre[a].name, {}, {}};
            for (std::size_t b = 0; b < y_.size(); ++b)
                append(next.mass, algebroid_.fibre[b].name.c_str(), {p_[a].diff(y_[b])});
            std::vector<Group> groups = {{"ρ_a(L)", total(along_anchor(a, lagrangian_))},
                                         {"-(∂²L/∂y^a∂x^i) ρ^i_b y^b", total(drift_terms(a))}};
            if (!is_declared("t")) groups.push_back({"-∂²L/∂y^a∂t", -p_[a].diff(symbols_.symbol("t"))});
            groups.push_back({"-p_c C^c_ab y^b", total(bracket_terms(a, p_))});
            next.groups = simplified(std::move(groups));
            if (next.mass.empty()) next.left = LeftSide::zero;
            block.equations.push_back(std::move(next));
        }
        return block;
    }

    [[nodiscard]] EquationBlock energy() const
    {
        EquationBlock block{"energy", "E = y^a p_a - L", R"(E = y^a p_a - L)", {}};
        Sum terms = {-lagrangian_};
        for (std::size_t a = 0; a < y_.size(); ++a) terms.push_back(y_[a] * p_[a]);
        block.equations.push_back(equation(LeftSide::symbol, is_declared("E") ? "E_L" : "E", terms));
        return block;
    }

    const Model& model_;
    const Algebroid& algebroid_;
    SymbolTable symbols_;
    Order order_;
    std::vector<GiNaC::realsymbol> x_, y_, momenta_;
    std::vector<NamedTree> labels_; ///< Casimirs that stand in L by name
    GiNaC::ex lagrangian_;
    std::vector<std::vector<GiNaC::ex>> anchor_;  ///< anchor_[a][i] = rho^i_a
    std::vector<std::vector<GiNaC::ex>> bracket_; ///< bracket_[a r + b][c] = C^c_ab
    std::vector<GiNaC::ex> p_;
};

} // namespace

EquationSet derive_lagrange(const Model& model, const Algebroid& algebroid)
{
    if (!model.lagrangian)
        throw MathematicsError("error: model '" + model.name +
                               "' has no Lagrangian; Lagrange's equations need [lagrangian] L");
    try {
        return LagrangeDerivation(model, algebroid).derive();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw MathematicsError("error: Lagrange's equations of model '" + model.name +
                               "' could not be derived: " + error.what());
    }
}

} // namespace lagen
