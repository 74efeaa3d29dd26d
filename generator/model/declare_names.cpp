// SPDX-License-Identifier: GPL-2.0-or-later
/// The declarations of a model file: which names there are, and what part each plays.
#include "model/model_reader.hpp"

#include "expression/parse.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

void declare_default_momenta(ModelReader& reader)
{
    std::vector<Symbol> momenta;
    for (const Symbol& coordinate : reader.model.fibre.coordinates)
        momenta.push_back(Symbol{"p_" + coordinate.name, coordinate.where, {}, {}, {}});
    declare_symbols(reader, momenta, Role::momentum);
}

/// "V(q, r)" as a name and its parameters; "T" as a name alone.
Definition read_definition_key(const Excerpt& key)
{
    Definition out;
    const std::size_t open = key.text.find('(');
    const Excerpt name = trimmed(key, 0, std::min(open, key.text.size()));
    out.name = name.text;
    out.where = name.range(0, name.text.size());
    if (open == std::string::npos) return out;
    const Excerpt tail = trimmed(key, open + 1, key.text.size());
    if (tail.text.empty() || tail.text.back() != ')') {
        throw ModelError(fmt::format("the definition '{}' has no closing parenthesis at its end", key.text),
                         key.range(0, key.text.size()), "write \"V(q)\" = \"..\"");
    }
    for (const Excerpt& parameter : split_at_commas(trimmed(tail, 0, tail.text.size() - 1))) {
        const SourceRange where = parameter.range(0, parameter.text.size());
        require_identifier(parameter.text, where, "the parameter of a function");
        for (const std::string& earlier : out.parameters) {
            if (earlier != parameter.text) continue;
            throw ModelError(fmt::format("the function '{}' has two parameters called '{}'", out.name, earlier), where);
        }
        out.parameters.push_back(parameter.text);
    }
    return out;
}

} // namespace

std::vector<Symbol> read_names(const ModelReader& reader, const TomlEntry& entry, const std::string& what)
{
    std::vector<Symbol> out;
    for (const Excerpt& key : read_list(entry.value, what)) {
        const DeclaredKey declared = read_declaration(reader, key);
        out.insert(out.end(), declared.symbols.begin(), declared.symbols.end());
    }
    return out;
}

void read_header(ModelReader& reader, const TomlEntry* name, const TomlEntry* title, const std::string& file_name)
{
    Model& model = reader.model;
    if (title != nullptr) model.title = read_text(title->value, "the title");
    if (name != nullptr) {
        model.name = name->value.kind == TomlKind::string ? name->value.text.text : read_text(name->value, "the name");
        model.name_where = name->value.where;
        require_class_name(model.name, model.name_where, false);
        return;
    }
    model.name = std::filesystem::path(file_name).stem().string();
    model.name_where = SourceRange{model.file, 0, 0};
    require_class_name(model.name, model.name_where, true);
}

void declare_parameters(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    const TableReader table(block->value, "[parameters]");
    for (const TomlEntry& entry : block->value.entries) {
        const DeclaredKey declared = read_declaration(reader, entry.key);
        declare_symbols(reader, declared.symbols, Role::parameter);
        reader.parameter_names.push_back(declared.name);
    }
}

void declare_base(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    TableReader table(block->value, "[base]");
    if (const TomlEntry* entry = table.take("coordinates")) {
        declare_symbols(reader, read_names(reader, *entry, "'coordinates' of [base]"), Role::base);
    }
    if (const TomlEntry* entry = table.take("casimirs")) {
        const TableReader casimirs(entry->value, "'casimirs' of [base]");
        for (const TomlEntry& casimir : entry->value.entries) {
            reader.names.declare(casimir.name(), Role::casimir, casimir.where());
            reader.casimirs.emplace_back(
                casimir.key, read_expression(casimir.value, fmt::format("the Casimir '{}'", casimir.name())));
        }
    }
    (void)table.take("constraints");
    (void)table.take("domain");
    table.finish();
}

void declare_fibre(ModelReader& reader, const TomlEntry* block)
{
    Fibre& fibre = reader.model.fibre;
    const TomlEntry* coordinates = nullptr;
    const TomlEntry* momenta = nullptr;
    if (block != nullptr) {
        TableReader table(block->value, "[fibre]");
        coordinates = table.take("coordinates");
        momenta = table.take("momenta");
        table.finish();
    }
    if (reader.is_probe) return;
    if (coordinates != nullptr) {
        const std::vector<Symbol> names = read_names(reader, *coordinates, "'coordinates' of [fibre]");
        if (has_constraints_alone(reader))
            keep_coordinates(reader, names);
        else
            declare_symbols(reader, names, Role::fibre);
        require_rank(reader, coordinates->value.where);
    } else if (const auto chosen = has_constraints_alone(reader) ? chosen_coordinates(reader) : std::nullopt) {
        keep_coordinates(reader, *chosen);
    } else if (const auto standard = default_fibre(reader)) {
        declare_symbols(reader, *standard, Role::fibre);
    } else {
        throw ModelError("the fibre coordinates are missing, one a section of the frame",
                         block != nullptr ? block->where() : reader.model.algebroid.where,
                         "[fibre] coordinates = [\"y1\", \"y2\"]");
    }
    if (momenta == nullptr) return declare_default_momenta(reader);
    declare_symbols(reader, read_names(reader, *momenta, "'momenta' of [fibre]"), Role::momentum);
    if (fibre.momenta.size() != fibre.coordinates.size()) {
        throw ModelError(fmt::format("the number of momenta is {}, where one a fibre coordinate is required: {}",
                                     fibre.momenta.size(), fibre.coordinates.size()),
                         momenta->value.where);
    }
}

void declare_definitions(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    const TableReader table(block->value, "[definitions]");
    for (const TomlEntry& entry : block->value.entries) {
        Definition definition = read_definition_key(entry.key);
        reader.names.declare(definition.name, Role::definition, definition.where);
        definition.body = read_expression(entry.value, fmt::format("the definition '{}'", entry.name()));
        reader.model.definitions.push_back(std::move(definition));
    }
}

std::size_t index_of(const std::vector<Symbol>& symbols, const std::string& name)
{
    std::size_t k = 0;
    while (k < symbols.size() && symbols[k].name != name) ++k;
    return k;
}

std::vector<std::string> names_of(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> out;
    for (const Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

} // namespace lagen
