// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/equation_module.hpp"

#include "expression/tree_identity.hpp"
#include "model/dependency_order.hpp"
#include "model/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace lagen {

namespace {

std::vector<std::string> names_of_symbols(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> names;
    for (const Symbol& symbol : symbols) names.push_back(symbol.name);
    return names;
}

/// Parameters, and inputs with their defaults, each behind those that it uses.
std::vector<NamedTree> valued_symbols(const Model& model)
{
    std::vector<NamedTree> values, ordered;
    for (const Parameter& parameter : model.parameters) values.push_back({parameter.symbol.name, parameter.value, {}});
    for (const Input& input : model.inputs) values.push_back({input.symbol.name, input.value, {}});
    for (const std::size_t k : dependency_order(values, "parameters")) ordered.push_back(values[k]);
    return ordered;
}

std::vector<ModuleSymbols> groups_of(const Model& model, const WrittenAlgebroid& algebroid)
{
    std::vector<ModuleSymbols> groups{{"base", "base coordinates x^i", names_of_symbols(algebroid.base)},
                                      {"fibre", "fibre coordinates y^a", names_of_symbols(model.fibre.coordinates)},
                                      {"momenta", "momenta mu_a", names_of_symbols(model.fibre.momenta)}};
    if (is_nonholonomic(model))
        groups.push_back({"ambient", "ambient fibre coordinates Y^a", names_of_symbols(algebroid.fibre)});
    if (model.control) groups.push_back({"controls", "controls u^A", names_of_symbols(model.control->controls)});
    std::vector<std::string> states;
    for (const FirstOrderState& state : model.states) states.push_back(state.symbol.name);
    if (!states.empty()) groups.push_back({"states", "first-order states", std::move(states)});
    return groups;
}

Tree opposite(const Tree& value)
{
    if (value->kind == TreeKind::negate) return value->arguments[0];
    return value->kind == TreeKind::number ? number(-value->number) : negate(value);
}

void take_structure(EquationModule& module, const WrittenAlgebroid& algebroid)
{
    const auto append = [](Tree& entry, const Tree& value) { entry = entry ? add({entry, value}) : value; };
    module.rank = algebroid.r();
    for (const AnchorValue& entry : algebroid.rho) append(module.rho[{entry.i, entry.a}], entry.value);
    std::set<std::pair<std::size_t, std::size_t>> given;
    for (const StructureValue& entry : algebroid.C) {
        given.emplace(entry.a, entry.b);
        append(module.C[{entry.c, entry.a, entry.b}], entry.value);
    }
    const std::map<std::array<std::size_t, 3>, Tree> written = module.C;
    for (const auto& [index, value] : written)
        if (!given.contains({index[2], index[1]})) module.C[{index[0], index[2], index[1]}] = opposite(value);
    module.constraints = algebroid.constraints;
}

/// The definitions that stand in the module's functions and structure, smaller ones first.
std::vector<NamedTree> used_definitions(const Model& model, const EquationModule& module)
{
    TreeIdentity identity;
    std::map<std::size_t, NamedTree> by_number; // a part has a smaller number than the whole
    for (const Definition& definition : model.definitions) {
        if (!definition.parameters.empty()) continue;
        const ArrayValue value = model.columns.close_array(name(definition.name, definition.where), true);
        if (value.shape.rank != Rank::scalar || value.entries[0]->arguments.empty()) continue;
        by_number.try_emplace(identity(value.entries[0]), NamedTree{definition.name, value.entries[0], {}});
    }
    std::vector<Tree> pending;
    for (const NamedTree& function : module.functions) pending.push_back(function.value);
    for (const auto& [index, value] : module.rho) pending.push_back(value);
    for (const auto& [index, value] : module.C) pending.push_back(value);
    std::set<std::size_t> seen;
    while (!pending.empty()) {
        const Tree tree = std::move(pending.back());
        pending.pop_back();
        if (!seen.insert(identity(tree)).second) continue;
        pending.insert(pending.end(), tree->arguments.begin(), tree->arguments.end());
    }
    std::vector<NamedTree> used;
    for (const auto& [number, definition] : by_number)
        if (seen.contains(number)) used.push_back(definition);
    return used;
}

/// Which blocks say how the state moves.
class Motion {
  public:
    explicit Motion(EquationModule& module) : module_(module), blocks_(module.equations.blocks) {}

