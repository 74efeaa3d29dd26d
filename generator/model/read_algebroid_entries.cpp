// SPDX-License-Identifier: GPL-2.0-or-later
/// The entries of [algebroid]: anchor, bracket, spanned_by, sections, connection. Keys of rows and entries are
/// coordinates or families of them; of two families the value is a matrix, (entries of the inner key) x (entries of the
/// outer one).
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

using Roles = std::initializer_list<Role>;

/// How messages call a table of rows of entries, and what its keys name.
struct RowTexts {
    std::string title;    ///< "[algebroid.anchor]"
    const char* row;      ///< "the anchor of"
    const char* entry;    ///< "the anchor entry"
    const char* row_noun; ///< "fibre coordinate": "which is no .."
    const char* entry_noun;
    bool moving = false; ///< t may stand in the values
};

/// The shape of the value of an entry.
Shape shape_of(const ResolvedKey& outer, const ResolvedKey& inner)
{
    if (outer.shape.rank == Rank::scalar) return inner.shape;
    if (inner.shape.rank == Rank::scalar) return {Rank::vector, outer.indices.size(), 1};
    return {Rank::matrix, inner.indices.size(), outer.indices.size()};
}

/// Calls take(row, entry, value, where) for every entry of the table that is not a plain 0.
template <class Take>
void read_rows(const ModelReader& reader, const TomlEntry& block, const RowTexts& texts,
               const std::vector<Symbol>& rows, const std::vector<Symbol>& entries, Take take)
{
    const TableReader table(block.value, texts.title);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const TomlEntry& line : block.value.entries) {
        const ResolvedKey outer = require_key(rows, line.key, texts.title, texts.row_noun);
        const std::string title = fmt::format("{} '{}'", texts.row, outer.name);
        const TableReader row(line.value, title);
        for (const TomlEntry& entry : line.value.entries) {
            const ResolvedKey inner = require_key(entries, entry.key, title, texts.entry_noun);
            const std::string what = fmt::format("{} '{}' of '{}'", texts.entry, inner.name, outer.name);
            const Role time = texts.moving ? Role::time : Role::base;
            const ArrayValue closed =
                reader.close_array(read_array_expression(entry.value, what), {Role::parameter, Role::base, time}, what);
            const std::vector<Tree> values = fit_values(closed, shape_of(outer, inner), what, entry.value.where);
            const bool by_columns = outer.shape.rank != Rank::scalar;
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::size_t a = outer.indices[by_columns ? k % outer.indices.size() : 0];
                const std::size_t b = inner.indices[by_columns ? k / outer.indices.size() : k];
                if (!seen.emplace(a, b).second) {
                    throw ModelError(
                        fmt::format("{} '{}' of '{}' is given twice", texts.entry, entries[b].name, rows[a].name),
                        entry.where());
                }
                const bool zero = values[k]->kind == TreeKind::number && values[k]->number == 0;
                if (!zero) take(a, b, values[k], entry.value.where);
            }
        }
    }
}

void read_anchor(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& table, const RowTexts& texts)
{
    TomlEntry rows = table;
    std::erase_if(rows.value.entries, [&](const TomlEntry& line) { return is_rate_line(reader.model, block, line); });
    read_rows(reader, rows, texts, block.fibre, coordinates_of(reader.model, block),
              [&](std::size_t a, std::size_t i, const Tree& value, const SourceRange& where) {
                  block.anchor.push_back(AnchorEntry{a, block.base[i], value, where});
              });
    for (const TomlEntry& line : table.value.entries)
        if (is_rate_line(reader.model, block, line)) read_rate_line(reader, block, line);
}

/// A section that is zero depends on the others: it is named here, before any determinant.
template <class Entry>
void require_every_section(const AlgebroidBlock& block, const std::vector<Entry>& entries, const TomlEntry& table)
{
    for (std::size_t a = 0; a < block.fibre.size(); ++a) {
        if (std::ranges::any_of(entries, [&](const Entry& each) { return each.section == a; })) continue;
        throw ModelError(fmt::format("the section '{}' is zero, or not given", block.fibre[a].name), table.where(),
                         fmt::format("every section stands in '{}', and they are independent", table.name()));
    }
}

void read_sections(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& table, const RowTexts& texts)
{
    read_rows(reader, table, texts, block.fibre, block.of[0].fibre,
              [&](std::size_t a, std::size_t b, const Tree& value, const SourceRange& where) {
                  block.sections.push_back(SectionEntry{a, b, value, where});
              });
    require_every_section(block, block.sections, table);
}

/// A fibre that is too short makes vertical coordinates horizontal ones: the message says how it is read.
void require_vertical(const AlgebroidBlock& block, const TomlEntry& table)
{
    const auto split =
        block.fibre.begin() + static_cast<std::ptrdiff_t>(std::min(block.base.size(), block.fibre.size()));
    const std::vector<Symbol> horizontal(block.fibre.begin(), split);
    for (const TomlEntry& line : table.value.entries) {
        for (const TomlEntry& entry : line.value.entries) {
            if (!resolve_key(horizontal, entry.key.text)) continue;
            throw ModelError(
                fmt::format("the connection along '{}' names '{}', which is no vertical fibre coordinate", line.name(),
                            entry.name()),
                entry.where(),
                fmt::format(
                    "the fibre has first one horizontal coordinate a base coordinate, {}, then the vertical ones, {}",
                    comma_list(declared_names(horizontal)), comma_list(declared_names({split, block.fibre.end()}))));
        }
    }
}

