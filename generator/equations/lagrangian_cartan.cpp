// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of L in continuous time for a person, with what is decided of them (mechanics/symplectic.hpp).
#include "equations/derivations.hpp"

#include "equations/decided_statement.hpp"
#include "equations/symbolic_model.hpp"
#include "geometry/prolongation.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/symplectic.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

namespace lagen {
namespace {

class LagrangianCartan {
  public:
    LagrangianCartan(const Model& model, const System& system, const Regularity& regularity)
        : system_(system), regularity_(regularity), graph_(system.graph),
          symbolic_(model, system.written.algebroid, {model.lagrangian}), lagrangian_(lagrangian_nodes(graph_, system)),
          forms_(lagrangian_forms(graph_, system, lagrangian_)), partial_(graph_, forms_.prolongation.x),
          decider_(ZeroDecider::make(graph_, proof_setting(graph_, system)))
    {
        for (std::size_t a = 0; a < system.r(); ++a)
            accelerations_.push_back(graph_.input("f " + graph_.input_name(system.algebroid.y[a])));
        for (std::size_t a = 0; a < system.r(); ++a) {
            motion_.push_back({a, system.algebroid.y[a]});
            lifts_.push_back(complete_lift(partial_, system.algebroid, basis_section(graph_, a)));
        }
        for (std::size_t a = 0; a < system.r(); ++a) motion_.push_back({system.r() + a, accelerations_[a]});
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("cartan");
        set.symbols.push_back({"θ_L", R"(\theta_L)"});
        set.symbols.push_back({"ω_L", R"(\omega_L)"});
        set.symbols.push_back({"E_L", "E_L"});
        for (std::size_t k = 0; k < 2 * system_.r(); ++k) set.symbols.push_back({section_name(k), section_latex(k)});
        for (std::size_t a = 0; a < system_.r(); ++a) set.symbols.push_back({lift_name(a), lift_latex(a)});
        set.blocks = {
            components("Cartan 1-section", "θ_L = p_a X^a,  p_a = ∂L/∂y^a",
                       R"(\theta_L = p_a\, X^a,\quad p_a = \frac{\partial L}{\partial y^a})", "θ_L", forms_.theta),
            components("Cartan 2-section", "ω_L = W_ab X^a∧V^b + ½ (ρ_b(p_a) - ρ_a(p_b) + p_c C^c_ab) X^a∧X^b",
                       R"(\omega_L = W_{ab}\, X^a \wedge V^b + \tfrac12 (\rho_b(p_a) - \rho_a(p_b) + )"
                       R"(p_c\, C^c_{ab})\, X^a \wedge X^b)",
                       "ω_L", forms_.omega),
            energy(), lifts()};
        set.statements = {closed(), dynamics(), action(), complete_lifts(), vertical_lifts(), symplectic()};
        return set;
    }

  private:
    [[nodiscard]] std::string basis_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }
    [[nodiscard]] std::string section_name(std::size_t k) const
    {
        return (k < system_.r() ? "X_" : "V_") + basis_name(k % system_.r());
    }
    [[nodiscard]] std::string lift_name(std::size_t a) const { return "e_" + basis_name(a) + "ᶜ"; }

    [[nodiscard]] std::string section_latex(std::size_t k) const
    {
        return (k < system_.r() ? "X_{" : "V_{") + symbolic_.fibre_latex(k % system_.r()) + "}";
    }
    [[nodiscard]] std::string lift_latex(std::size_t a) const { return "e_{" + symbolic_.fibre_latex(a) + "}^{c}"; }

    [[nodiscard]] EquationBlock components(const char* title, const char* formula, const char* latex,
                                           const std::string& symbol, const ExteriorForm& form)
    {
        EquationBlock block{title, formula, latex, {}};
        for (const auto& [index, value] : form.components) append(block, symbol, index, value);
        return block;
    }

    void append(EquationBlock& block, const std::string& symbol, const FormIndex& index, NodeId value)
    {
        Equation equation = symbolic_.equation(LeftSide::component, symbol, {symbolic_.lower(to_tree(graph_, value))});
        if (equation.groups.empty()) return;
        for (const std::size_t k : index) equation.arguments.push_back(section_name(k));
        block.equations.push_back(std::move(equation));
    }

    [[nodiscard]] EquationBlock energy()
    {
        return {"energy",
                "E_L = y^a p_a - L",
                R"(E_L = y^a p_a - L)",
                {symbolic_.equation(LeftSide::symbol, "E_L", {symbolic_.lower(to_tree(graph_, lagrangian_.energy))})}};
    }

