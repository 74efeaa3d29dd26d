// SPDX-License-Identifier: GPL-2.0-or-later
/// The exterior differential of a Lie algebroid on the coordinates and on the dual of its frame.
#include "equations/derivations.hpp"

#include "equations/symbolic_model.hpp"
#include "graph/core/lower.hpp"

namespace lagen {
namespace {

/// Appends value e^{basis} where it is not zero.
void append(const SymbolicModel& symbolic, Equation& equation, const GiNaC::ex& value, std::vector<std::string> basis)
{
    if (value.is_zero()) return; // nearly all, of a large algebra
    for (TermGroup& group : symbolic.simplified({{"", value}})) {
        group.basis = basis;
        equation.groups.push_back(std::move(group));
    }
}

/// symbol = w_{a1..ap} e^{a1} ^ .. ^ e^{ap}
Equation equation_of(SymbolicModel& symbolic, LeftSide left, const std::string& symbol, const Graph& graph,
                     const ExteriorForm& form)
{
    Equation equation{left, symbol, {}, {}};
    for (const auto& [indices, value] : form.components) {
        std::vector<std::string> basis;
        for (const std::size_t a : indices) basis.push_back(symbolic.algebroid().fibre[a].name);
        append(symbolic, equation, symbolic.lower(to_tree(graph, value)), std::move(basis));
    }
    return equation;
}

/// Each form of the model and its differential.
EquationBlock forms_of(SymbolicModel& symbolic, const System& system)
{
    Graph graph = system.graph;
    BaseGradient partial(graph, system.algebroid.x);
    EquationBlock block{"forms of the model and their differentials",
                        "dω = ρ_a(ω_I) e^a∧e^I + ω_I de^I",
                        R"(d\omega = \rho_a(\omega_I)\, e^a \wedge e^I + \omega_I\, de^I)",
                        {}};
    for (const FormClaim& claim : system.forms) {
        block.equations.push_back(equation_of(symbolic, LeftSide::symbol, claim.name, graph, claim.form));
        const ExteriorForm differential = lagen::differential(partial, system.algebroid, claim.form);
        block.equations.push_back(equation_of(symbolic, LeftSide::differential, claim.name, graph, differential));
    }
    return block;
}

EquationSet derive(const Model& model, const System& system)
{
    const WrittenAlgebroid& algebroid = system.written.algebroid;
    SymbolicModel symbolic(model, algebroid, {});
    const auto name_of = [&](std::size_t a) { return algebroid.fibre[a].name; };
    EquationBlock functions{"differentials of the coordinates", "dx^i = ρ^i_a e^a", R"(dx^i = \rho^i_a\, e^a)", {}};
    for (std::size_t i = 0; i < symbolic.n(); ++i) {
        Equation equation{LeftSide::differential, algebroid.base[i].name, {}, {}};
        for (std::size_t a = 0; a < symbolic.r(); ++a) append(symbolic, equation, symbolic.rho(i, a), {name_of(a)});
        functions.equations.push_back(std::move(equation));
    }
    EquationBlock forms{"differentials of the basis forms",
                        "de^c = -½ C^c_ab e^a∧e^b",
                        R"(de^c = -\tfrac12 C^c_{ab}\, e^a \wedge e^b)",
                        {}};
    for (std::size_t c = 0; c < symbolic.r(); ++c) {
        Equation equation{LeftSide::form, name_of(c), {}, {}};
        for (std::size_t a = 0; a < symbolic.r(); ++a)
            for (std::size_t b = a + 1; b < symbolic.r(); ++b)
                append(symbolic, equation, -symbolic.C(c, a, b), {name_of(a), name_of(b)});
        forms.equations.push_back(std::move(equation));
    }
    EquationSet set = symbolic.empty_set("exterior");
    set.blocks = {functions, forms};
    if (!system.forms.empty()) set.blocks.push_back(forms_of(symbolic, system));
    return set;
}

} // namespace

EquationSet derive_exterior(const Model& model, const System& system)
{
    return derived(model, "the exterior differentials", [&] { return derive(model, system); });
}

} // namespace lagen