void read_connection(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& table, const RowTexts& texts)
{
    const std::vector<Symbol> vertical(block.fibre.begin() + static_cast<std::ptrdiff_t>(block.base.size()),
                                       block.fibre.end());
    require_vertical(block, table);
    read_rows(reader, table, texts, coordinates_of(reader.model, block), vertical,
              [&](std::size_t i, std::size_t c, const Tree& value, const SourceRange& where) {
                  block.connection.push_back(ConnectionEntry{block.base[i], c + block.base.size(), value, where});
              });
}

std::size_t section_index(const AlgebroidBlock& block, const Excerpt& key, const std::string& owner)
{
    const ResolvedKey found = require_key(block.fibre, key, owner, "fibre coordinate");
    const SourceRange where = key.range(0, key.text.size());
    if (found.shape.rank != Rank::scalar) {
        throw ModelError(
            fmt::format("{} names the family '{}', where one fibre coordinate is required", owner, found.name), where,
            fmt::format("for example \"{}\"", block.fibre[found.indices[0]].name));
    }
    const bool vertical = block.kind != AlgebroidKind::atiyah || found.indices[0] >= block.base.size();
    if (!vertical) {
        throw ModelError(
            fmt::format("{} names the horizontal section '{}', but is that of the vertical ones", owner, found.name),
            where, "the brackets of horizontal sections follow from 'connection'");
    }
    return found.indices[0];
}

void read_bracket(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& entry, const std::string& title)
{
    const TableReader table(entry.value, title);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const TomlEntry& pair : entry.value.entries) {
        const std::vector<Excerpt> names = sides_of(pair.key);
        if (names.size() != 2) {
            throw ModelError(fmt::format("the bracket key '{}' is not a pair of fibre coordinates", pair.name()),
                             pair.where(), "write \"a,b\" = { c = \"..\" } for [e_a, e_b] = .. e_c");
        }
        const std::size_t a = section_index(block, names[0], title);
        const std::size_t b = section_index(block, names[1], title);
        if (!seen.emplace(a, b).second) {
            throw ModelError(fmt::format("the bracket of '{}' and '{}' is given twice", names[0].text, names[1].text),
                             pair.where());
        }
        if (a == b && !pair.value.entries.empty())
            throw ModelError(fmt::format("the bracket of '{}' with itself is given", names[0].text), pair.where(),
                             "[e, e] = 0 for every section; leave it out");
        const std::string owner = fmt::format("the bracket of '{}' and '{}'", names[0].text, names[1].text);
        const TableReader row(pair.value, owner);
        // An empty table says zero, which the other order of the pair must agree with.
        if (pair.value.entries.empty()) block.bracket.push_back(BracketEntry{a, b, a, number(0), pair.value.where});
        for (const TomlEntry& component : pair.value.entries) {
            const std::size_t c = section_index(block, component.key, owner);
            const std::string what = fmt::format("the entry '{}' of {}", component.name(), owner);
            const Tree parsed = read_expression(component.value, what);
            const Tree value = block.kind == AlgebroidKind::general
                                   ? reader.close(parsed, {Role::parameter, Role::base}, what)
                                   : reader.close(parsed, {Role::parameter}, what);
            block.bracket.push_back(BracketEntry{a, b, c, value, component.value.where});
        }
    }
}

} // namespace

void read_entries(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft)
{
    if (draft.kind == nullptr) return; // the file's own reader has read them
    const auto entry = [&](const char* key) { return find_entry(*draft.table, key); };
    const auto title = [&](const char* key) {
        return fmt::format("{}.{}]", draft.title.substr(0, draft.title.size() - 1), key);
    };
    if (const TomlEntry* anchor = entry("anchor"))
        read_anchor(reader, block, *anchor,
                    {title("anchor"), "the anchor of", "the anchor entry", "fibre coordinate", "base coordinate"});
    if (const TomlEntry* spanned_by = entry("spanned_by")) {
        read_anchor(reader, block, *spanned_by,
                    {title("spanned_by"), "the section", "the component", "fibre coordinate", "base coordinate"});
        require_every_section(block, block.anchor, *spanned_by);
    }
    if (const TomlEntry* bracket = entry("bracket")) read_bracket(reader, block, *bracket, title("bracket"));
    if (const TomlEntry* representation = entry("representation")) read_representation(reader, block, *representation);
    if (const TomlEntry* connection = entry("connection"))
        read_connection(reader, block, *connection,
                        {title("connection"), "the connection along", "the connection's component", "base coordinate",
                         "vertical fibre coordinate"});
    if (const TomlEntry* sections = entry("sections"))
        read_sections(reader, block, *sections,
                      {title("sections"), "the section", "the component", "fibre coordinate",
                       "fibre coordinate of the inner algebroid", block.kind == AlgebroidKind::nonholonomic});
    for (std::size_t k = 0; k < draft.of.size(); ++k) read_entries(reader, block.of[k], draft.of[k]);
}

} // namespace lagen
