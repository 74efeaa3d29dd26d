// SPDX-License-Identifier: GPL-2.0-or-later
/// The variations of E-paths and of the action of L for a person, with what is decided of them
/// (mechanics/variations.hpp).
#include "equations/derivations.hpp"

#include "equations/decided_statement.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/variations.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

namespace lagen {
namespace {

/// A curve of sections with its rates, as inputs.
struct SectionCurve {
    std::vector<NodeId> value, rate, second; ///< s^a, sdot^a, sddot^a, shape (r)
};

class VariationsDerivation {
  public:
    VariationsDerivation(const Model& model, const System& system)
        : system_(system), graph_(system.graph), symbolic_(model, system.written.algebroid, {model.lagrangian}),
          s_(section_curve("σ")), r_(section_curve("τ")), delta_(made_variation(s_)),
          action_(action_variations(graph_, system, delta_, s_.value))
    {
        for (std::size_t a = 0; a < system.r(); ++a) accelerations_.push_back(input("f_" + basis_name(a)));
        for (std::size_t a = 0; a < system.r(); ++a) named_.y.push_back(input("δ" + basis_name(a)));
        named_.x = delta_.x;
        // EL_a = rho_a(L) - p_c C^c_ab y^b - d/dt p_a
        const std::vector<NodeId> slopes = rates(action_.p);
        for (std::size_t a = 0; a < system.r(); ++a)
            equations_.push_back(graph_.subtract(action_.pushes[a], slopes[a]));
        ProofSetting setting = proof_setting(graph_, system);
        setting.variables.insert(setting.variables.end(), inputs_.begin(), inputs_.end());
        decider_ = ZeroDecider::make(graph_, setting);
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("variations");
        for (std::size_t a = 0; a < system_.r(); ++a) {
            set.symbols.push_back({graph_.input_name(s_.value[a]), R"(\sigma^{)" + symbolic_.fibre_latex(a) + "}"});
            set.symbols.push_back({graph_.input_name(s_.rate[a]), R"(\dot\sigma^{)" + symbolic_.fibre_latex(a) + "}"});
        }
        set.blocks = {curves(), momenta(), jacobi(), second()};
        set.statements = {tangent(), involutive(), critical(), linearised()};
        return set;
    }

  private:
    [[nodiscard]] std::string basis_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }
    [[nodiscard]] std::string symbol_of(const std::string& letter, std::size_t a) const
    {
        return letter + "_" + basis_name(a);
    }
    /// Under a name that the model does not have.
    [[nodiscard]] NodeId input(std::string name)
    {
        while (system_.declares(name)) name += "'";
        symbolic_.add_variable(name);
        inputs_.push_back(graph_.input(name));
        return inputs_.back();
    }
    [[nodiscard]] SectionCurve section_curve(const std::string& letter)
    {
        SectionCurve curve;
        for (std::size_t a = 0; a < system_.r(); ++a) curve.value.push_back(input(symbol_of(letter, a)));
        for (std::size_t a = 0; a < system_.r(); ++a) curve.rate.push_back(input(symbol_of(letter + "̇", a)));
        for (std::size_t a = 0; a < system_.r(); ++a) curve.second.push_back(input(symbol_of(letter + "̈", a)));
        return curve;
    }
    [[nodiscard]] Variation made_variation(const SectionCurve& curve)
    {
        return variation(graph_, system_.algebroid, curve.value, curve.rate);
    }

    /// d/dt along a curve with xdot = rho(y), ydot = f, and of s and r.
    [[nodiscard]] std::vector<NodeId> rates(const std::vector<NodeId>& functions)
    {
        using Inputs = std::vector<NodeId>;
        const std::vector<std::pair<Inputs, Inputs>> moving = {
            {system_.algebroid.x, base_velocity(graph_, system_.algebroid, system_.algebroid.y)},
            {system_.algebroid.y, accelerations_},
            {s_.value, s_.rate},
            {s_.rate, s_.second},
            {r_.value, r_.rate},
            {r_.rate, r_.second}};
        Replacements seeds;
        for (const auto& [inputs, values] : moving) {
            const Replacements more = replacements(inputs, values);
            seeds.insert(seeds.end(), more.begin(), more.end());
        }
        seeds.emplace_back(system_.time, graph_.constant(1));
        return directional(graph_, functions, seeds);
    }

    [[nodiscard]] Equation shown(LeftSide left, const std::string& symbol, NodeId value)
    {
        return symbolic_.equation(left, symbol, {symbolic_.lower(to_tree(graph_, value))});
    }

