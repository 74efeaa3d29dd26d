// SPDX-License-Identifier: GPL-2.0-or-later
/// The [algebroid] block: its kind first (the fibre's default names depend on it), its anchor and bracket later.
#include "model/model_reader.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

struct KindEntry {
    const char* name;
    AlgebroidKind kind;
    bool over, algebra, anchor, bracket; ///< the keys that it takes
};

constexpr KindEntry kinds[] = {
    {"general", AlgebroidKind::general, false, false, true, true},
    {"tangent", AlgebroidKind::tangent, true, false, false, false},
    {"lie_algebra", AlgebroidKind::lie_algebra, false, true, false, true},
    {"action", AlgebroidKind::action, false, true, true, true},
};
constexpr const char* later_kinds[] = {"subbundle", "atiyah", "frame", "product", "prolongation"};

const KindEntry& read_kind(const TomlEntry* entry)
{
    if (entry == nullptr) return kinds[0];
    const std::string text = read_text(entry->value, "'kind' of [algebroid]");
    std::vector<std::string> known;
    for (const KindEntry& kind : kinds) {
        if (text == kind.name) return kind;
        known.emplace_back(kind.name);
    }
    for (const char* kind : later_kinds) {
        if (text != kind) continue;
        throw ModelError(
            fmt::format("the algebroid kind '{}' belongs to the model format, but this version of lagen does not "
                        "read it",
                        text),
            entry->value.where, "any algebroid can be given outright: kind = \"general\"");
    }
    throw ModelError(fmt::format("unknown algebroid kind '{}'", text), entry->value.where,
                     hint_for(text, known, "kinds"));
}

void require_fitting(const TomlEntry* entry, bool fits, const KindEntry& kind)
{
    if (entry == nullptr || fits) return;
    throw ModelError(fmt::format("an algebroid of kind '{}' takes no '{}'", kind.name, entry->name()), entry->where());
}

std::vector<std::size_t> read_over(const ModelReader& reader, const TomlEntry* entry)
{
    const std::vector<Symbol>& coordinates = reader.model.base.coordinates;
    std::vector<std::size_t> out;
    if (entry == nullptr) {
        for (std::size_t i = 0; i < coordinates.size(); ++i) out.push_back(i);
        return out;
    }
    for (const Excerpt& name : read_list(entry->value, "'over' of [algebroid]")) {
        const std::size_t i = index_of(coordinates, name.text);
        const SourceRange where = name.range(0, name.text.size());
        if (i == coordinates.size()) {
            throw ModelError(fmt::format("'over' names '{}', which is no base coordinate", name.text), where,
                             hint_for(name.text, names_of(coordinates), "base coordinates"));
        }
        if (std::find(out.begin(), out.end(), i) != out.end()) {
            throw ModelError(fmt::format("'over' names '{}' twice", name.text), where);
        }
        out.push_back(i);
    }
    return out;
}

std::size_t section_index(const ModelReader& reader, const Excerpt& name, const char* block)
{
    const std::vector<Symbol>& fibre = reader.model.fibre.coordinates;
    const std::size_t a = index_of(fibre, name.text);
    if (a < fibre.size()) return a;
    throw ModelError(fmt::format("{} names '{}', which is no fibre coordinate", block, name.text),
                     name.range(0, name.text.size()), hint_for(name.text, names_of(fibre), "fibre coordinates"));
}

void read_anchor(ModelReader& reader, const TomlEntry& block)
{
    const TableReader table(block.value, "[algebroid.anchor]");
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    for (const TomlEntry& section : block.value.entries) {
        const std::size_t a = section_index(reader, section.key, "[algebroid.anchor]");
        const TableReader row(section.value, fmt::format("the anchor of '{}'", section.name()));
        for (const TomlEntry& entry : section.value.entries) {
            const std::size_t i = index_of(base, entry.name());
            if (i == base.size()) {
                throw ModelError(fmt::format("the anchor of '{}' names '{}', which is no base coordinate",
                                             section.name(), entry.name()),
                                 entry.where(), hint_for(entry.name(), names_of(base), "base coordinates"));
            }
            const std::string what = fmt::format("the anchor entry '{}' of '{}'", entry.name(), section.name());
            const Tree value = reader.close(read_expression(entry.value, what), {Role::parameter, Role::base}, what);
            reader.model.algebroid.anchor.push_back(AnchorEntry{a, i, value, entry.value.where});
        }
    }
}