    [[nodiscard]] EquationBlock lifts()
    {
        EquationBlock block{"complete lifts of the basis",
                            "e_aᶜ = X_a + C^c_ba y^b V_c;  e_aᶜ(V_c) is the coefficient of V_c",
                            R"(e_a^c = X_a + C^c_{ba}\, y^b\, V_c)",
                            {}};
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (const ColumnEntry& entry : lifts_[a])
                if (entry.index >= system_.r()) append(block, lift_name(a), {entry.index}, entry.value);
        return block;
    }

    [[nodiscard]] DecidedStatement decided(std::string formula, std::string latex, const ExteriorForm& form)
    {
        return decided(std::move(formula), std::move(latex),
                       residuals_of(form, [&](std::size_t k) { return section_name(k); }));
    }
    [[nodiscard]] DecidedStatement decided(std::string formula, std::string latex,
                                           const std::vector<NamedResidual>& residuals)
    {
        return decided_statement(graph_, std::move(formula), std::move(latex), residuals,
                                 [&](NodeId residual) { return decision_by(decider_.get(), residual); });
    }

    [[nodiscard]] ExteriorForm d(const ExteriorForm& form) { return differential(partial_, forms_.prolongation, form); }

    [[nodiscard]] DecidedStatement closed()
    {
        return decided("-dθ_L = ω_L", R"(-d\theta_L = \omega_L)", sum(graph_, d(forms_.theta), forms_.omega));
    }

    /// (Q_a - dp_a/dt) X^a: what forces and explicit time add to W_ab f^b.
    [[nodiscard]] ExteriorForm push()
    {
        ExteriorForm form{1, {}};
        const std::vector<NodeId> Q = system_.forces_or_zero(graph_);
        const std::vector<std::pair<NodeId, NodeId>> seeds{{system_.time, graph_.constant(1)}};
        const std::vector<NodeId> drift = directional(graph_, lagrangian_.fibre.momenta, seeds);
        for (std::size_t a = 0; a < system_.r(); ++a)
            if (const NodeId value = graph_.subtract(Q[a], drift[a]); !graph_.is_zero(value))
                form.components.emplace(FormIndex{a}, value);
        return form;
    }
    [[nodiscard]] std::string push_text(bool latex, bool negative) const
    {
        const bool moves = depends_on_any(graph_, lagrangian_.fibre.momenta, {&system_.time, 1});
        std::string text;
        if (!system_.forces.empty()) text += negative ? " - Q_a X^a" : " + Q_a X^a";
        if (moves) text += std::string(negative ? " + " : " - ") + (latex ? R"(\partial_t p_a X^a)" : "∂p_a/∂t X^a");
        return text;
    }

    /// `form` is linear in the accelerations f^a, which stand there with the coefficients factor W_ab alone: the values
    /// with factor W_ab f^b as Lagrange's equations have it.
    [[nodiscard]] std::vector<NamedResidual> along_solutions(const ExteriorForm& form, int factor)
    {
        const std::vector<NodeId> force =
            lagrange_rates(graph_, system_, lagrangian_, lagrange_balance(graph_, system_, lagrangian_)).force;
        const std::vector<NodeId> zeros(system_.r(), graph_.constant(0));
        std::vector<NamedResidual> residuals;
        const auto scaled = [&](NodeId node) { return graph_.multiply(graph_.constant(factor), node); };
        for (std::size_t k = 0; k < 2 * system_.r(); ++k) {
            const auto found = form.components.find({k});
            const NodeId value = found == form.components.end() ? graph_.constant(0) : found->second;
            const NodeId at_rest = substitute(graph_, {&value, 1}, replacements(accelerations_, zeros))[0];
            const bool horizontal = k < system_.r();
            residuals.push_back({{section_name(k)}, horizontal ? graph_.add(at_rest, scaled(force[k])) : at_rest});
            const std::vector<NodeId> coefficients = gradient(graph_, value, accelerations_);
            for (std::size_t b = 0; b < system_.r(); ++b) {
                const NodeId wanted = horizontal ? scaled(lagrangian_.fibre.W(k, b)) : graph_.constant(0);
                residuals.push_back(
                    {{section_name(k), section_name(system_.r() + b)}, graph_.subtract(coefficients[b], wanted)});
            }
        }
        return residuals;
    }

