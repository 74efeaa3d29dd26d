// SPDX-License-Identifier: GPL-2.0-or-later
/// Parameter values, settings from the command line, and the base's constraints, Casimirs and domain.
#include "model/model_reader.hpp"

#include "expression/find_part.hpp"
#include "expression/parse.hpp"
#include "model/dependency_order.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// How a parameter that is given an array is declared.
std::string family_hint(const std::string& name, const Shape& shape)
{
    if (shape.rank == Rank::vector)
        return fmt::format("a vector is declared with its range: \"{}[1..{}]\" = ..", name, shape.rows);
    return fmt::format("a matrix is declared with its ranges: \"{}[1..{},1..{}]\" = ..", name, shape.rows,
                       shape.columns);
}

/// Gives the parameters that `key` names their values.
void assign(ModelReader& reader, const ResolvedKey& key, const Tree& value, const std::string& what,
            const SourceRange& where)
{
    const ArrayValue closed = reader.close_array(value, {Role::parameter}, what);
    const bool declares = key.shape.rank == Rank::scalar && key.name.find('[') == std::string::npos;
    const std::vector<Tree> entries =
        fit_values(closed, key.shape, what, where, declares ? family_hint(key.name, closed.shape) : "");
    for (std::size_t k = 0; k < entries.size(); ++k) reader.model.parameters[key.indices[k]].value = entries[k];
}

std::string input_hint(const std::string& name)
{
    return fmt::format("a scene says what an input is: inputs = {{ {} = \"..\" }}", name);
}

void apply(ModelReader& reader, const std::vector<Symbol>& symbols, const Setting& setting)
{
    if (const std::optional<ResolvedKey> key = resolve_key(symbols, key_of(reader, setting))) {
        if (setting.gives_value())
            assign(reader, *key, parse_expression(setting.value),
                   fmt::format("the value set for parameter '{}'", key->name),
                   setting.value.range(0, setting.value.text.size()));
        for (const std::size_t k : key->indices) reader.model.parameters[k].bound |= setting.binds;
        return;
    }
    const Names::Entry* entry = reader.names.find(setting.name);
    std::vector<std::string> known = reader.names.of(Role::parameter);
    const std::vector<std::string> sizes = reader.names.of(Role::size);
    known.insert(known.end(), sizes.begin(), sizes.end());
    if (entry != nullptr && entry->role == Role::size) return; // read_sizes has seen it
    const std::string what =
        entry != nullptr ? fmt::format("'{}' is {}, not a parameter", setting.name, role_text(entry->role))
                         : fmt::format("the model has no parameter{} '{}' to {}", sizes.empty() ? "" : " or size",
                                       setting.name, setting.binds ? "bind" : "set");
    const std::string size = nearest_name(setting.name, sizes);
    const bool starts = entry != nullptr && setting.gives_value() && !setting.binds &&
                        (entry->role == Role::base || entry->role == Role::fibre || entry->role == Role::momentum ||
                         entry->role == Role::state);
    const std::string hint =
        entry != nullptr && entry->role == Role::input ? input_hint(setting.name)
        : starts ? fmt::format("where a scene starts is set by --initial {}={}, of `run` and `sweep`", setting.name,
                               setting.value.text)
        : !size.empty() && nearest_name(setting.name, known) == size ? fmt::format("did you mean the size '{}'?", size)
        : resolve_key(symbols, family_name(setting.name))
            ? hint_for_key(symbols, setting.name, "parameters")
            : hint_for(setting.name, known, sizes.empty() ? "parameters" : "parameters and sizes");
    const std::string given = setting.gives_value() ? setting.name + "=" + setting.value.text : setting.name;
    throw ModelError(what, whole_text(option_of(setting), given).range(0, setting.name.size()), hint);
}

/// Strings of the list `key` of [base].
std::vector<Excerpt> base_list(const TomlEntry* block, const char* key)
{
    if (block == nullptr) return {};
    TableReader table(block->value, "[base]");
    const TomlEntry* entry = table.take(key);
    return entry != nullptr ? read_list(entry->value, fmt::format("'{}' of [base]", key)) : std::vector<Excerpt>{};
}

/// A constraint without base coordinates holds everywhere or nowhere.
void require_coordinate(const ModelReader& reader, const Tree& closed, const Excerpt& text)
{
    for (const std::string& name : names_in(closed)) {
        const Names::Entry* entry = reader.names.find(name);
        if (entry != nullptr && entry->role == Role::base) return;
    }
    throw ModelError(fmt::format("the constraint '{}' contains no base coordinate", text.text),
                     text.range(0, text.text.size()), "a constraint is an expression of base coordinates that is zero");
}

