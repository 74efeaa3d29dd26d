// SPDX-License-Identifier: GPL-2.0-or-later
/// The Poisson structure of E* for a person, with what is decided of it (mechanics/symplectic.hpp).
#include "equations/derivations.hpp"

#include "equations/decided_statement.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/hamilton.hpp"
#include "mechanics/pontryagin.hpp"
#include "mechanics/symplectic.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {
namespace {

class PoissonDerivation {
  public:
    PoissonDerivation(const Model& model, const System& system, const Regularity& regularity,
                      const std::vector<Tree>& brackets, const DefinitionChoice& choice)
        : system_(system), kept_(choice.kept), graph_(system.graph),
          symbolic_(model, system.written.algebroid, {}, choice), canonical_(canonical_forms(graph_, system)),
          partial_(graph_, canonical_.prolongation.x), decider_(ZeroDecider::make(graph_, setting_of(graph_, system)))
    {
        Lowering lower(graph_);
        for (const Tree& each : brackets) functions_.push_back({each, lower(each)});
        if (system.hamiltonian || regularity.kind != Regularity::Kind::degenerate)
            hamiltonian_ = closed_hamiltonian(graph_, system, regularity.newton_start);
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("poisson");
        set.symbols.push_back({"Ω", R"(\Omega)"});
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (const auto& [kind, latex] : {std::pair("X_", "X_{"), std::pair("P^", "P^{")})
                set.symbols.push_back({kind + basis_name(a), latex + symbolic_.fibre_latex(a) + "}"});
        set.blocks = {poisson_brackets(symbolic_), symplectic_section()};
        if (!functions_.empty()) set.blocks.push_back(given_brackets());
        return symbolic_.closed(std::move(set));
    }

    [[nodiscard]] std::vector<DecidedStatement> statements()
    {
        std::vector<DecidedStatement> statements{jacobi(), closed()};
        for (std::size_t k = 0; k + 1 < functions_.size(); k += 2) statements.push_back(through_sections(k));
        if (hamiltonian_) {
            statements.push_back(dynamics());
            statements.push_back(rates());
        }
        if (system_.control) statements.push_back(extremals());
        return statements;
    }

  private:
    /// A function on E* from the command line.
    struct Function {
        Tree tree;
        NodeId node;
    };

    [[nodiscard]] static ProofSetting setting_of(Graph& graph, const System& system)
    {
        ProofSetting setting = proof_setting(graph, system);
        for (const NodeId mu : system.mu)
            if (std::ranges::find(setting.variables, mu) == setting.variables.end()) setting.variables.push_back(mu);
        return setting;
    }

    [[nodiscard]] std::string basis_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }
    [[nodiscard]] std::string section_name(std::size_t k) const
    {
        return (k < system_.r() ? "X_" : "P^") + basis_name(k % system_.r());
    }
    /// x^i, then mu_a.
    [[nodiscard]] const std::vector<NodeId>& coordinates() const { return canonical_.prolongation.x; }
    [[nodiscard]] std::string coordinate_name(std::size_t k) const { return graph_.input_name(coordinates()[k]); }

    [[nodiscard]] EquationBlock symplectic_section()
    {
        EquationBlock block{"canonical symplectic section",
                            "Ω = X^a∧P_a + ½ μ_c C^c_ab X^a∧X^b = -d(μ_a X^a)",
                            R"(\Omega = X^a \wedge P_a + \tfrac12 \mu_c\, C^c_{ab}\, X^a \wedge X^b = -d(\mu_a X^a))",
                            {}};
        for (const auto& [index, value] : canonical_.omega.components) {
            Equation equation = symbolic_.equation(LeftSide::component, "Ω", {component_of(index, value)});
            if (equation.groups.empty()) continue;
            for (const std::size_t k : index) equation.arguments.push_back(section_name(k));
            block.equations.push_back(std::move(equation));
        }
        return block;
    }

    /// Omega(X_a, X_b) = mu_c C^c_ab where definitions are symbols: the graph has none.
    [[nodiscard]] GiNaC::ex component_of(const std::vector<std::size_t>& index, NodeId value)
    {
        if (!kept_ || index.at(1) >= system_.r()) return symbolic_.lower(to_tree(graph_, value));
        Sum terms;
        for (std::size_t c = 0; c < system_.r(); ++c)
            terms.push_back(symbolic_.mu()[c] * symbolic_.C(c, index[0], index[1]));
        return total(terms);
    }

    /// F, G of the first pair, F2, G2 of the second.
    [[nodiscard]] static std::string function_name(std::size_t k)
    {
        return (k % 2 == 0 ? "F" : "G") + (k < 2 ? std::string() : std::to_string(k / 2 + 1));
    }