    /// i_Gamma omega_L - dE_L + push = 0
    [[nodiscard]] DecidedStatement dynamics()
    {
        const ExteriorForm left = contraction(graph_, motion_, forms_.omega);
        const ExteriorForm residual =
            sum(graph_, difference(graph_, left, d(function_form(lagrangian_.energy))), push());
        return decided("i_Γ ω_L = dE_L" + push_text(false, true) +
                           "  for Γ = y^a X_a + f^a V_a, W_ab f^b of Lagrange's equations",
                       R"(i_\Gamma \omega_L = dE_L)" + push_text(true, true), along_solutions(residual, -1));
    }

    /// d_Gamma theta_L - dL - push = 0, d_Gamma = i_Gamma d + d i_Gamma
    [[nodiscard]] DecidedStatement action()
    {
        const ExteriorForm left = lie_derivative(partial_, forms_.prolongation, motion_, forms_.theta);
        const ExteriorForm residual =
            difference(graph_, difference(graph_, left, d(function_form(*system_.lagrangian))), push());
        return decided("d_Γ θ_L = dL" + push_text(false, false), R"(d_\Gamma \theta_L = dL)" + push_text(true, false),
                       along_solutions(residual, 1));
    }

    /// [s, t] - wanted by components.
    void append_bracket(std::vector<NamedResidual>& residuals, std::size_t a, std::size_t b, const Section& s,
                        const Section& t, const Section& wanted)
    {
        for (const ColumnEntry& entry : difference(graph_, bracket(partial_, forms_.prolongation, s, t), wanted))
            residuals.push_back({{"e_" + basis_name(a), "e_" + basis_name(b), section_name(entry.index)}, entry.value});
    }

    [[nodiscard]] DecidedStatement complete_lifts()
    {
        std::vector<NamedResidual> residuals;
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (std::size_t b = a + 1; b < system_.r(); ++b)
                append_bracket(residuals, a, b, lifts_[a], lifts_[b],
                               complete_lift(partial_, system_.algebroid, Section(system_.algebroid.C(a, b))));
        return decided("[e_aᶜ, e_bᶜ] = [e_a, e_b]ᶜ", R"([e_a^c, e_b^c] = [e_a, e_b]^c)", residuals);
    }

    [[nodiscard]] DecidedStatement vertical_lifts()
    {
        std::vector<NamedResidual> residuals;
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (std::size_t b = 0; b < system_.r(); ++b)
                append_bracket(residuals, a, b, lifts_[a], vertical_lift(system_.algebroid, basis_section(graph_, b)),
                               vertical_lift(system_.algebroid, Section(system_.algebroid.C(a, b))));
        return decided("[e_aᶜ, e_bᵛ] = [e_a, e_b]ᵛ", R"([e_a^c, e_b^v] = [e_a, e_b]^v)", residuals);
    }

    /// det of omega_L is det(W)^2.
    [[nodiscard]] DecidedStatement symplectic() const
    {
        DecidedStatement statement{"ω_L is symplectic: W_ab has an inverse", R"(\omega_L \text{ is symplectic})",
                                   to_text(ProofStatus::undecided)};
        switch (regularity_.kind) {
        case Regularity::Kind::regular: statement.status = to_text(ProofStatus::proved); break;
        case Regularity::Kind::degenerate:
            statement.status = to_text(ProofStatus::refuted);
            statement.evidence = fmt::format("W has rank {} of {}", regularity_.rank, system_.r());
            break;
        case Regularity::Kind::generically_regular:
            statement.evidence = "at almost all points";
            for (const std::string& where : regularity_.singular_where)
                statement.evidence += fmt::format(
                    "{}{} = 0", where == regularity_.singular_where.front() ? "; not where " : " or ", where);
            break;
        default: statement.evidence = regularity_.evidence;
        }
        return statement;
    }

    const System& system_;
    const Regularity& regularity_;
    Graph graph_;
    SymbolicModel symbolic_;
    LagrangianNodes lagrangian_;
    SymplecticForms forms_;
    BaseGradient partial_;
    std::unique_ptr<ZeroDecider> decider_;
    std::vector<NodeId> accelerations_; ///< inputs f^a
    Section motion_;                    ///< Gamma
    std::vector<Section> lifts_;        ///< e_a^c
};

} // namespace

EquationSet derive_lagrangian_cartan(const Model& model, const System& system, const Regularity& regularity)
{
    if (!system.lagrangian)
        throw MathematicsError("model '" + model.name + "' has no Lagrangian; its Cartan sections need [lagrangian] L");
    return derived(model, "the Cartan sections", [&] { return LagrangianCartan(model, system, regularity).run(); });
}

} // namespace lagen