    [[nodiscard]] EquationBlock curves()
    {
        EquationBlock block{
            "variations of E-paths, by a curve of sections σ(t)",
            "δx^i = ρ^i_a σ^a,  δy^a = σ̇^a + C^a_bc y^b σ^c",
            R"(\delta x^i = \rho^i_a\, \sigma^a,\quad \delta y^a = \dot\sigma^a + C^a_{bc}\, y^b \sigma^c)",
            {}};
        for (std::size_t i = 0; i < system_.n(); ++i)
            block.equations.push_back(shown(LeftSide::symbol, "δ" + symbolic_.algebroid().base[i].name, delta_.x[i]));
        for (std::size_t a = 0; a < system_.r(); ++a)
            block.equations.push_back(shown(LeftSide::symbol, "δ" + basis_name(a), delta_.y[a]));
        return block;
    }

    /// The variations of `functions`, one a momentum, in terms of delta y.
    void append_varied(EquationBlock& block, LeftSide left, const std::vector<NodeId>& functions)
    {
        const std::vector<NodeId> right = varied(graph_, system_.algebroid, named_, functions);
        for (std::size_t a = 0; a < system_.r(); ++a)
            block.equations.push_back(shown(left, "δ" + symbolic_.momentum_name(a), right[a]));
    }

    [[nodiscard]] EquationBlock momenta()
    {
        EquationBlock block{
            "variations of the momenta",
            "δp_a = (∂p_a/∂x^i) ρ^i_b σ^b + W_ab δy^b",
            R"(\delta p_a = \frac{\partial p_a}{\partial x^i}\, \rho^i_b\, \sigma^b + W_{ab}\, \delta y^b)",
            {}};
        append_varied(block, LeftSide::symbol, action_.p);
        return block;
    }

    [[nodiscard]] EquationBlock jacobi()
    {
        EquationBlock block{"Jacobi's equations",
                            "d/dt δp_a = δ(ρ_a(L) - p_c C^c_ab y^b)",
                            R"(\frac{d}{dt} \delta p_a = \delta(\rho_a(L) - p_c\, C^c_{ab}\, y^b))",
                            {}};
        append_varied(block, LeftSide::time_derivative, action_.pushes);
        return block;
    }

    /// delta^2 L in terms of delta y, whose own variation is that of C^a_bc y^b s^c.
    [[nodiscard]] EquationBlock second()
    {
        const std::vector<NodeId> again = varied(graph_, system_.algebroid, named_, delta_.y);
        const NodeId first = graph_.add(action_.base, contraction(graph_, action_.p, named_.y));
        const NodeId value = varied(graph_, system_.algebroid, named_, first, replacements(named_.y, again));
        return {"second variation of the action along a solution, the integral of",
                "δ²L = δ(δL)",
                R"(\delta^2 L = \delta(\delta L))",
                {shown(LeftSide::symbol, "δ²L", value)}};
    }

    [[nodiscard]] DecidedStatement decided(std::string formula, std::string latex,
                                           const std::vector<NamedResidual>& residuals)
    {
        return decided_statement(graph_, std::move(formula), std::move(latex), residuals,
                                 [&](NodeId residual) { return decision_by(decider_.get(), residual); });
    }

    /// f - g under the names of the coordinates of `symbols`.
    void append(std::vector<NamedResidual>& residuals, const std::vector<Symbol>& symbols, const std::vector<NodeId>& f,
                const std::vector<NodeId>& g)
    {
        for (std::size_t k = 0; k < symbols.size(); ++k)
            residuals.push_back({{symbols[k].name}, graph_.subtract(f[k], g[k])});
    }

    [[nodiscard]] DecidedStatement tangent()
    {
        const std::vector<NodeId> velocity = base_velocity(graph_, system_.algebroid, system_.algebroid.y);
        std::vector<NamedResidual> residuals;
        append(residuals, symbolic_.algebroid().base, varied(graph_, system_.algebroid, delta_, velocity),
               rates(delta_.x));
        return decided("δ(ρ^i_a y^a) = d/dt δx^i: variations of E-paths are tangent to them",
                       R"(\delta(\rho^i_a\, y^a) = \frac{d}{dt} \delta x^i)", residuals);
    }

