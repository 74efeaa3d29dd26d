// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of a discrete Lagrangian for a person, with what is decided of them (mechanics/cartan.hpp).
#include "equations/derivations.hpp"

#include "equations/decided_statement.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/cartan.hpp"
#include "verify/arrow_decider.hpp"

namespace lagen {
namespace {

class CartanDerivation {
  public:
    CartanDerivation(const Model& model, const System& system)
        : system_(system), graph_(system.graph),
          symbolic_(model, system.written.algebroid, {model.discrete->lagrangian}),
          cartan_(cartan_sections(graph_, system))
    {
        add_arrow_names(symbolic_, graph_, {system.groupoid->arrow});
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("cartan");
        set.symbols.push_back({"Θ⁻", R"(\Theta_L^-)"});
        set.symbols.push_back({"Θ⁺", R"(\Theta_L^+)"});
        set.symbols.push_back({"Ω_L", R"(\Omega_L)"});
        set.blocks = {
            components("Cartan section at the source", "Θ⁻(E⁻_a) = F⁻L_a = →e_a(L),  Θ⁻(E⁺_a) = 0,  ρ(E⁻_a) = -→e_a",
                       minus_latex, "Θ⁻", cartan_.minus),
            components("Cartan section at the target", "Θ⁺(E⁺_a) = F⁺L_a = ←e_a(L),  Θ⁺(E⁻_a) = 0,  ρ(E⁺_a) = ←e_a",
                       plus_latex, "Θ⁺", cartan_.plus),
            components("Cartan 2-section", "Ω_L(E⁻_a, E⁺_b) = ←e_b(→e_a(L)),  else 0;  Ω_L = -dΘ⁻ = -dΘ⁺", omega_latex,
                       "Ω_L", cartan_.omega)};
        set.statements = statements();
        return set;
    }

  private:
    static constexpr const char* minus_latex = R"(\Theta_L^-(E^-_a) = F^-L_a = \overrightarrow{e_a}(L),\quad )"
                                               R"(\Theta_L^-(E^+_a) = 0,\quad \rho(E^-_a) = -\overrightarrow{e_a})";
    static constexpr const char* plus_latex = R"(\Theta_L^+(E^+_a) = F^+L_a = \overleftarrow{e_a}(L),\quad )"
                                              R"(\Theta_L^+(E^-_a) = 0,\quad \rho(E^+_a) = \overleftarrow{e_a})";
    static constexpr const char* differential_latex =
        R"(dL = \Theta_L^+ - \Theta_L^-,\quad \Theta_L^-(E^-_a) = -\tfrac{d}{ds} L(\eta_a(s)^{-1} g),\quad )"
        R"(\Theta_L^+(E^+_a) = \tfrac{d}{ds} L(g\, \eta_a(s)))";
    static constexpr const char* omega_latex =
        R"(\Omega_L(E^-_a, E^+_b) = \overleftarrow{e_b}(\overrightarrow{e_a}(L)),\quad )"
        R"(\Omega_L = -d\Theta_L^- = -d\Theta_L^+)";

    [[nodiscard]] EquationBlock components(const char* title, const char* formula, const char* latex,
                                           const char* symbol, const ExteriorForm& form)
    {
        EquationBlock block{title, formula, latex, {}};
        for (const auto& [index, value] : form.components) {
            const NodeId shown = on_group(graph_, *system_.groupoid, {system_.groupoid->arrow}, value);
            Equation equation =
                symbolic_.equation(LeftSide::component, symbol, {symbolic_.lower(to_tree(graph_, shown))});
            if (equation.groups.empty()) continue;
            for (const std::size_t k : index) equation.arguments.push_back(section_name(k % system_.r()));
            block.equations.push_back(std::move(equation));
        }
        return block;
    }

    [[nodiscard]] std::string section_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }

    [[nodiscard]] std::vector<DecidedStatement> statements()
    {
        BaseGradient partial(graph_, cartan_.prolongation.x);
        const ExteriorForm L = function_form(*system_.discrete->lagrangian);
        const auto opposite_of_differential = [&](const ExteriorForm& theta) {
            return product(graph_, graph_.constant(-1), differential(partial, cartan_.prolongation, theta));
        };
        const ExteriorForm from_source = opposite_of_differential(cartan_.minus);
        const ExteriorForm from_target = opposite_of_differential(cartan_.plus);
        const ExteriorForm mixed = mixed_derivatives(partial);
        return {
            decided("dL = Θ⁺ - Θ⁻,  Θ⁻(E⁻_a) = -d/ds L(η_a(s)⁻¹ g),  Θ⁺(E⁺_a) = d/ds L(g η_a(s))", differential_latex,
                    difference(graph_, differential(partial, cartan_.prolongation, L),
                               translated_momenta(graph_, system_))),
            decided("→e_a(←e_b(L)) = ←e_b(→e_a(L))",
                    R"(\overrightarrow{e_a}(\overleftarrow{e_b}(L)) = \overleftarrow{e_b}(\overrightarrow{e_a}(L)))",
                    difference(graph_, mixed, cartan_.omega)),
            decided("-dΘ⁻ = Ω_L", R"(-d\Theta_L^- = \Omega_L)", difference(graph_, from_source, cartan_.omega)),
            decided("-dΘ⁺ = Ω_L", R"(-d\Theta_L^+ = \Omega_L)", difference(graph_, from_target, cartan_.omega)),
        };
    }

    /// ->e_a(<-e_b(L)) E-^a ^ E+^b
    [[nodiscard]] ExteriorForm mixed_derivatives(BaseGradient& partial)
    {
        ExteriorForm form{2, {}};
        for (const auto& [b, momentum] : cartan_.plus.components)
            for (std::size_t a = 0; a < system_.r(); ++a)
                form.components.emplace(FormIndex{a, b[0]}, partial.along(system_.groupoid->right[a], momentum));
        return form;
    }

    /// The form vanishes for all arrows.
    [[nodiscard]] DecidedStatement decided(const char* formula, const char* latex, const ExteriorForm& residual)
    {
        const auto name_of = [&](std::size_t k) {
            return (k < system_.r() ? "E⁻_" : "E⁺_") + section_name(k % system_.r());
        };
        return decided_statement(graph_, formula, latex, residuals_of(residual, name_of),
                                 [&](NodeId value) { return decide_on_arrows(graph_, system_, value, {}); });
    }

    const System& system_;
    Graph graph_;
    SymbolicModel symbolic_;
    CartanSections cartan_;
};

} // namespace

EquationSet derive_cartan(const Model& model, const System& system)
{
    require_written_discrete(system);
    return derived(model, "the Cartan sections", [&] { return CartanDerivation(model, system).run(); });
}

} // namespace lagen