void read_bracket(ModelReader& reader, const TomlEntry& block)
{
    const TableReader table(block.value, "[algebroid.bracket]");
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const TomlEntry& pair : block.value.entries) {
        const std::vector<Excerpt> names = split_at_commas(pair.key);
        if (names.size() != 2) {
            throw ModelError(fmt::format("the bracket key '{}' is not a pair of fibre coordinates", pair.name()),
                             pair.where(), "write \"a,b\" = { c = \"..\" } for [e_a, e_b] = .. e_c");
        }
        const std::size_t a = section_index(reader, names[0], "[algebroid.bracket]");
        const std::size_t b = section_index(reader, names[1], "[algebroid.bracket]");
        if (!seen.emplace(a, b).second) {
            throw ModelError(fmt::format("the bracket of '{}' and '{}' is given twice", names[0].text, names[1].text),
                             pair.where());
        }
        const std::string title = fmt::format("the bracket of '{}' and '{}'", names[0].text, names[1].text);
        const TableReader row(pair.value, title);
        for (const TomlEntry& entry : pair.value.entries) {
            const std::size_t c = section_index(reader, entry.key, title.c_str());
            const std::string what = fmt::format("the entry '{}' of {}", entry.name(), title);
            const Tree parsed = read_expression(entry.value, what);
            const Tree value = reader.model.algebroid.kind == AlgebroidKind::general
                                   ? reader.close(parsed, {Role::parameter, Role::base}, what)
                                   : reader.close(parsed, {Role::parameter}, what);
            reader.model.algebroid.bracket.push_back(BracketEntry{a, b, c, value, entry.value.where});
        }
    }
}

} // namespace

void read_algebroid_kind(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) {
        throw ModelError("the model has no [algebroid] block", SourceRange{reader.model.file, 0, 0},
                         "for an ordinary mechanical system: [algebroid] kind = \"tangent\"");
    }
    AlgebroidBlock& out = reader.model.algebroid;
    out.where = block->where();
    TableReader table(block->value, "[algebroid]");
    const KindEntry& kind = read_kind(table.take("kind"));
    table.refuse_later({"representation", "spanned_by", "connection", "of", "sections", "bundle"});
    const TomlEntry* over = table.take("over");
    const TomlEntry* algebra = table.take("algebra");
    const TomlEntry* anchor = table.take("anchor");
    const TomlEntry* bracket = table.take("bracket");
    table.finish();
    require_fitting(over, kind.over, kind);
    require_fitting(algebra, kind.algebra, kind);
    require_fitting(anchor, kind.anchor, kind);
    require_fitting(bracket, kind.bracket, kind);
    out.kind = kind.kind;
    if (kind.over) out.over = read_over(reader, over);
    if (algebra != nullptr) {
        out.algebra = read_text(algebra->value, "'algebra' of [algebroid]");
        out.algebra_where = algebra->value.where;
    }
    if (!kind.algebra) return;
    if (algebra != nullptr && bracket != nullptr) {
        throw ModelError("[algebroid] gives both 'algebra' and 'bracket'", bracket->where(), "keep one of them");
    }
    if (algebra == nullptr && bracket == nullptr) {
        throw ModelError(fmt::format("an algebroid of kind '{}' needs 'algebra' or 'bracket'", kind.name),
                         block->where(),
                         "algebra = \"so(3)\", or [algebroid.bracket] with a line a pair (empty: abelian)");
    }
}

void read_algebroid(ModelReader& reader, const TomlEntry* block)
{
    TableReader table(block->value, "[algebroid]");
    if (const TomlEntry* anchor = table.take("anchor")) read_anchor(reader, *anchor);
    if (const TomlEntry* bracket = table.take("bracket")) read_bracket(reader, *bracket);
}

} // namespace lagen
