// SPDX-License-Identifier: GPL-2.0-or-later
/// A TOML text as a tree of our own: entries in the order of the file, every key and value with its bytes in the file,
/// strings as excerpts that know where each of their bytes came from, and numbers still as text.
#pragma once

#include "text/diagnostic.hpp"

#include <string>
#include <vector>

namespace lagen {

enum class TomlKind { string, integer, decimal, boolean, date, array, table };

/// The place of a text in its file.
[[nodiscard]] inline SourceRange place_of(const Excerpt& text)
{
    return text.range(0, text.text.size());
}

struct TomlEntry;

struct TomlValue {
    TomlKind kind = TomlKind::table;
    SourceRange where;
    Excerpt text;                   ///< string: its content; integer, decimal: the literal as written
    long integer = 0;               ///< of `integer`
    bool boolean = false;           ///< of `boolean`
    bool finite = true;             ///< of `decimal`: neither inf nor nan
    std::vector<TomlValue> items;   ///< of `array`
    std::vector<TomlEntry> entries; ///< of `table`, in the order of the file
};

struct TomlEntry {
    Excerpt key;
    TomlValue value;

    [[nodiscard]] const std::string& name() const { return key.text; }
    [[nodiscard]] SourceRange where() const { return place_of(key); }
};

/// Parses TOML 1.0. Throws ModelError for invalid UTF-8, forbidden control characters, syntax errors, duplicate keys
/// and numbers beyond 64 bits, each at its place.
[[nodiscard]] TomlValue parse_toml(const std::shared_ptr<const SourceFile>& file);

/// "a string", "a boolean", ...: how messages call a value.
[[nodiscard]] const char* kind_text(TomlKind kind);

} // namespace lagen
