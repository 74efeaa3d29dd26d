// SPDX-License-Identifier: GPL-2.0-or-later
/// Variations of the controlled curves of an optimal control problem, by a curve of sections eta(t) and by du(t):
///   delta x^i = rho^i_a eta^a,      etadot^a = rho_b(sigma^a) eta^b + (dsigma^a/du^A) delta u^A - C^a_bc sigma^b eta^c
/// The second is that they are variations of the E-path y = sigma(x, u): those within one E-homotopy class. Along
/// Pontryagin's mudot, at every u,
///   delta L = d/dt (mu_a eta^a) - (dH/du^A) delta u^A
/// so that the cost is critical among controlled curves in the class, eta = 0 at the ends, where dH/du = 0.
///                                                                                                  [Martinez 2004]
#include "equations/derivations.hpp"

#include "equations/decided_statement.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/pontryagin.hpp"
#include "mechanics/variations.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {
namespace {

class ControlVariations {
  public:
    ControlVariations(const Model& model, const System& system)
        : system_(system), control_(*system.control), graph_(system.graph),
          symbolic_(model, system.written.algebroid, {model.control->cost})
    {
        for (const Symbol& each : symbolic_.algebroid().fibre) eta_.push_back(input("η_" + each.name));
        for (const NodeId u : control_.u) delta_u_.push_back(input("δ" + graph_.input_name(u)));
        const Algebroid& algebroid = system.algebroid;
        delta_x_ = base_velocity(graph_, algebroid, eta_);
        delta_sigma_ = varied_functions(control_.sigma);
        const std::vector<NodeId> bracket = constant_bracket(graph_, algebroid, control_.sigma, eta_);
        for (std::size_t a = 0; a < system.r(); ++a) etadot_.push_back(graph_.subtract(delta_sigma_[a], bracket[a]));
        const ControlHamiltonian hamiltonian = control_hamiltonian(graph_, control_, system.mu);
        dH_du_ = hamiltonian.dH_du;
        motion_ = pontryagin_system(graph_, system, hamiltonian.value, {});
        ProofSetting setting = proof_setting(graph_, system);
        for (const std::vector<NodeId>& list : {eta_, delta_u_, system.mu})
            for (const NodeId each : list)
                if (std::ranges::find(setting.variables, each) == setting.variables.end())
                    setting.variables.push_back(each);
        decider_ = ZeroDecider::make(graph_, setting);
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("variations");
        for (std::size_t a = 0; a < system_.r(); ++a)
            set.symbols.push_back({graph_.input_name(eta_[a]), R"(\eta^{)" + symbolic_.fibre_latex(a) + "}"});
        set.blocks = {curves(), sections()};
        set.statements = {tangent(), critical()};
        return set;
    }

  private:
    /// The input has a name that the model does not have.
    [[nodiscard]] NodeId input(std::string name)
    {
        while (system_.declares(name)) name += "'";
        symbolic_.add_variable(name);
        return graph_.input(name);
    }

    /// The variations of functions of x and u.
    [[nodiscard]] std::vector<NodeId> varied_functions(const std::vector<NodeId>& functions)
    {
        Replacements seeds = replacements(system_.algebroid.x, delta_x_);
        const Replacements more = replacements(control_.u, delta_u_);
        seeds.insert(seeds.end(), more.begin(), more.end());
        return directional(graph_, functions, seeds);
    }

    [[nodiscard]] Equation shown(LeftSide left, const std::string& symbol, NodeId value)
    {
        return symbolic_.equation(left, symbol, {symbolic_.lower(to_tree(graph_, value))});
    }

    [[nodiscard]] EquationBlock curves()
    {
        EquationBlock block{"variations of the base, by a curve of sections η(t)",
                            "δx^i = ρ^i_a η^a",
                            R"(\delta x^i = \rho^i_a\, \eta^a)",
                            {}};
        for (std::size_t i = 0; i < system_.n(); ++i)
            block.equations.push_back(shown(LeftSide::symbol, "δ" + symbolic_.algebroid().base[i].name, delta_x_[i]));
        return block;
    }

