// SPDX-License-Identifier: GPL-2.0-or-later
/// The kinds of algebroid, the keys that each takes, and the tables and files inside a table.
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"
#include "model/read_values.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

constexpr KindEntry kinds[] = {
    {"general", AlgebroidKind::general, {"anchor", "bracket"}},
    {"tangent", AlgebroidKind::tangent, {"over"}},
    {"lie_algebra", AlgebroidKind::lie_algebra, {"algebra", "bracket"}},
    {"action", AlgebroidKind::action, {"algebra", "bracket", "anchor", "representation"}},
    {"subbundle", AlgebroidKind::subbundle, {"spanned_by"}},
    {"level_set", AlgebroidKind::level_set, {}},
    {"atiyah", AlgebroidKind::atiyah, {"algebra", "bracket", "connection"}},
    {"frame", AlgebroidKind::frame, {"of", "sections"}},
    {"product", AlgebroidKind::product, {"of"}},
    {"prolongation", AlgebroidKind::prolongation, {"of", "bundle"}},
    {"nonholonomic", AlgebroidKind::nonholonomic, {"of", "sections", "drift", "constraints"}},
};

/// Every key of some kind.
constexpr const char* keys_of_kinds[] = {"over",           "algebra",    "anchor",     "bracket",
                                         "representation", "spanned_by", "connection", "of",
                                         "sections",       "bundle",     "drift",      "constraints"};

constexpr std::size_t deepest_nesting = 16;

const KindEntry& read_kind(const TomlEntry* entry, const std::string& title)
{
    if (entry == nullptr) return kinds[0];
    const std::string text = read_text(entry->value, fmt::format("'kind' of {}", title));
    std::vector<std::string> known;
    for (const KindEntry& kind : kinds) {
        if (text == kind.name) return kind;
        known.emplace_back(kind.name);
    }
    throw ModelError(fmt::format("unknown algebroid kind '{}'", text), entry->value.where,
                     hint_for(text, known, "kinds"));
}

void require_fitting(const TomlValue& table, const KindEntry& kind)
{
    for (const TomlEntry& entry : table.entries) {
        const bool of_some_kind = std::ranges::find(keys_of_kinds, entry.name()) != std::end(keys_of_kinds);
        if (of_some_kind && !kind.takes(entry.name())) {
            throw ModelError(fmt::format("an algebroid of kind '{}' takes no '{}'", kind.name, entry.name()),
                             entry.where());
        }
    }
}

/// algebra, or bracket, never both.
void require_algebra(const TomlEntry* algebra, const TomlEntry* bracket, const AlgebroidDraft& draft)
{
    if (!draft.kind->takes("algebra")) return;
    if (algebra != nullptr && bracket != nullptr) {
        throw ModelError(fmt::format("{} gives both 'algebra' and 'bracket'", draft.title), bracket->where(),
                         "keep one of them");
    }
    if (algebra == nullptr && bracket == nullptr) {
        throw ModelError(fmt::format("an algebroid of kind '{}' needs 'algebra' or 'bracket'", draft.kind->name),
                         draft.where,
                         "algebra = \"so(3)\", or [algebroid.bracket] with a line a pair (empty: abelian)");
    }
}

void require_action(const TomlEntry* anchor, const TomlEntry* representation, const AlgebroidDraft& draft)
{
    if (!draft.kind->takes("representation")) return;
    if (anchor == nullptr && representation == nullptr)
        throw ModelError("an algebroid of kind 'action' needs 'anchor' or 'representation'", draft.where,
                         "representation = [\"A_1\", ..], one matrix a section; or [algebroid.anchor]");
    if (anchor == nullptr || representation == nullptr) return;
    throw ModelError(fmt::format("{} gives both 'anchor' and 'representation'", draft.title), representation->where(),
                     "keep one of them");
}

/// "E" or "E*"
bool read_dual(const TomlEntry* bundle)
{
    if (bundle == nullptr) return false;
    const std::string text = read_text(bundle->value, "'bundle'");
    if (text == "E") return false;
    if (text == "E*") return true;
    throw ModelError(fmt::format("the bundle of a prolongation is {}, where \"E\" or \"E*\" is required", quote(text)),
                     bundle->value.where);
}

std::vector<Symbol> read_symbols(const ModelReader& reader, const TomlEntry* entry, const std::string& title)
{
    std::vector<Symbol> out;
    if (entry == nullptr) return out;
    for (const Excerpt& key : read_list(entry->value, fmt::format("'{}' of {}", entry->name(), title))) {
        const DeclaredKey declared = read_declaration(reader, key);
        out.insert(out.end(), declared.symbols.begin(), declared.symbols.end());
    }
    return out;
}

AlgebroidDraft draft_table(ModelReader& reader, const TomlEntry& entry, const std::string& title, std::size_t depth);

