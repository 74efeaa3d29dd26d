// SPDX-License-Identifier: GPL-2.0-or-later
/// The [groupoid] block: its kind and its group first (the rank of its algebroid depends on them), the coordinates of
/// an arrow and the action once expressions can be closed.
#include "model/algebroid_draft.hpp"

#include "algebra/named_algebra.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

struct GroupoidRow {
    const char* name;
    GroupoidKind kind;
    std::array<const char*, 4> keys; ///< besides `kind`
};

constexpr GroupoidRow groupoid_rows[] = {
    {"pair", GroupoidKind::pair, {}},
    {"group", GroupoidKind::group, {"group", "generators", "element"}},
    {"action", GroupoidKind::action, {"group", "generators", "element", "action"}},
    {"atiyah", GroupoidKind::atiyah, {"group", "generators", "element"}},
};

/// How messages call an entry of the block.
std::string title_of(const TomlEntry& entry)
{
    return fmt::format("'{}' of [groupoid]", entry.name());
}

const GroupoidRow& read_groupoid_kind(const TomlEntry& block, const TomlEntry* entry)
{
    std::vector<std::string> known;
    for (const GroupoidRow& row : groupoid_rows) known.emplace_back(row.name);
    if (entry == nullptr)
        throw ModelError("[groupoid] has no key 'kind'", block.where(), fmt::format("kinds: {}", comma_list(known)));
    const std::string text = read_text(entry->value, title_of(*entry));
    for (const GroupoidRow& row : groupoid_rows)
        if (text == row.name) return row;
    throw ModelError(fmt::format("unknown groupoid kind '{}'", text), entry->value.where,
                     hint_for(text, known, "kinds"));
}

void require_keys_of_kind(const TomlEntry& block, const GroupoidRow& row)
{
    for (const TomlEntry& entry : block.value.entries) {
        const auto is_key = [&](const char* key) { return key != nullptr && entry.name() == key; };
        if (entry.name() == "kind" || std::ranges::any_of(row.keys, is_key)) continue;
        throw ModelError(fmt::format("a groupoid of kind '{}' takes no '{}'", row.name, entry.name()), entry.where());
    }
}

/// A group lies over a point, the others over M.
void require_base_of_kind(const ModelReader& reader, const TomlEntry& block, const GroupoidRow& row)
{
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    if (row.kind == GroupoidKind::group && !base.empty())
        throw ModelError(
            fmt::format("a group is a groupoid over a point, but the base coordinate '{}' is declared", base[0].name),
            block.where(), "a group that moves the points of a base is a groupoid of kind \"action\"");
    if (row.kind != GroupoidKind::group && base.empty())
        throw ModelError(
            fmt::format("a groupoid of kind '{}' lies over a base, but no base coordinate is declared", row.name),
            block.where(), "[base] coordinates = [\"x\", \"y\"]");
}

std::string group_meant(std::string name)
{
    for (char& c : name)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return algebra_of_group(name) ? name : nearest_name(name, named_group_names());
}

ArrayValue basis_matrix(const SparseMatrix& matrix, std::size_t size, const SourceRange& where)
{
    ArrayValue out{{Rank::matrix, size, size}, {}};
    for (const Rational& entry : dense(matrix, size)) out.entries.push_back(number(entry, where));
    return out;
}

} // namespace

void read_named_group(const ModelReader& reader, GroupoidBlock& block, const TomlEntry& entry, const std::string& what)
{
    block.group = with_sizes(read_text(entry.value, what), reader.model.sizes);
    block.group_where = entry.value.where;
    const std::optional<NamedAlgebra> algebra = algebra_of_group(block.group);
    if (!algebra) {
        const std::string near = group_meant(block.group);
        throw ModelError(
            fmt::format("there is no group called \"{}\" of rank at most {}", block.group, named_algebra_rank_limit),
            block.group_where,
            fmt::format("{}known are {}, the last three with any number, and sums A + B",
                        near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near),
                        comma_list(named_group_names())));
    }
    for (const SparseMatrix& matrix : algebra->basis)
        block.generators.push_back(basis_matrix(matrix, algebra->size, block.group_where));
}

