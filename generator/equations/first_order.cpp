// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a system of first order, as the file gives them.
#include "equations/derivations.hpp"
#include "equations/given_blocks.hpp"
#include "equations/symbolic_model.hpp"
#include "model/scene_form.hpp"

namespace lagen {

EquationSet derive_first_order(const Model& model, const WrittenAlgebroid& algebroid, Definitions definitions)
{
    if (model.rates.empty())
        throw MathematicsError("model '" + model.name + "' has no [rates], whose equations those of first order are",
                               "[algebroid] kind = \"first_order\"");
    return derived(model, "the rates", definitions, [&](const DefinitionChoice& choice) {
        SymbolicModel symbolic(model, algebroid, model.rates, choice, {});
        EquationSet set = symbolic.empty_set(entry_of(FormKind::first_order).name);
        set.given = given_blocks({}, constraints_and_invariants(symbolic));
        EquationBlock block{"rates", "ẋ^i = X^i(t, x)", R"(\dot x^i = X^i(t, x))", {}};
        for (std::size_t i = 0; i < model.rates.size(); ++i)
            block.equations.push_back(symbolic.equation(LeftSide::time_derivative, model.base.coordinates[i].name,
                                                        {symbolic.lower(model.rates[i])}));
        set.blocks = {std::move(block)};
        if (EquationBlock labels = symbolic.casimirs(); !labels.equations.empty()) set.blocks.push_back(labels);
        if (EquationBlock states = symbolic.states({}); !states.equations.empty())
            set.blocks.push_back(std::move(states));
        return symbolic.closed(std::move(set));
    });
}

} // namespace lagen
