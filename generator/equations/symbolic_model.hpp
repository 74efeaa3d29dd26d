// SPDX-License-Identifier: GPL-2.0-or-later
/// A model in GiNaC, with what the derivations of all formulations share: rho, C, forces, the groups of a formula, each
/// brought to its own shortest form, in an order and with signs of our own, so that the text is the same on every run.
#pragma once

#include "equations/kept_symbols.hpp"
#include "mechanics/written_algebroid.hpp"
#include "model/model.hpp"
#include "symbolic/shortest_form.hpp"
#include "typeset/equation_set.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace lagen {

/// Terms of one group, kept apart until they are simplified together.
using Sum = GiNaC::exvector;
[[nodiscard]] GiNaC::ex total(const Sum& terms);

/// One group of a formula before it is simplified. The label begins with '-' where the formula subtracts the group.
struct Group {
    std::string label;
    GiNaC::ex value;
};

/// A group of terms in the formula over a block: its label, which begins with '-' where it is subtracted, and LaTeX for
/// the same.
struct FormulaTerm {
    std::string label, latex;
};

/// Appends " = " and the groups to the block's formula, the left side so far: those that occur in its equations, or 0
/// where none does.
void append_right_side(EquationBlock& block, const std::vector<FormulaTerm>& terms);

[[nodiscard]] EquationBlock states_block(std::vector<Equation> equations);