    /// First-order states that the equations do not have are no part of the motion: a cost that is only watched.
    void find(std::vector<std::string> lanes, const std::vector<std::string>& velocities,
              const std::vector<FirstOrderState>& states)
    {
        for (const FirstOrderState& state : states)
            if (block_of(LeftSide::time_derivative, state.symbol.name)) lanes.push_back(state.symbol.name);
        for (std::size_t k = 0; k < blocks_.size(); ++k)
            if (std::ranges::any_of(blocks_[k].equations, [](const Equation& each) { return !each.mass.empty(); })) {
                module_.accelerations = k;
                module_.velocities = velocities;
            }
        std::set<std::size_t> rates;
        for (const std::string& lane : lanes) {
            if (std::ranges::find(module_.velocities, lane) != module_.velocities.end()) continue;
            const std::optional<std::size_t> block = block_of(LeftSide::time_derivative, lane);
            if (!block)
                throw MathematicsError(fmt::format("the equations of model '{}' do not determine the rate of '{}'",
                                                   module_.equations.model, lane));
            rates.insert(*block);
        }
        module_.state = lanes;
        module_.rates.assign(rates.begin(), rates.end());
        find_auxiliary();
    }

  private:
    [[nodiscard]] std::optional<std::size_t> block_of(LeftSide left, const std::string& symbol) const
    {
        for (std::size_t k = 0; k < blocks_.size(); ++k)
            for (const Equation& equation : blocks_[k].equations)
                if (equation.left == left && equation.symbol == symbol && equation.mass.empty()) return k;
        return std::nullopt;
    }

    void find_auxiliary()
    {
        std::set<std::string> known(module_.state.begin(), module_.state.end());
        known.insert("t");
        for (const NamedTree& parameter : module_.parameters) known.insert(parameter.name);
        std::set<std::size_t> auxiliary;
        std::vector<std::size_t> pending = module_.rates;
        if (!module_.velocities.empty()) pending.push_back(module_.accelerations);
        while (!pending.empty()) {
            const std::size_t block = pending.back();
            pending.pop_back();
            for (const std::string& each : names_in_block(blocks_[block])) {
                if (known.contains(each)) continue;
                const std::optional<std::size_t> found = block_of(LeftSide::symbol, each);
                if (!found)
                    throw MathematicsError(
                        fmt::format("the {} equations of model '{}' are written in '{}', which has no formula",
                                    module_.equations.form, module_.equations.model, each),
                        "`lagen generate` writes a header that solves for it");
                if (auxiliary.insert(*found).second) pending.push_back(*found);
            }
        }
        module_.auxiliary.assign(auxiliary.begin(), auxiliary.end());
    }

    [[nodiscard]] static std::set<std::string> names_in_block(const EquationBlock& block)
    {
        std::set<std::string> names;
        for (const Equation& equation : block.equations)
            for (const auto* groups : {&equation.mass, &equation.groups})
                for (const TermGroup& group : *groups)
                    for (std::string& each : names_in(group.value)) names.insert(std::move(each));
        return names;
    }

    EquationModule& module_;
    const std::vector<EquationBlock>& blocks_;
};

} // namespace

const std::vector<std::string>& module_forms()
{
    static const std::vector<std::string> forms{entry_of(FormKind::lagrange).name, entry_of(FormKind::hamilton).name,
                                                entry_of(FormKind::pontryagin).name, "poisson"};
    return forms;
}

EquationModule equation_module(const Model& model, const System& system, EquationSet equations)
{
    EquationModule module;
    module.equations = std::move(equations);
    module.parameters = valued_symbols(model);
    module.groups = groups_of(model, system.written.algebroid);
    if (model.lagrangian) module.functions.push_back({"lagrangian", model.lagrangian, {}});
    if (model.hamiltonian) module.functions.push_back({"hamiltonian", model.hamiltonian, {}});
    take_structure(module, system.written.algebroid);
    module.definitions = used_definitions(model, module);
    const std::string& form = module.equations.form;
    if (form == "poisson") return module;
    const std::vector<std::string> y = names_of_symbols(model.fibre.coordinates);
    std::vector<std::string> lanes = module.groups[0].symbols;
    const std::vector<std::string> fibre = form_named(form).momenta ? names_of_symbols(model.fibre.momenta) : y;
    lanes.insert(lanes.end(), fibre.begin(), fibre.end());
    Motion(module).find(std::move(lanes), y, model.states);
    return module;
}

} // namespace lagen