    /// {F, G} of the pairs that were asked for.
    [[nodiscard]] EquationBlock given_brackets()
    {
        EquationBlock block{"brackets of functions",
                            "{F, G} = F_a ρ_a(G) - G_a ρ_a(F) + μ_c C^c_ab F_a G_b,  F_a = ∂F/∂μ_a",
                            R"(\{F, G\} = F_a\, \rho_a(G) - G_a\, \rho_a(F) + \mu_c\, C^c_{ab}\, F_a G_b,\quad )"
                            R"(F_a = \frac{\partial F}{\partial \mu_a})",
                            {}};
        for (std::size_t k = 0; k + 1 < functions_.size(); k += 2) {
            for (const std::size_t each : {k, k + 1})
                block.equations.push_back(symbolic_.equation(LeftSide::symbol, function_name(each),
                                                             {symbolic_.lower(functions_[each].tree)}));
            const NodeId value = poisson_bracket(graph_, system_, functions_[k].node, functions_[k + 1].node);
            Equation equation =
                symbolic_.equation(LeftSide::bracket, function_name(k), {symbolic_.lower(to_tree(graph_, value))});
            equation.other = function_name(k + 1);
            block.equations.push_back(std::move(equation));
        }
        return block;
    }

    [[nodiscard]] DecidedStatement decided(const char* formula, const char* latex,
                                           const std::vector<NamedResidual>& residuals)
    {
        return decided_statement(graph_, formula, latex, residuals,
                                 [&](NodeId residual) { return decision_by(decider_.get(), residual); });
    }

    [[nodiscard]] NodeId bracket_of(NodeId F, NodeId G) { return poisson_bracket(graph_, system_, F, G); }

    /// The triples of coordinates are those of which two at least are momenta; the others vanish term by term.
    [[nodiscard]] DecidedStatement jacobi()
    {
        const std::vector<NodeId> z = coordinates();
        std::vector<NamedResidual> residuals;
        for (std::size_t a = system_.n(); a < z.size(); ++a)
            for (std::size_t b = a + 1; b < z.size(); ++b)
                for (std::size_t k = 0; k < z.size(); ++k) {
                    if (k >= system_.n() && k <= b) continue;
                    const NodeId terms[] = {bracket_of(z[a], bracket_of(z[b], z[k])),
                                            bracket_of(z[b], bracket_of(z[k], z[a])),
                                            bracket_of(z[k], bracket_of(z[a], z[b]))};
                    residuals.push_back(
                        {{coordinate_name(a), coordinate_name(b), coordinate_name(k)}, graph_.sum(terms)});
                }
        return decided("{F, {G, K}} + {G, {K, F}} + {K, {F, G}} = 0  (Jacobi's identity, on coordinates)",
                       R"(\{F, \{G, K\}\} + \{G, \{K, F\}\} + \{K, \{F, G\}\} = 0)", residuals);
    }

    [[nodiscard]] std::vector<NamedResidual> named(const ExteriorForm& form)
    {
        return residuals_of(form, [&](std::size_t k) { return section_name(k); });
    }

    [[nodiscard]] DecidedStatement closed()
    {
        return decided(
            "-dΘ = Ω,  Θ = μ_a X^a", R"(-d\Theta = \Omega,\quad \Theta = \mu_a X^a)",
            named(sum(graph_, differential(partial_, canonical_.prolongation, canonical_.theta), canonical_.omega)));
    }

    /// {F, G} + Omega(X_F, X_G)
    [[nodiscard]] DecidedStatement through_sections(std::size_t k)
    {
        const NodeId F = functions_[k].node, G = functions_[k + 1].node;
        const Section X_F = hamiltonian_section(graph_, system_, F), X_G = hamiltonian_section(graph_, system_, G);
        const ExteriorForm value = contraction(graph_, X_G, contraction(graph_, X_F, canonical_.omega));
        const auto found = value.components.find({});
        const NodeId omega = found == value.components.end() ? graph_.constant(0) : found->second;
        return decided("{F, G} = -Ω(X_F, X_G),  i_{X_F} Ω = dF",
                       R"(\{F, G\} = -\Omega(X_F, X_G),\quad i_{X_F} \Omega = dF)",
                       {{{function_name(k), function_name(k + 1)}, graph_.add(bracket_of(F, G), omega)}});
    }

    /// i_{X_H} Omega - dH with X_H = y^a X_a + mudot_a P^a of Hamilton's equations without forces.
    [[nodiscard]] DecidedStatement dynamics()
    {
        return decided("i_{X_H} Ω = dH  for X_H = y^a X_a + μ̇_a P^a of Hamilton's equations (without forces)",
                       R"(i_{X_H} \Omega = dH)", of_sections(free_motion(), hamiltonian_->value));
    }