class SymbolicModel {
  public:
    /// `functions`: what equations are derived from (L, H, a running cost; null ones are none). Casimirs that they use
    /// by name stay names where rho_a(f) = 0 is plain to see: the labels of leaves are constants. `choice`: the
    /// definitions that stay symbols; none that depends on what the derivation substitutes.
    SymbolicModel(const Model& model, const WrittenAlgebroid& algebroid, const std::vector<Tree>& functions,
                  const DefinitionChoice& choice = {}, const std::set<std::string>& substituted = {});
    SymbolicModel(const SymbolicModel&) = delete;
    SymbolicModel& operator=(const SymbolicModel&) = delete;

    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] const WrittenAlgebroid& algebroid() const { return algebroid_; }
    [[nodiscard]] std::size_t n() const { return x_.size(); }
    [[nodiscard]] std::size_t r() const { return y_.size(); }
    [[nodiscard]] const Sum& x() const { return x_; }
    [[nodiscard]] const Sum& y() const { return y_; }
    [[nodiscard]] const Sum& mu() const { return mu_; }             ///< mu_a, shape (r)
    [[nodiscard]] const Sum& controls() const { return controls_; } ///< u^A
    [[nodiscard]] const GiNaC::ex& rho(std::size_t i, std::size_t a) const { return anchor_[a * n() + i]; }
    [[nodiscard]] const GiNaC::ex& C(std::size_t c, std::size_t a, std::size_t b) const
    {
        return bracket_[(a * r() + b) * r() + c];
    }
    [[nodiscard]] const std::string& momentum_name(std::size_t a) const { return model_.fibre.momenta[a].name; }
    /// How LaTeX shows y^a as an index: what [about] says, else its name.
    [[nodiscard]] std::string fibre_latex(std::size_t a) const;

    /// A name that stands behind those of the model in the order of terms.
    void add_variable(const std::string& name) { (void)variable(name); }
    /// The first of `names` that the model does not declare, else the last.
    [[nodiscard]] std::string free_name(const std::vector<std::string>& names) const;

    /// A smooth tree, Casimirs as labels.
    [[nodiscard]] GiNaC::ex lower(const Tree& tree);
    [[nodiscard]] Tree shortest(const GiNaC::ex& e) const;
    /// The same value in its shortest form, to go on with.
    [[nodiscard]] GiNaC::ex simpler(const GiNaC::ex& e);

    /// df/dsymbol
    [[nodiscard]] GiNaC::ex derivative(const GiNaC::ex& f, const GiNaC::ex& symbol) const;
    /// y^a df/dy^a
    [[nodiscard]] GiNaC::ex along_fibre(const GiNaC::ex& f) const { return kept_->along_fibre(f, y_); }
    [[nodiscard]] bool depends_on(const GiNaC::ex& f, const Sum& symbols) const;
    /// The shorter of two forms with definitions as symbols; without these what it is given.
    [[nodiscard]] GiNaC::ex reduced(const GiNaC::ex& f) const;
    /// A symbol for a long value where definitions are kept, else the value.
    [[nodiscard]] GiNaC::ex named(const std::string& name, const GiNaC::ex& value);
    /// df/dt at fixed state; 0 where the model declares a symbol t of its own.
    [[nodiscard]] GiNaC::ex time_derivative(const GiNaC::ex& f);
    /// rho_a(f) = rho^i_a df/dx^i
    [[nodiscard]] Sum along_anchor(std::size_t a, const GiNaC::ex& f) const;
    /// -p_c C^c_ab y^b for given momenta and velocities, shape (r) each
    [[nodiscard]] Sum bracket_terms(std::size_t a, const Sum& p, const Sum& y) const;
    /// Q_a = F_a - dR/dy^a at the velocities y(..), shape (r); all zero where the model has neither.
    [[nodiscard]] Sum forces(const Sum& y);
    /// zdot of the first-order states at the velocities y(..); no equations where there are none.
    [[nodiscard]] EquationBlock states(const Sum& y);
    [[nodiscard]] bool has_forces() const { return !model_.forces.empty() || model_.dissipation != nullptr; }

    /// The groups each for itself; two that hold like terms become one, or terms that cancel would be shown.
    [[nodiscard]] std::vector<TermGroup> simplified(std::vector<Group> groups) const;
    /// left = terms
    [[nodiscard]] Equation equation(LeftSide left, const std::string& symbol, const Sum& terms) const;

    /// xdot^i = rho^i_a y^a for given velocities.
    [[nodiscard]] std::vector<Equation> kinematics(const Sum& y) const;
    /// The labels of the leaves; no equations where there are none.
    [[nodiscard]] EquationBlock casimirs();
    /// An empty set with the symbols and their LaTeX.
    [[nodiscard]] EquationSet empty_set(const std::string& form) const;
    /// The set with what its symbols stand for.
    [[nodiscard]] EquationSet closed(EquationSet set) const;

  private:
    [[nodiscard]] bool is_declared(const std::string& name) const;
    [[nodiscard]] GiNaC::ex variable(const std::string& name);
    void lower_structure();
    void lower_curvature();
    void take_labels(const std::vector<Tree>& functions);
    [[nodiscard]] GiNaC::ex lower_rough(const Tree& tree);
    [[nodiscard]] std::map<std::string, Tree> velocities(const Sum& y) const;
    [[nodiscard]] GiNaC::ex lower_at(const Tree& tree, const std::map<std::string, Tree>& velocities);

    const Model& model_;
    const WrittenAlgebroid& algebroid_;
    std::size_t longest_;             ///< characters of equations
    mutable std::size_t written_ = 0; ///< so far
    SymbolTable symbols_;
    Order order_;
    Sum x_, y_, mu_, controls_;
    std::optional<GiNaC::realsymbol> time_;
    std::vector<NamedTree> labels_;     ///< Casimirs that stand in the functions by name
    std::map<std::string, Tree> rough_; ///< what is not smooth, under its text
    std::unique_ptr<KeptSymbols> kept_; ///< over symbols_ and order_
    std::vector<GiNaC::ex> anchor_;     ///< anchor_[a n + i] = rho^i_a
    std::vector<GiNaC::ex> bracket_;    ///< bracket_[(a r + b) r + c] = C^c_ab
};

/// The set that `derivation` gives; an exception of GiNaC becomes a MathematicsError that says whose `equations`
/// failed.
[[nodiscard]] EquationSet derived(const Model& model, const char* equations,
                                  const std::function<EquationSet()>& derivation);
/// The same with definitions as symbols.
[[nodiscard]] EquationSet derived(const Model& model, const char* equations, Definitions definitions,
                                  const std::function<EquationSet(const DefinitionChoice&)>& derivation);

/// The names of these.
[[nodiscard]] std::set<std::string> name_set(const std::vector<Symbol>& symbols);

} // namespace lagen
