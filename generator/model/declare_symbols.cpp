// SPDX-License-Identifier: GPL-2.0-or-later
/// Symbols join the model's lists: their names, and the families that they make.
#include "model/families.hpp"

#include "expression/parse_family.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

FamilyRole family_role(Role role)
{
    switch (role) {
    case Role::parameter: return FamilyRole::parameter;
    case Role::base: return FamilyRole::base;
    case Role::fibre: return FamilyRole::fibre;
    case Role::ambient: return FamilyRole::ambient;
    case Role::momentum: return FamilyRole::momentum;
    case Role::control: return FamilyRole::control;
    case Role::state: return FamilyRole::state;
    case Role::input: return FamilyRole::input;
    case Role::element: return FamilyRole::element;
    case Role::next: return FamilyRole::next;
    default: throw InternalError("a family of a role that has none");
    }
}

/// The number of symbols that play this role so far.
std::size_t count_of(const Model& model, Role role)
{
    switch (role) {
    case Role::parameter: return model.parameters.size();
    case Role::base: return model.base.coordinates.size();
    case Role::fibre: return model.fibre.coordinates.size();
    case Role::ambient: return 0; // they stand in the block of the inner algebroid
    case Role::control: return model.control ? model.control->controls.size() : 0;
    case Role::state: return model.states.size();
    case Role::input: return model.inputs.size();
    case Role::element: return model.groupoid->element.size();
    case Role::next: return model.groupoid->next.size();
    default: return model.fibre.momenta.size();
    }
}

void append_symbol(Model& model, const Symbol& symbol, Role role)
{
    switch (role) {
    case Role::parameter: model.parameters.push_back(Parameter{symbol, nullptr}); break;
    case Role::base: model.base.coordinates.push_back(symbol); break;
    case Role::fibre: model.fibre.coordinates.push_back(symbol); break;
    case Role::ambient: break;
    case Role::control: model.control->controls.push_back(symbol); break;
    case Role::state: model.states.push_back(FirstOrderState{symbol, nullptr, 0}); break;
    case Role::input: model.inputs.push_back(Input{symbol, nullptr}); break;
    case Role::element: model.groupoid->element.push_back(symbol); break;
    case Role::next: model.groupoid->next.push_back(symbol); break;
    default: model.fibre.momenta.push_back(symbol); break;
    }
}

} // namespace

DeclaredKey read_declaration(const ModelReader& reader, const Excerpt& key)
{
    const SourceRange where = key.range(0, key.text.size());
    if (!has_bracket(key.text)) return {key.text, {}, {Symbol{key.text, where, {}, {}, {}}}};
    const FamilyDeclaration family = parse_family(key);
    DeclaredKey out{family.name, close_shape(family, reader.model.scope), {}};
    for (std::size_t k = 0; k < out.shape.size(); ++k)
        out.symbols.push_back(Symbol{entry_name(out.name, out.shape, k), where, {}, {}, {}});
    return out;
}

std::string key_of(const ModelReader& reader, const Setting& setting)
{
    return entry_key(whole_text(option_of(setting), setting.name), reader.model.scope);
}

const char* option_of(const Setting& setting)
{
    return setting.binds ? "<--bind>" : "<--set>";
}

std::vector<Symbol> parameter_symbols(const Model& model)
{
    std::vector<Symbol> out;
    for (const Parameter& parameter : model.parameters) out.push_back(parameter.symbol);
    return out;
}

std::vector<Symbol> state_symbols(const Model& model)
{
    std::vector<Symbol> out;
    for (const FirstOrderState& state : model.states) out.push_back(state.symbol);
    return out;
}

std::vector<Symbol> input_symbols(const Model& model)
{
    std::vector<Symbol> out;
    for (const Input& input : model.inputs) out.push_back(input.symbol);
    return out;
}

std::vector<Symbol> free_parameters(const Model& model)
{
    std::vector<Symbol> out;
    for (const Parameter& parameter : model.parameters)
        if (!parameter.bound) out.push_back(parameter.symbol);
    return out;
}

bool has_own_step(const Model& model)
{
    return model.discrete && std::ranges::none_of(model.parameters, [&](const Parameter& parameter) {
               return parameter.symbol.name == model.discrete->step.name;
           });
}

void declare_symbols(ModelReader& reader, const std::vector<Symbol>& symbols, Role role)
{
    const std::size_t first = count_of(reader.model, role);
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const SourceRange& where = symbols[group.first].where;
        if (group.shape.rank == Rank::scalar) {
            reader.names.declare(group.name, role, where);
            continue;
        }
        reader.names.declare_family(group.name, group.shape, role, where);
        reader.model.families.push_back(Family{group.name, family_role(role), group.shape, first + group.first, where});
    }
    for (const Symbol& symbol : symbols) append_symbol(reader.model, symbol, role);
}

void add_to_scope(Scope& scope, const Model& model, const std::vector<Symbol>& symbols, FamilyRole role)
{
    const auto family_at = [&](std::size_t k) {
        return std::find_if(model.families.begin(), model.families.end(),
                            [&](const Family& each) { return each.role == role && each.first == k; });
    };
    for (std::size_t k = 0; k < symbols.size();) {
        const auto family = family_at(k);
        if (family == model.families.end()) {
            scope.declare(symbols[k].name, symbols[k].where);
            ++k;
        } else {
            scope.declare_family(family->name, family->shape, family->where);
            k += family->shape.size();
        }
    }
}

} // namespace lagen