    /// [delta_s, delta_r] = delta_u on x and y, u = [s, r] at fixed t.
    [[nodiscard]] DecidedStatement involutive()
    {
        const Algebroid& algebroid = system_.algebroid;
        const Variation other = made_variation(r_);
        const std::vector<NodeId> u = constant_bracket(graph_, algebroid, s_.value, r_.value);
        const Variation wanted = variation(graph_, algebroid, u, rates(u));
        std::vector<NamedResidual> residuals;
        for (const auto& [symbols, s, r, both] :
             {std::tuple{&symbolic_.algebroid().base, &delta_.x, &other.x, &wanted.x},
              std::tuple{&symbolic_.algebroid().fibre, &delta_.y, &other.y, &wanted.y}}) {
            std::vector<NodeId> commutator = varied(graph_, algebroid, delta_, *r);
            const std::vector<NodeId> back = varied(graph_, algebroid, other, *s);
            for (std::size_t k = 0; k < commutator.size(); ++k) commutator[k] = graph_.subtract(commutator[k], back[k]);
            append(residuals, *symbols, commutator, *both);
        }
        return decided("[δ_σ, δ_τ] = δ_[σ, τ]: variations span an involutive distribution, that of E-homotopies",
                       R"([\delta_\sigma, \delta_\tau] = \delta_{[\sigma, \tau]})", residuals);
    }

    [[nodiscard]] DecidedStatement critical()
    {
        const NodeId boundary = rates({contraction(graph_, action_.p, s_.value)})[0];
        const NodeId right = graph_.add(contraction(graph_, equations_, s_.value), boundary);
        return decided(
            "δL = EL_a σ^a + d/dt (p_a σ^a): critical points of the action, σ = 0 at the ends, solve EL_a = 0",
            R"(\delta L = EL_a\, \sigma^a + \frac{d}{dt}(p_a\, \sigma^a))",
            {{{"L"}, graph_.subtract(varied(graph_, system_.algebroid, delta_, *system_.lagrangian), right)}});
    }

    /// d q/d s^a - d/dt (d q/d sdot^a) = delta EL_a + 1/2 C^c_ab s^b EL_c, along all curves.
    [[nodiscard]] DecidedStatement linearised()
    {
        const Algebroid& algebroid = system_.algebroid;
        const NodeId q = graph_.multiply(graph_.constant(Rational(1) / 2), action_.second);
        const std::vector<NodeId> by_value = gradient(graph_, q, s_.value);
        const std::vector<NodeId> by_rate = rates(gradient(graph_, q, s_.rate));
        std::vector<NodeId> wanted =
            varied(graph_, algebroid, delta_, equations_, replacements(accelerations_, rates(delta_.y)));
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (std::size_t b = 0; b < system_.r(); ++b)
                for (const ColumnEntry& C : algebroid.C(a, b)) {
                    const NodeId factors[] = {graph_.constant(Rational(1) / 2), C.value, s_.value[b],
                                              equations_[C.index]};
                    wanted[a] = graph_.add(wanted[a], graph_.product(factors));
                }
        std::vector<NodeId> left;
        for (std::size_t a = 0; a < system_.r(); ++a) left.push_back(graph_.subtract(by_value[a], by_rate[a]));
        std::vector<NamedResidual> residuals;
        append(residuals, symbolic_.algebroid().fibre, left, wanted);
        return decided(
            "∂q/∂σ^a - d/dt ∂q/∂σ̇^a = δEL_a + ½ C^c_ab σ^b EL_c, q = ½ δ²L: along solutions the critical σ of "
            "the second variation are those of Jacobi's equations",
            R"(\frac{\partial q}{\partial \sigma^a} - \frac{d}{dt} \frac{\partial q}{\partial \dot\sigma^a} = )"
            R"(\delta EL_a + \tfrac12 C^c_{ab}\, \sigma^b EL_c,\quad q = \tfrac12 \delta^2 L)",
            residuals);
    }

    const System& system_;
    Graph graph_;
    SymbolicModel symbolic_;
    std::vector<NodeId> inputs_; ///< of the curves and accelerations
    SectionCurve s_, r_;
    Variation delta_; ///< by s
    Variation named_; ///< the same with inputs for delta y
    ActionVariations action_;
    std::vector<NodeId> accelerations_; ///< inputs f^a
    std::vector<NodeId> equations_;     ///< EL_a
    std::unique_ptr<ZeroDecider> decider_;
};

} // namespace

EquationSet derive_variations(const Model& model, const System& system)
{
    if (!system.lagrangian)
        throw MathematicsError("model '" + model.name +
                               "' has no Lagrangian; variations of the action need [lagrangian] L");
    if (!system.forces.empty())
        throw MathematicsError("model '" + model.name +
                                   "' has forces; its motions are no critical points of the action",
                               "leave out [forces] and [dissipation]");
    return derived(model, "the variations", [&] { return VariationsDerivation(model, system).run(); });
}

} // namespace lagen