    /// i_X Omega - dH on sections of T^E E*, X = y^a X_a + mudot_a P^a of this motion.
    [[nodiscard]] std::vector<NamedResidual> of_sections(const PhaseSystem& phase, NodeId H)
    {
        Section X;
        for (std::size_t a = 0; a < system_.r(); ++a) X.push_back({a, phase.y[a]});
        for (std::size_t a = 0; a < system_.r(); ++a) X.push_back({system_.r() + a, phase.mudot[a]});
        const ExteriorForm left = contraction(graph_, X, canonical_.omega);
        return named(difference(graph_, left, differential(partial_, canonical_.prolongation, function_form(H))));
    }

    /// Pontryagin's equations by a section along pr_1: controls are fixed under d here, dH/du stands apart.
    [[nodiscard]] DecidedStatement extremals()
    {
        const NodeId H = control_hamiltonian(graph_, *system_.control, system_.mu).value;
        return decided("i_{σ_H} Ω = dH - (∂H/∂u^A) du^A  for σ_H = σ^a X_a + μ̇_a P^a along pr₁: E* ×_M B → E*",
                       R"(i_{\sigma_H} \Omega = dH - \frac{\partial H}{\partial u^A}\, du^A)",
                       of_sections(pontryagin_system(graph_, system_, H, {}), H));
    }

    [[nodiscard]] DecidedStatement rates()
    {
        const PhaseSystem phase = free_motion();
        std::vector<NamedResidual> residuals;
        for (std::size_t k = 0; k < coordinates().size(); ++k) {
            const NodeId rate = k < system_.n() ? phase.xdot[k] : phase.mudot[k - system_.n()];
            residuals.push_back(
                {{coordinate_name(k)}, graph_.subtract(bracket_of(hamiltonian_->value, coordinates()[k]), rate)});
        }
        return decided("Ḟ = {H, F}  on coordinates", R"(\dot F = \{H, F\})", residuals);
    }

    [[nodiscard]] PhaseSystem free_motion()
    {
        MomentumBalance balance = hamilton_balance(graph_, system_, *hamiltonian_);
        balance.forces.assign(system_.r(), graph_.constant(0));
        return phase_system(graph_, system_, balance, hamiltonian_->value, hamiltonian_->lagrangian);
    }

    const System& system_;
    bool kept_; ///< definitions as symbols
    Graph graph_;
    SymbolicModel symbolic_;
    SymplecticForms canonical_;
    BaseGradient partial_;
    std::unique_ptr<ZeroDecider> decider_;
    std::vector<Function> functions_;
    std::optional<HamiltonianNodes> hamiltonian_;
};

} // namespace

EquationBlock poisson_brackets(const SymbolicModel& symbolic)
{
    EquationBlock block{
        "Poisson brackets",
        "{μ_a, x^j} = ρ^j_a,  {μ_a, μ_b} = C^c_ab μ_c;  Ḟ = {H, F}",
        R"(\{\mu_a, x^j\} = \rho^j_a, \quad \{\mu_a, \mu_b\} = C^c_{ab}\, \mu_c; \quad \dot F = \{H, F\})",
        {}};
    const auto append = [&](const std::string& first, const std::string& second, const Sum& terms) {
        Equation bracket = symbolic.equation(LeftSide::bracket, first, terms);
        bracket.other = second;
        if (!bracket.groups.empty()) block.equations.push_back(std::move(bracket));
    };
    for (std::size_t a = 0; a < symbolic.r(); ++a)
        for (std::size_t j = 0; j < symbolic.n(); ++j)
            append(symbolic.momentum_name(a), symbolic.algebroid().base[j].name, {symbolic.rho(j, a)});
    for (std::size_t a = 0; a < symbolic.r(); ++a)
        for (std::size_t b = a + 1; b < symbolic.r(); ++b) {
            Sum terms;
            for (std::size_t c = 0; c < symbolic.r(); ++c) terms.push_back(symbolic.C(c, a, b) * symbolic.mu()[c]);
            append(symbolic.momentum_name(a), symbolic.momentum_name(b), terms);
        }
    return block;
}

EquationSet derive_poisson(const Model& model, const System& system, const Regularity& regularity,
                           const std::vector<Tree>& brackets, Definitions definitions)
{
    return derived(model, "the Poisson brackets", [&] {
        EquationSet set = with_definitions(model, definitions, [&](const DefinitionChoice& choice) {
            return PoissonDerivation(model, system, regularity, brackets, choice).run();
        });
        set.statements = PoissonDerivation(model, system, regularity, brackets, {}).statements();
        return set;
    });
}

} // namespace lagen