AlgebroidDraft draft_file(ModelReader& reader, const TomlValue& of)
{
    AlgebroidDraft draft;
    draft.included = include_model(reader, of);
    const Model& model = reader.included[draft.included].model;
    if (is_nonholonomic(model))
        throw ModelError(fmt::format("the model '{}' is nonholonomic: its constraint is no Lie algebroid", model.name),
                         of.where, "give the ambient algebroid of its file");
    draft.title = model.file->name;
    draft.where = of.where;
    return draft;
}

void draft_inner(ModelReader& reader, AlgebroidDraft& draft, const TomlEntry* of, std::size_t depth)
{
    if (!draft.kind->takes("of")) return;
    const bool product = draft.kind->kind == AlgebroidKind::product;
    if (of == nullptr) {
        throw ModelError(fmt::format("an algebroid of kind '{}' needs 'of'", draft.kind->name), draft.where,
                         product ? "of = [\"a.toml\", \"b.toml\"]" : "of = \"file.toml\", or a table [algebroid.of]");
    }
    if (depth >= deepest_nesting) {
        throw ModelError(fmt::format("algebroids are nested more than {} deep", deepest_nesting), of->where());
    }
    if (!product && of->value.kind == TomlKind::string) {
        draft.of.push_back(draft_file(reader, of->value));
    } else if (!product && of->value.kind == TomlKind::table) {
        draft.of.push_back(draft_table(reader, *of, draft.title.substr(0, draft.title.size() - 1) + ".of]", depth + 1));
    } else if (product && of->value.kind == TomlKind::array && !of->value.items.empty()) {
        for (const TomlValue& item : of->value.items) draft.of.push_back(draft_file(reader, item));
    } else {
        const bool empty = product && of->value.kind == TomlKind::array;
        throw ModelError(fmt::format("'of' of {} is {}, where {} is required", draft.title,
                                     empty ? "an empty array" : kind_text(of->value.kind),
                                     product ? "a list of files" : "the name of a file or a table"),
                         of->value.where);
    }
}

AlgebroidDraft draft_table(ModelReader& reader, const TomlEntry& entry, const std::string& title, std::size_t depth)
{
    const TomlValue& value = entry.value;
    AlgebroidDraft draft;
    draft.table = &value;
    draft.title = title;
    draft.where = entry.where();
    draft.outermost = depth == 0;
    TableReader table(value, title);
    draft.kind = &read_kind(table.take("kind"), title);
    if (depth > 0 && draft.kind->kind == AlgebroidKind::nonholonomic)
        throw ModelError(fmt::format("{} is nonholonomic: its constraint is no Lie algebroid", title), draft.where,
                         "give all constraints in [algebroid]");
    require_fitting(value, *draft.kind);
    for (const char* key : draft.kind->keys)
        if (key != nullptr) (void)table.take(key);
    if (depth > 0) {
        draft.fibre = read_symbols(reader, table.take("fibre"), title);
        draft.momenta = read_symbols(reader, table.take("momenta"), title);
    }
    require_algebra(find_entry(value, "algebra"), find_entry(value, "bracket"), draft);
    require_action(find_entry(value, "anchor"), find_entry(value, "representation"), draft);
    draft.dual = read_dual(find_entry(value, "bundle"));
    const TomlEntry* of = find_entry(value, "of");
    table.finish();
    draft_inner(reader, draft, of, depth);
    return draft;
}

} // namespace

const TomlEntry* find_entry(const TomlValue& table, std::string_view key)
{
    for (const TomlEntry& entry : table.entries)
        if (entry.name() == key) return &entry;
    return nullptr;
}

bool KindEntry::takes(std::string_view key) const
{
    return std::ranges::any_of(keys, [&](const char* each) { return each != nullptr && key == each; });
}

AlgebroidDraft draft_of_groupoid(const TomlEntry& block, GroupoidKind kind)
{
    static constexpr KindEntry computed{"groupoid", AlgebroidKind::groupoid, {}};
    AlgebroidDraft draft;
    draft.table = &block.value;
    draft.title = "[groupoid]";
    draft.where = block.where();
    draft.kind =
        kind == GroupoidKind::pair ? &*std::ranges::find(kinds, AlgebroidKind::tangent, &KindEntry::kind) : &computed;
    draft.outermost = true;
    return draft;
}

AlgebroidDraft draft_of_tangent(const TomlEntry& block)
{
    static const TomlValue empty{};
    AlgebroidDraft draft;
    draft.table = &empty;
    draft.title = "[algebroid]";
    draft.where = block.where();
    draft.kind = &*std::ranges::find(kinds, AlgebroidKind::tangent, &KindEntry::kind);
    draft.outermost = true;
    return draft;
}

AlgebroidDraft draft_algebroid(ModelReader& reader, const TomlEntry& block)
{
    return draft_table(reader, block, "[algebroid]", 0);
}

} // namespace lagen