    [[nodiscard]] EquationBlock sections()
    {
        EquationBlock block{"sections whose variations stay controlled, in the E-homotopy class of the curve",
                            "η̇^a = ρ_b(σ^a) η^b + (∂σ^a/∂u^A) δu^A - C^a_bc σ^b η^c",
                            R"(\dot\eta^a = \rho_b(\sigma^a)\, \eta^b + \frac{\partial \sigma^a}{\partial u^A}\, )"
                            R"(\delta u^A - C^a_{bc}\, \sigma^b \eta^c)",
                            {}};
        for (std::size_t a = 0; a < system_.r(); ++a)
            block.equations.push_back(shown(LeftSide::time_derivative, graph_.input_name(eta_[a]), etadot_[a]));
        return block;
    }

    [[nodiscard]] DecidedStatement decided(std::string formula, std::string latex,
                                           const std::vector<NamedResidual>& residuals)
    {
        return decided_statement(graph_, std::move(formula), std::move(latex), residuals,
                                 [&](NodeId residual) { return decision_by(decider_.get(), residual); });
    }

    /// The rate of delta x has no du/dt: it is a function of x and eta.
    [[nodiscard]] DecidedStatement tangent()
    {
        const Algebroid& algebroid = system_.algebroid;
        Replacements motion = replacements(algebroid.x, base_velocity(graph_, algebroid, control_.sigma));
        const Replacements more = replacements(eta_, etadot_);
        motion.insert(motion.end(), more.begin(), more.end());
        const std::vector<NodeId> rates = directional(graph_, delta_x_, motion);
        const std::vector<NodeId> varied = varied_functions(base_velocity(graph_, algebroid, control_.sigma));
        std::vector<NamedResidual> residuals;
        for (std::size_t i = 0; i < system_.n(); ++i)
            residuals.push_back({{symbolic_.algebroid().base[i].name}, graph_.subtract(varied[i], rates[i])});
        return decided("δ(ρ^i_a σ^a) = d/dt δx^i: varied curves are controlled too",
                       R"(\delta(\rho^i_a\, \sigma^a) = \frac{d}{dt} \delta x^i)", residuals);
    }

    [[nodiscard]] DecidedStatement critical()
    {
        const NodeId boundary = graph_.add(contraction(graph_, motion_.mudot, eta_),
                                           contraction(graph_, system_.mu, etadot_)); // d/dt (mu_a eta^a)
        const NodeId right = graph_.subtract(boundary, contraction(graph_, dH_du_, delta_u_));
        const std::string formula =
            "δL = d/dt (μ_a η^a) - (∂H/∂u^A) δu^A along Pontryagin's μ̇: in its E-homotopy class, "
            "η = 0 at the ends, ";
        return decided(formula + (control_.bounded()
                                      ? "no δu within the bounds lowers the cost where all have (∂H/∂u^A) δu^A ≤ 0"
                                      : "the cost is critical where ∂H/∂u = 0"),
                       R"(\delta L = \frac{d}{dt}(\mu_a\, \eta^a) - \frac{\partial H}{\partial u^A}\, \delta u^A)",
                       {{{"L"}, graph_.subtract(varied_functions({control_.cost})[0], right)}});
    }

    const System& system_;
    const ControlProblem& control_;
    Graph graph_;
    SymbolicModel symbolic_;
    std::vector<NodeId> eta_, delta_u_; ///< inputs
    std::vector<NodeId> delta_x_, delta_sigma_, etadot_, dH_du_;
    PhaseSystem motion_;
    std::unique_ptr<ZeroDecider> decider_;
};

} // namespace

EquationSet derive_control_variations(const Model& model, const System& system)
{
    return derived(model, "the variations", [&] { return ControlVariations(model, system).run(); });
}

} // namespace lagen
