// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/equation_system.hpp"

#include "model/families.hpp"
#include "model/scene_form.hpp"

namespace lagen {

namespace {

std::vector<std::string> names_of_symbols(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> names;
    for (const Symbol& symbol : symbols) names.push_back(symbol.name);
    return names;
}

std::vector<NamedTree> valued_symbols(const Model& model)
{
    std::vector<NamedTree> values, ordered;
    for (const Parameter& parameter : model.parameters) values.push_back({parameter.symbol.name, parameter.value, {}});
    for (const Input& input : model.inputs) values.push_back({input.symbol.name, input.value, {}});
    for (const std::size_t k : dependency_order(values, "parameters")) ordered.push_back(values[k]);
    return ordered;
}

std::vector<NamedTree> scalar_definitions(const Model& model)
{
    std::vector<NamedTree> scalars;
    for (const Definition& definition : model.definitions) {
        if (!definition.parameters.empty()) continue;
        const ArrayValue value = model.columns.close_array(name(definition.name, definition.where), true);
        if (value.shape.rank == Rank::scalar) scalars.push_back({definition.name, value.entries[0], {}});
    }
    return scalars;
}

} // namespace

EquationSystem equation_system(const Model& model, const System& system)
{
    const WrittenAlgebroid& algebroid = system.written.algebroid;
    EquationSystem result{.parameters = valued_symbols(model),
                          .parts = {{"base", names_of_symbols(algebroid.base)},
                                    {"fibre", names_of_symbols(model.fibre.coordinates)},
                                    {"momenta", names_of_symbols(model.fibre.momenta)}},
                          .definitions = scalar_definitions(model),
                          .constraints = algebroid.constraints};
    if (is_nonholonomic(model)) result.parts.emplace_back("ambient", names_of_symbols(algebroid.fibre));
    if (model.control) result.parts.emplace_back("controls", names_of_symbols(model.control->controls));
    std::vector<std::string> states;
    for (const FirstOrderState& state : model.states) states.push_back(state.symbol.name);
    if (!states.empty()) result.parts.emplace_back("states", std::move(states));
    if (model.lagrangian) result.functions.push_back({"lagrangian", model.lagrangian, {}});
    if (model.hamiltonian) result.functions.push_back({"hamiltonian", model.hamiltonian, {}});
    const std::vector<Symbol>&x = algebroid.base, &y = algebroid.fibre;
    for (const AnchorValue& entry : algebroid.rho)
        result.rho.push_back({{x[entry.i].name, y[entry.a].name}, entry.value});
    for (const StructureValue& entry : algebroid.C)
        result.C.push_back({{y[entry.c].name, y[entry.a].name, y[entry.b].name}, entry.value});
    return result;
}

} // namespace lagen
