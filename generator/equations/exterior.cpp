// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/exterior.hpp"

#include "equations/symbolic_model.hpp"

namespace lagen {
namespace {

/// Appends value e^{basis} where it is not zero.
void append(const SymbolicModel& symbolic, Equation& equation, const GiNaC::ex& value, std::vector<std::string> basis)
{
    for (TermGroup& group : symbolic.simplified({{"", value}})) {
        group.basis = basis;
        equation.groups.push_back(std::move(group));
    }
}

EquationSet derive(const Model& model, const WrittenAlgebroid& algebroid)
{
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
    return set;
}

} // namespace

EquationSet derive_exterior(const Model& model, const WrittenAlgebroid& algebroid)
{
    return derived(model, "the exterior differentials", [&] { return derive(model, algebroid); });
}

} // namespace lagen