/// A constraint that moves with t leaves the base: its rate is a constraint on velocities, with a drift.
void refuse_moving(const ModelReader& reader, const std::vector<Tree>& closed, const Excerpt& text)
{
    constexpr std::size_t longest = 60; ///< characters of the constraint in the hint
    const Tree time =
        find_name(closed, [&](const std::string& name) { return name == "t" && reader.names.find(name) == nullptr; });
    if (time == nullptr) return;
    throw ModelError("a constraint may not depend on the time ('t')",
                     time->where.file ? time->where : text.range(0, text.text.size()),
                     fmt::format("constraints of which one moves with t are constraints on velocities, with a drift: "
                                 "kind = \"nonholonomic\" with constraints = [\"Dt({})\"], each of them in Dt, and "
                                 "[algebroid.of] kind = \"tangent\"",
                                 text.text.size() <= longest ? text.text : ".."));
}

bool is_strict(Comparison comparison)
{
    return comparison == Comparison::less || comparison == Comparison::greater || comparison == Comparison::not_equal;
}

/// One strict inequality an entry: a vector is compared with a scalar, or with a vector of its shape.
std::vector<Tree> read_inequalities(const ModelReader& reader, const Excerpt& text)
{
    const Tree parsed = parse_comparison(text);
    if (parsed->kind != TreeKind::compare || !is_strict(parsed->comparison)) {
        throw ModelError(fmt::format("the domain condition '{}' is not a strict inequality", text.text),
                         text.range(0, text.text.size()), "use <, > or !=");
    }
    const auto close = [&](std::size_t side) {
        return reader.close_array(parsed->arguments[side], {Role::parameter, Role::base}, "the domain");
    };
    const ArrayValue left = close(0);
    const ArrayValue right = close(1);
    const bool scalars = left.shape.rank == Rank::scalar && right.shape.rank == Rank::scalar;
    const bool alike = left.shape == right.shape || left.shape.rank == Rank::scalar || right.shape.rank == Rank::scalar;
    if (scalars || !alike) return {reader.close(parsed, {Role::parameter, Role::base}, "the domain")};
    std::vector<Tree> inequalities;
    for (std::size_t k = 0; k < std::max(left.shape.size(), right.shape.size()); ++k)
        inequalities.push_back(compare(parsed->comparison, left.entries[left.entries.size() == 1 ? 0 : k],
                                       right.entries[right.entries.size() == 1 ? 0 : k]));
    return inequalities;
}

/// Keeps the constraints of a level set, without repetitions.
void keep_constraints(Base& base, const std::vector<std::size_t>& places)
{
    Base kept;
    for (const std::size_t place : places) {
        kept.constraints.push_back(base.constraints.at(place));
        kept.constraint_texts.push_back(base.constraint_texts.at(place));
    }
    base.constraints = std::move(kept.constraints);
    base.constraint_texts = std::move(kept.constraint_texts);
}

} // namespace

void read_parameters(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings)
{
    const std::vector<Symbol> symbols = parameter_symbols(reader.model);
    for (std::size_t k = 0; block != nullptr && k < block->value.entries.size(); ++k) {
        const TomlEntry& entry = block->value.entries[k];
        const std::string& name = reader.parameter_names[k];
        const Tree value = read_array_expression(entry.value, fmt::format("the parameter '{}'", name));
        assign(reader, *resolve_key(symbols, name), value, fmt::format("the value of parameter '{}'", name),
               entry.value.where);
    }
    for (const Setting& setting : settings) apply(reader, symbols, setting);
    std::vector<NamedTree> values;
    for (const Parameter& parameter : reader.model.parameters) {
        values.push_back(NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    (void)dependency_order(values, "parameters");
}

void read_base(ModelReader& reader, const TomlEntry* block)
{
    Base& base = reader.model.base;
    const auto point = {Role::parameter, Role::base};
    for (const Excerpt& text : base_list(block, "constraints")) {
        refuse_equation(text, "the constraint");
        const auto moving = {Role::parameter, Role::base, Role::time};
        ArrayValue closed = reader.close_array(parse_expression(text), moving, "a constraint");
        refuse_moving(reader, closed.entries, text);
        for (Tree& entry : closed.entries) {
            require_coordinate(reader, entry, text);
            base.constraints.push_back(std::move(entry));
            base.constraint_texts.push_back(text.range(0, text.text.size()));
        }
    }
    if (reader.own_constraints) keep_constraints(base, *reader.own_constraints);
    for (const auto& [key, value] : reader.casimirs) {
        const ArrayValue closed = reader.close_array(value, point, fmt::format("the Casimir '{}'", key.text));
        append_entries(base.casimirs, key, closed);
    }
    for (const Excerpt& text : base_list(block, "domain"))
        for (Tree& inequality : read_inequalities(reader, text)) base.domain.push_back(std::move(inequality));
}

} // namespace lagen
