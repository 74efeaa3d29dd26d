// SPDX-License-Identifier: GPL-2.0-or-later
/// The format of model files as one table, a row a key: what stands there, which names it may use, what it needs. The
/// shape of a file is checked by it, its readers take roles and titles from it, and `lagen schema` prints it.
#pragma once

#include "model/names.hpp"
#include "model/toml_document.hpp"
#include "text/record.hpp"

#include <span>

namespace lagen {

/// The kinds of value that a key may have.
enum class ValueKind {
    text,       ///< a string without control characters
    word,       ///< one of the row's words
    strings,    ///< an array of strings: names to declare, conditions, columns
    flag,       ///< true or false
    count,      ///< an integer between the row's bounds
    expression, ///< a number, or a string that is one expression
    array,      ///< the same, or an array of them, or an array of such arrays: a vector or a matrix
    matrices,   ///< an array of such values
    times,      ///< an array of expressions
    interval,   ///< two values, lower and upper
    panels,     ///< an array of strings and of arrays of strings
    table,      ///< a table with the keys of the rows below
    line,       ///< such a table, or a value
    file,       ///< such a table, or the name of a file
    algebroid,  ///< a table like [algebroid], the name of a file, or an array of names
    later       ///< part of the format that this version does not read
};

struct SchemaRow {
    std::string_view path; ///< keys with dots between them; * is a name that the file chooses
    ValueKind kind;
    const char* text;       ///< documentation, one line
    const char* title = ""; ///< how messages call it, {0}, {1}, .. the names that the file chose; "": by its key
    Roles roles = {};       ///< what the expression may use
    bool nonsmooth = false; ///< min max sign if are legal
    const char* words = ""; ///< of a word; those after a ':' are how messages call several
    const char* needs =
        ""; ///< keys of a table: "a" must be there, "a|b" one of them, "a/b" at least one, with '?' none will do
    const char* hint = ""; ///< how it is written
    long least = 0,
         most = 0; ///< of a count, and of the entries of an array or table that has `things`; most 0: any number
    const char* things = ""; ///< how messages call the entries: "times"

    constexpr SchemaRow& one_of(const char* all) { return words = all, *this; }
    constexpr SchemaRow& needing(const char* keys) { return needs = keys, *this; }
    constexpr SchemaRow& like(const char* example) { return hint = example, *this; }
    constexpr SchemaRow& any_function() { return nonsmooth = true, *this; }
    constexpr SchemaRow& within(long a, long b) { return least = a, most = b, *this; }
    constexpr SchemaRow& of(const char* entries, long a, long b = 0) { return things = entries, within(a, b); }
};

/// The keys that go with one word of the key `kind` of a block, besides that key.
struct KindRow {
    std::string_view block; ///< "algebroid"
    const char* kind;
    const char* keys;  ///< words
    const char* needs; ///< as of SchemaRow
};

[[nodiscard]] std::span<const SchemaRow> schema_rows();
/// The row of what stands behind `key` ("*": behind a name that the file chooses) in a table; null where there is none.
[[nodiscard]] const SchemaRow* row_below(const SchemaRow& parent, std::string_view key);
/// The keys of some words of `kind`, in the order of the enumerations AlgebroidKind and GroupoidKind.
[[nodiscard]] std::span<const KindRow> kind_rows();

/// The place of a word among those of its block.
[[nodiscard]] std::size_t place_of_kind(std::string_view block, std::string_view kind);

/// Everything that a model names: every role.
inline constexpr Roles any_role = [] {
    Roles all;
    all.bits = ~0U;
    return all;
}();

/// A value of a file with its row.
class Item {
  public:
    Item() = default;
    /// A whole document.
    explicit Item(const TomlEntry& document);

    explicit operator bool() const { return entry_ != nullptr; }
    /// The entry of a table; nothing where there is none, or no table.
    [[nodiscard]] Item at(std::string_view key) const;
    /// The entries of a table, in the order of the file.
    [[nodiscard]] std::vector<Item> items() const;

    [[nodiscard]] const TomlEntry& entry() const { return *entry_; }
    [[nodiscard]] const Excerpt& key() const { return entry_->key; }
    [[nodiscard]] const std::string& name() const { return entry_->key.text; }
    [[nodiscard]] const TomlValue& value() const { return entry_->value; }
    [[nodiscard]] const std::string& text() const { return entry_->value.text.text; }
    /// The strings of an array; none where there is no value.
    [[nodiscard]] std::vector<Excerpt> texts() const;
    [[nodiscard]] bool is(TomlKind kind) const { return entry_ != nullptr && entry_->value.kind == kind; }
    [[nodiscard]] SourceRange where() const { return entry_->where(); }
    [[nodiscard]] const SchemaRow& row() const { return *row_; }
    /// "the anchor of 'w1'", "[base]", "'over' of [algebroid]": how messages call it.
    [[nodiscard]] const std::string& title() const { return title_; }
    /// The same with another name for its last one.
    [[nodiscard]] std::string title_of(const std::string& name) const;

  private:
    [[nodiscard]] Item below(const TomlEntry& entry) const;

    const TomlEntry* entry_ = nullptr;
    const SchemaRow* row_ = nullptr;
    std::string title_;
    std::vector<std::string> names_; ///< that the file chose, from the outermost
};

/// Throws ModelError where the value, or one inside it, is not of the shape that the table asks for: an unknown key, a
/// value of another kind, a key that is missing or stands beside one that it excludes.
void require_shape(const Item& item);

/// JSON Schema 2020-12 of model files and morphism files, and its text.
[[nodiscard]] Record json_schema();
[[nodiscard]] std::string json_schema_text();

} // namespace lagen
