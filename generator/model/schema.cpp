// SPDX-License-Identifier: GPL-2.0-or-later
/// The table of the format judges the shape of a file, and is printed as JSON Schema 2020-12, which knows no names of a
/// model, and no sizes.
#include "model/schema.hpp"

#include "model/complaints.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace lagen {

namespace {

/// The texts between blanks.
std::vector<std::string> words_of(std::string_view words)
{
    std::vector<std::string> out;
    std::istringstream in{std::string(words)};
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

/// Keys of which `needs` of a table wants one, or forbids several.
struct Need {
    std::vector<std::string> keys;
    bool optional;  ///< none will do
    bool inclusive; ///< several will do
};

std::vector<Need> needs_of(const char* needs)
{
    std::vector<Need> out;
    for (std::string keys : words_of(needs)) {
        const bool optional = keys.ends_with('?'), inclusive = keys.find('/') != std::string::npos;
        if (optional) keys.pop_back();
        std::ranges::replace_if(
            keys, [](char c) { return c == '|' || c == '/'; }, ' ');
        out.push_back({words_of(keys), optional, inclusive});
    }
    return out;
}

/// The words of a row, and how messages call several.
struct KnownWords {
    std::vector<std::string> words;
    std::string noun;
};

KnownWords words_for(const SchemaRow& row)
{
    const std::string_view words = row.words;
    const std::size_t colon = words.find(" :");
    if (colon != std::string_view::npos)
        return {words_of(words.substr(0, colon)), std::string(words.substr(colon + 2))};
    KnownWords kinds{{}, "kinds"};
    for (const KindRow& each : kind_rows())
        if (row.path.starts_with(each.block)) kinds.words.emplace_back(each.kind);
    return kinds;
}

/// The keys of a table, names that the file chooses apart.
std::vector<std::string> keys_below(const SchemaRow& parent)
{
    std::vector<std::string> keys;
    const auto append = [&](std::string_view above) {
        for (const SchemaRow& each : schema_rows()) {
            if (each.path.empty() || (!above.empty() && !each.path.starts_with(std::string(above) + "."))) continue;
            const std::string key(each.path.substr(above.empty() ? 0 : above.size() + 1));
            if (key.find('.') == std::string::npos && key != "*") keys.push_back(key);
        }
    };
    if (parent.kind == ValueKind::algebroid) append("algebroid");
    append(parent.path);
    return keys;
}

const SchemaRow* schema_row(std::string_view path)
{
    static const auto index = [] {
        std::map<std::string_view, const SchemaRow*> all;
        for (const SchemaRow& each : schema_rows()) all.emplace(each.path, &each);
        return all;
    }();
    const auto found = index.find(path);
    return found == index.end() ? nullptr : found->second;
}

/// The row of the word that `kind` of a block is; null for blocks without kinds.
const KindRow* kind_of(const Item& block)
{
    if (row_below(block.row(), "kind") == nullptr) return nullptr;
    const std::string_view path = block.row().path == "algebroid.of" ? "algebroid" : block.row().path;
    const Item kind = block.at("kind");
    const auto is_it = [&](const KindRow& each) { return each.block == path && (!kind || kind.text() == each.kind); };
    const auto found = std::ranges::find_if(kind_rows(), is_it);
    return found == kind_rows().end() ? nullptr : &*found;
}

/// Throws ModelError unless the keys that `needs` names are there.
void require_needs(const Item& block, const std::string& owner, const char* needs)
{
    for (const Need& need : needs_of(needs)) {
        Item found;
        std::string hint;
        for (const std::string& key : need.keys) {
            const char* example = row_below(block.row(), key)->hint;
            if (*example != '\0') hint += (hint.empty() ? "" : ", or ") + std::string(example);
            const Item item = block.at(key);
            if (item && found && !need.inclusive) throw complain::both(owner, found.name(), key, item.where());
            if (item) found = item;
        }
        if (!found && !need.optional) throw complain::missing(owner, need.keys, block.where(), hint);
    }
}

void require_keys(const Item& block)
{
    const bool names_any = row_below(block.row(), "*") != nullptr;
    for (const TomlEntry& entry : block.value().entries)
        if (row_below(block.row(), entry.name()) == nullptr && !names_any)
            throw complain::unknown_key(entry.name(), block.title(), entry.where(), keys_below(block.row()));
    require_needs(block, block.title(), block.row().needs);
    if (const Item kind = block.at("kind"); kind && row_below(block.row(), "kind") != nullptr) require_shape(kind);
    const KindRow* kind = kind_of(block);
    if (kind == nullptr) return;
    const std::string owner = fmt::format("{} of kind '{}'", block.title(), kind->kind);
    const std::vector<std::string> keys = words_of(kind->keys);
    for (const TomlEntry& entry : block.value().entries)
        if (entry.name() != "kind" && entry.name() != "fibre" && entry.name() != "momenta" &&
            std::ranges::find(keys, entry.name()) == keys.end())
            throw complain::takes_no(owner, entry.name(), entry.where());
    require_needs(block, owner, kind->needs);
}

/// How a sentence calls a value of a kind, and the values of TOML that stand for it; in the order of the enumeration.
struct WrittenAs {
    const char* wanted;
    std::vector<TomlKind> kinds;
};

const WrittenAs& written_as(ValueKind kind)
{
    using enum TomlKind;
    static const WrittenAs all[] = {
        {"a string", {string}},
        {"a string", {string}},
        {"an array of strings", {array}},
        {"true or false", {boolean}},
        {"an integer", {integer}},
        {"a number or an expression string", {integer, decimal, string}},
        {"a number or an expression string", {integer, decimal, string, array}},
        {"a list of matrices", {array}},
        {"an array of times", {array}},
        {"an array of a lower and an upper bound", {array}},
        {"an array of strings", {array}},
        {"a table", {table}},
        {"a table or an expression", {integer, decimal, string, array, table}},
        {"a table or the name of a file", {string, table}},
        {"a table, the name of a file or a list of files", {string, array, table}},
        {"", {string, integer, decimal, boolean, date, array, table}},
    };
    static_assert(std::size(all) == static_cast<std::size_t>(ValueKind::later) + 1);
    return all[static_cast<std::size_t>(kind)];
}

bool fits(ValueKind wanted, TomlKind kind)
{
    const std::vector<TomlKind>& kinds = written_as(wanted).kinds;
    return std::ranges::find(kinds, kind) != kinds.end();
}

[[noreturn]] void refuse_kind(const Item& item, const TomlValue& value, const std::string& what, ValueKind wanted)
{
    using enum ValueKind;
    const bool listed = wanted == strings || wanted == panels;
    const char* hint = *item.row().hint != '\0' ? item.row().hint
                       : listed                 ? "one entry is written [\"..\"], several [\"..\", \"..\"]"
                                                : "";
    const std::string found =
        value.kind == TomlKind::array && value.items.empty() ? "an empty array" : kind_text(value.kind);
    throw complain::is_not(what, found, written_as(wanted).wanted, value.where, hint);
}

/// The entries of an array: strings, expressions, or what a vector or matrix has.
void require_entries(const Item& item, const TomlValue& value, ValueKind wanted)
{
    using enum ValueKind;
    const std::string what = "an entry of " + item.title();
    for (const TomlValue& each : value.items) {
        const bool row_of_matrix = (wanted == array || wanted == panels) && each.kind == TomlKind::array;
        if (row_of_matrix)
            require_entries(item, each, wanted == array ? expression : strings);
        else if (wanted == matrices || wanted == interval ? each.kind == TomlKind::array : false)
            require_entries(item, each, array);
        else if (const ValueKind entry = wanted == strings || wanted == panels ? text : expression;
                 !fits(entry, each.kind))
            refuse_kind(item, each, what, entry);
    }
}

/// Throws ModelError unless an array or table has as many entries as its row says.
void require_count(const Item& item)
{
    const SchemaRow& row = item.row();
    const TomlValue& value = item.value();
    const std::size_t count = value.items.size() + value.entries.size();
    const auto least = static_cast<std::size_t>(row.least), most = static_cast<std::size_t>(row.most);
    if (*row.things == '\0' || (count >= least && (most == 0 || count <= most))) return;
    if (least != most && count >= least) throw complain::too_many(item.title(), count, row.things, most, value.where);
    throw complain::is_not(item.title(), count == 0 ? "an empty array" : fmt::format("an array of {}", count),
                           fmt::format("an array of {}{} {}", least, least == most ? "" : " or more", row.things),
                           value.where, row.hint);
}

Record reference(const char* name)
{
    return {{"$ref", fmt::format("#/$defs/{}", name)}};
}

Record typed(const char* type)
{
    return {{"type", type}};
}

Record any_of(std::initializer_list<Record> schemas)
{
    Record list = Record::array();
    for (const Record& each : schemas) list.push_back(each);
    return {{"anyOf", list}};
}

Record list_with(const Record& items)
{
    return {{"type", "array"}, {"items", items}};
}

Record requires_all(const std::vector<std::string>& keys)
{
    return {{"required", keys}};
}

/// The conditions that `needs` of a table says.
void append_needs(Record& conditions, const char* needs)
{
    for (const auto& [keys, optional, inclusive] : needs_of(needs)) {
        if (keys.size() == 1)
            conditions.push_back(requires_all(keys));
        else if (!optional)
            conditions.push_back({{inclusive ? "anyOf" : "oneOf",
                                   list_of(keys, [](const std::string& key) { return requires_all({key}); })}});
        for (std::size_t a = 0; optional && a < keys.size(); ++a)
            for (std::size_t b = a + 1; b < keys.size(); ++b)
                conditions.push_back({{"not", requires_all({keys[a], keys[b]})}});
    }
}

/// The conditions of each word of `kind`; the first word stands where there is none in [algebroid].
void append_kinds(Record& conditions, std::string_view block)
{
    bool first = block == "algebroid";
    for (const KindRow& row : kind_rows()) {
        if (row.block != block) continue;
        Record condition{{"properties", {{"kind", {{"const", row.kind}}}}}};
        if (!first) condition["required"] = {"kind"};
        first = false;
        std::vector<std::string> keys = words_of(row.keys);
        for (const char* each : {"kind", "fibre", "momenta"}) keys.emplace_back(each);
        Record needs = Record::array();
        append_needs(needs, row.needs);
        Record then{{"propertyNames", {{"enum", keys}}}};
        add_unless_empty(then, "allOf", needs);
        conditions.push_back({{"if", condition}, {"then", then}});
    }
}

Record schema_of(const SchemaRow& row);

Record table_of(const SchemaRow& row)
{
    Record properties = Record::object();
    for (const std::string& key : keys_below(row)) properties[key] = schema_of(*row_below(row, key));
    Record schema{{"type", "object"}};
    add_unless_empty(schema, "properties", properties);
    const SchemaRow* any = row_below(row, "*");
    schema["additionalProperties"] = any == nullptr ? Record(false) : schema_of(*any);
    Record conditions = Record::array();
    append_needs(conditions, row.needs);
    append_kinds(conditions, row.path == "algebroid.of" ? "algebroid" : row.path);
    add_unless_empty(schema, "allOf", conditions);
    return schema;
}

Record shape_of(const SchemaRow& row)
{
    switch (row.kind) {
    case ValueKind::text: return typed("string");
    case ValueKind::word: return {{"enum", words_for(row).words}};
    case ValueKind::strings: return reference("strings");
    case ValueKind::flag: return typed("boolean");
    case ValueKind::count: return {{"type", "integer"}, {"minimum", row.least}, {"maximum", row.most}};
    case ValueKind::expression: return reference("expression");
    case ValueKind::array: return reference("array");
    case ValueKind::matrices:
    case ValueKind::interval: return list_with(reference("array"));
    case ValueKind::times: return list_with(reference("expression"));
    case ValueKind::panels: return list_with(any_of({typed("string"), reference("strings")}));
    case ValueKind::table: return table_of(row);
    case ValueKind::line: return any_of({table_of(row), reference("array")});
    case ValueKind::file: return any_of({table_of(row), typed("string")});
    case ValueKind::algebroid: return any_of({reference("algebroid"), typed("string"), reference("strings")});
    case ValueKind::later: return Record::object();
    }
    return Record::object();
}

/// With its documentation, and the names that an expression may use.
Record schema_of(const SchemaRow& row)
{
    std::string text = row.text;
    if (row.roles == any_role) {
        text += "; may use every name of the model";
    } else if (row.roles != Roles()) {
        std::vector<std::string> names;
        for (Role role = Role::time; role < Role::built_in; role = static_cast<Role>(static_cast<int>(role) + 1))
            if (row.roles.has(role)) names.push_back(role_plural(role));
        text += "; may use " + comma_list(names);
    }
    Record schema{{"description", text}};
    schema.update(shape_of(row));
    if (*row.things == '\0') return schema;
    const bool is_table = row.kind == ValueKind::table;
    if (row.least > 0) schema[is_table ? "minProperties" : "minItems"] = row.least;
    if (row.most > 0) schema[is_table ? "maxProperties" : "maxItems"] = row.most;
    return schema;
}

} // namespace

std::size_t place_of_kind(std::string_view block, std::string_view kind)
{
    std::size_t place = 0;
    for (const KindRow& row : kind_rows()) {
        if (row.block == block && row.kind == kind) break;
        if (row.block == block) ++place;
    }
    return place;
}

const SchemaRow* row_below(const SchemaRow& parent, std::string_view key)
{
    const auto path = [&](std::string_view above) {
        return above.empty() ? std::string(key) : fmt::format("{}.{}", above, key);
    };
    const SchemaRow* found = schema_row(path(parent.path));
    const bool inner = parent.kind == ValueKind::algebroid; // its keys are those of [algebroid]
    return found != nullptr || !inner ? found : schema_row(path("algebroid"));
}

Item::Item(const TomlEntry& document) : entry_(&document), row_(schema_row("")), title_(row_->title) {}

std::string Item::title_of(const std::string& name) const
{
    std::vector<std::string> names = names_;
    names.resize(3);
    if (!names_.empty()) names[names_.size() - 1] = name;
    return fmt::format(fmt::runtime(row_->title), names[0], names[1], names[2]);
}

Item Item::below(const TomlEntry& entry) const
{
    Item item;
    item.names_ = names_;
    item.row_ = row_below(*row_, entry.name());
    if (item.row_ == nullptr) {
        item.row_ = row_below(*row_, "*");
        item.names_.push_back(entry.name());
    }
    if (item.row_ == nullptr) return {};
    item.entry_ = &entry;
    const bool is_block = entry.value.kind == TomlKind::table && title_.ends_with(']');
    item.title_ = *item.row_->title != '\0' ? item.title_of(item.names_.empty() ? "" : item.names_.back())
                  : row_->path.empty()      ? fmt::format("[{}]", entry.name())
                  : is_block                ? fmt::format("{}.{}]", title_.substr(0, title_.size() - 1), entry.name())
                                            : fmt::format("'{}' of {}", entry.name(), title_);
    return item;
}

Item Item::at(std::string_view key) const
{
    if (!is(TomlKind::table)) return {};
    const auto found = std::ranges::find(entry_->value.entries, key, &TomlEntry::name);
    return found == entry_->value.entries.end() ? Item() : below(*found);
}

std::vector<Item> Item::items() const
{
    std::vector<Item> out;
    if (is(TomlKind::table))
        for (const TomlEntry& each : entry_->value.entries) out.push_back(below(each));
    return out;
}

std::vector<Excerpt> Item::texts() const
{
    std::vector<Excerpt> out;
    if (entry_ != nullptr)
        for (const TomlValue& each : entry_->value.items) out.push_back(each.text);
    return out;
}

void require_shape(const Item& item)
{
    using enum ValueKind;
    const TomlValue& value = item.value();
    const ValueKind kind = item.row().kind;
    if (!fits(kind, value.kind)) refuse_kind(item, value, item.title(), kind);
    require_count(item);
    if (kind == later)
        throw ModelError(
            fmt::format("{} belongs to the model format, but this version of lagen does not read it", item.title()),
            item.where());
    const bool names_file = kind == file || kind == ValueKind::algebroid;
    if (value.kind == TomlKind::array) require_entries(item, value, names_file ? strings : kind);
    if (kind == text || kind == word || (names_file && value.kind == TomlKind::string))
        require_printable(value.text, item.title());
    for (const TomlValue& each : value.items)
        if (names_file) require_printable(each.text, "an entry of " + item.title());
    if (kind == word)
        if (const KnownWords words = words_for(item.row());
            std::ranges::find(words.words, item.text()) == words.words.end())
            throw complain::unknown_word(item.title(), item.text(), value.where, words.words, words.noun.c_str());
    if (kind == count && (value.integer < item.row().least || value.integer > item.row().most))
        throw complain::is_not(item.title(), value.integer,
                               fmt::format("an integer from {} to {}", item.row().least, item.row().most), value.where);
    if (value.kind != TomlKind::table) return;
    require_keys(item);
    for (const Item& each : item.items()) require_shape(each);
}

Record json_schema()
{
    const SchemaRow& root = schema_rows().front();
    const Record number_or_text{{"type", {"number", "string"}}};
    Record schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                  {"title", "lagen model"},
                  {"description", root.text}};
    schema.update(table_of(root));
    Record& definitions = schema["$defs"];
    definitions["expression"] = number_or_text;
    definitions["array"] = any_of({number_or_text, list_with(any_of({number_or_text, list_with(number_or_text)}))});
    definitions["strings"] = list_with(typed("string"));
    for (const SchemaRow& row : schema_rows())
        if (row.kind == ValueKind::algebroid) definitions["algebroid"] = table_of(row);
    return schema;
}

std::string json_schema_text()
{
    return json_schema().dump(2) + "\n";
}

} // namespace lagen
