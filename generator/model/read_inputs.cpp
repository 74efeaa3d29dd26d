// SPDX-License-Identifier: GPL-2.0-or-later
/// The [inputs] block, `u = default`, and what a scene says of inputs: expressions, or a table.
#include "expression/parse_family.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/scene_reader.hpp"
#include "model/scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

void declare_inputs(ModelReader& reader)
{
    if (reader.inputs == nullptr) return;
    const TableReader table(reader.inputs->value, "[inputs]");
    for (const TomlEntry& entry : reader.inputs->value.entries)
        declare_symbols(reader, read_declaration(reader, entry.key).symbols, Role::input);
}

void read_inputs(ModelReader& reader)
{
    if (reader.inputs == nullptr) return;
    auto next = reader.model.inputs.begin();
    for (const TomlEntry& entry : reader.inputs->value.entries) {
        const DeclaredKey key = read_declaration(reader, entry.key);
        const std::string what = fmt::format("the default of the input '{}'", key.name);
        const ArrayValue closed = reader.close_array(read_array_expression(entry.value, what), {Role::parameter}, what);
        for (Tree& value : fit_values(closed, key.shape, what, entry.value.where)) (next++)->value = std::move(value);
    }
}

namespace {

ArrayValue close_input(const ModelReader& reader, const TomlEntry& entry, const std::string& what)
{
    const Tree parsed = read_array_expression(entry.value, what);
    const Role ambient = is_nonholonomic(reader.model) ? Role::ambient : Role::fibre;
    return reader.close_mechanical_array(
        parsed, {Role::time, Role::parameter, Role::base, Role::fibre, ambient, Role::state}, what, true);
}

} // namespace

void read_scene_inputs(const ModelReader& reader, Scene& scene, const TomlEntry& entry)
{
    const std::vector<Symbol> symbols = input_symbols(reader.model);
    if (symbols.empty())
        throw ModelError(fmt::format("scene '{}' gives inputs, and the model has none", scene.name), entry.where(),
                         "[inputs] u = 0, and u in [forces]");
    if (entry.value.kind == TomlKind::string) {
        scene.inputs.clear();
        scene.input_table =
            InputTable{read_text(entry.value, fmt::format("'inputs' of scene '{}'", scene.name)), entry.value.where};
        return;
    }
    const TableReader table(entry.value, fmt::format("'inputs' of scene '{}'", scene.name),
                            "inputs = { u = \"..\" }, or the name of a CSV file");
    scene.input_table.reset();
    std::vector<NamedTree> given;
    for (const TomlEntry& each : entry.value.entries) {
        const std::optional<ResolvedKey> key = resolve_key(symbols, entry_key(each.key, reader.model.scope));
        if (!key)
            throw ModelError(
                fmt::format("scene '{}' gives '{}', which is no input of the model", scene.name, each.name()),
                each.where(), hint_for(each.name(), reader.names.of(Role::input), "inputs"));
        const std::string what = fmt::format("the input '{}' of scene '{}'", key->name, scene.name);
        const std::vector<Tree> values =
            fit_values(close_input(reader, each, what), key->shape, what, each.value.where);
        for (std::size_t k = 0; k < values.size(); ++k) {
            const std::string& name = symbols[key->indices[k]].name;
            if (std::ranges::find(given, name, &NamedTree::name) != given.end())
                throw ModelError(fmt::format("{} is given twice", what), each.where(), "keep one of them");
            given.push_back({name, values[k], each.where()});
        }
    }
    put_all(scene.inputs, std::move(given));
}

} // namespace lagen