namespace {

/// Their number now, for the rank of the algebroid; their entries when expressions can be closed.
void count_generators(GroupoidBlock& block, const TomlEntry& entry)
{
    block.group_where = entry.value.where;
    if (entry.value.kind != TomlKind::array || entry.value.items.empty())
        throw ModelError(
            fmt::format("'generators' of [groupoid] is {}, where a list of matrices is required",
                        entry.value.kind == TomlKind::array ? "an empty array" : kind_text(entry.value.kind)),
            entry.value.where, "generators = [[[0, -1], [1, 0]]], one matrix a section");
    if (entry.value.items.size() > named_algebra_rank_limit)
        throw ModelError(fmt::format("the number of generators is {}, more than {}", entry.value.items.size(),
                                     named_algebra_rank_limit),
                         entry.value.where);
    block.generators.resize(entry.value.items.size());
}

void read_group(const ModelReader& reader, GroupoidBlock& block, const TomlEntry& table)
{
    const TomlEntry* group = find_entry(table.value, "group");
    const TomlEntry* generators = find_entry(table.value, "generators");
    if (group != nullptr && generators != nullptr)
        throw ModelError("[groupoid] gives both 'group' and 'generators'", generators->where(), "keep one of them");
    if (group == nullptr && generators == nullptr)
        throw ModelError("[groupoid] needs 'group' or 'generators'", table.where(),
                         "group = \"SO(3)\", or generators = [E_1, ..], one matrix a section");
    if (group != nullptr) return read_named_group(reader, block, *group, title_of(*group));
    count_generators(block, *generators);
}

void close_generators(ModelReader& reader, GroupoidBlock& block, const TomlEntry& entry)
{
    for (std::size_t c = 0; c < block.generators.size(); ++c) {
        const TomlValue& item = entry.value.items[c];
        const std::string what = fmt::format("the generator number {}", c + 1);
        ArrayValue matrix = reader.close_array(read_array_expression(item, what), {Role::parameter}, what);
        const bool square = matrix.shape.rank == Rank::matrix && matrix.shape.rows == matrix.shape.columns;
        if (!square || (c > 0 && !(matrix.shape == block.generators[0].shape)))
            throw ModelError(fmt::format("{} is {}, where {} is required", what, to_text(matrix.shape),
                                         square ? to_text(block.generators[0].shape) : "a square matrix"),
                             item.where, square ? "all generators have the size of the first" : "");
        block.generators[c] = std::move(matrix);
    }
}

void declare_element(ModelReader& reader, const TomlEntry* entry)
{
    const Shape shape = reader.model.groupoid->generators[0].shape;
    const std::string name = entry != nullptr ? read_text(entry->value, title_of(*entry)) : "W";
    const SourceRange where = entry != nullptr ? entry->value.where : reader.model.groupoid->where;
    require_identifier(name, where, "the name of the group element");
    std::vector<Symbol> symbols;
    for (std::size_t k = 0; k < shape.size(); ++k)
        symbols.push_back(Symbol{entry_name(name, shape, k), where, {}, {}, {}});
    declare_symbols(reader, symbols, Role::element);
}

void declare_targets(ModelReader& reader)
{
    std::vector<Symbol> symbols;
    for (const Symbol& each : reader.model.base.coordinates)
        symbols.push_back(Symbol{next_name(each.name), each.where, {}, {}, {}});
    declare_symbols(reader, symbols, Role::next);
}

/// Of models that give [algebroid] too.
void require_rank_of_groupoid(const Model& model)
{
    const std::size_t rank = rank_of(*model.groupoid, model.base.coordinates.size());
    const std::size_t found = model.fibre.coordinates.size();
    if (rank == found) return;
    throw ModelError(
        fmt::format("the number of fibre coordinates is {}, where the groupoid has sections: {}", found, rank),
        model.groupoid->where, "one a base coordinate (pair, atiyah), then one a generator of the group");
}

} // namespace

std::size_t rank_of(const GroupoidBlock& block, std::size_t n)
{
    return (block.has_targets() ? n : 0) + block.generators.size();
}

void declare_groupoid(ModelReader& reader)
{
    if (reader.groupoid == nullptr) return;
    const TomlEntry& entry = *reader.groupoid;
    TableReader table(entry.value, "[groupoid]");
    const GroupoidRow& row = read_groupoid_kind(entry, table.take("kind"));
    for (const char* key : {"group", "generators", "element", "action"}) (void)table.take(key);
    table.finish();
    require_keys_of_kind(entry, row);
    require_base_of_kind(reader, entry, row);
    GroupoidBlock block;
    block.kind = row.kind;
    block.where = entry.where();
    if (block.has_group()) read_group(reader, block, entry);
    reader.model.groupoid = std::move(block);
}

void declare_arrows(ModelReader& reader)
{
    if (!reader.model.groupoid) return;
    GroupoidBlock& block = *reader.model.groupoid;
    const auto entry = [&](const char* key) {
        return reader.groupoid == nullptr ? nullptr : find_entry(reader.groupoid->value, key);
    };
    if (const TomlEntry* generators = entry("generators")) close_generators(reader, block, *generators);
    require_rank_of_groupoid(reader.model);
    if (block.has_group()) declare_element(reader, entry("element"));
    if (block.has_targets()) declare_targets(reader);
}

void read_action(ModelReader& reader)
{
    if (!reader.model.groupoid || reader.model.groupoid->kind != GroupoidKind::action) return;
    GroupoidBlock& block = *reader.model.groupoid;
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    const TomlEntry* action = find_entry(reader.groupoid->value, "action");
    if (action == nullptr)
        throw ModelError("a groupoid of kind 'action' needs 'action'", block.where,
                         "action = { x = \"..\" }, the right action x.W, a line a base coordinate");
    const TableReader table(action->value, title_of(*action));
    block.action.resize(base.size());
    for (const TomlEntry& entry : action->value.entries) {
        const ResolvedKey key = require_key(base, entry.key, table.title(), "base coordinate", &reader.model.scope);
        const std::string what = fmt::format("the action on '{}'", key.name);
        const ArrayValue closed = reader.close_arrow(read_array_expression(entry.value, what),
                                                     {Role::parameter, Role::base, Role::element}, what);
        const std::vector<Tree> values = fit_values(closed, key.shape, what, entry.value.where);
        for (std::size_t k = 0; k < values.size(); ++k) {
            Tree& place = block.action[key.indices[k]];
            if (place)
                throw ModelError(fmt::format("the action on '{}' is given twice", base[key.indices[k]].name),
                                 entry.where(), "keep one of them");
            place = values[k];
        }
    }
    for (std::size_t i = 0; i < base.size(); ++i)
        if (!block.action[i])
            throw ModelError(fmt::format("the action leaves out the base coordinate '{}'", base[i].name),
                             action->where(),
                             fmt::format("a coordinate that does not move is written {0} = \"{0}\"", base[i].name));
}

} // namespace lagen
