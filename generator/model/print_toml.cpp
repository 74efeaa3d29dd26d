// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/print_toml.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += fmt::format("\\{}", c);
        else if (c == '\n')
            out += "\\n";
        else if (c == '\t')
            out += "\\t";
        else if (code < 0x20 || code == 0x7f)
            out += fmt::format("\\u{:04x}", code);
        else
            out += c;
    }
    return out + "\"";
}

std::string key_text(const std::string& key)
{
    const auto is_bare = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    };
    return !key.empty() && std::ranges::all_of(key, is_bare) ? key : quoted(key);
}

std::string inline_text(const TomlValue& value)
{
    std::vector<std::string> parts;
    switch (value.kind) {
    case TomlKind::string: return quoted(value.text.text);
    case TomlKind::boolean: return value.boolean ? "true" : "false";
    case TomlKind::array:
        for (const TomlValue& item : value.items) parts.push_back(inline_text(item));
        return fmt::format("[{}]", fmt::join(parts, ", "));
    case TomlKind::table:
        for (const TomlEntry& entry : value.entries)
            parts.push_back(fmt::format("{} = {}", key_text(entry.name()), inline_text(entry.value)));
        return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
    case TomlKind::integer:
    case TomlKind::decimal:
    case TomlKind::date: break;
    }
    return value.text.text;
}

bool is_of_tables(const TomlValue& value)
{
    return value.kind == TomlKind::table && !value.entries.empty() &&
           std::ranges::all_of(value.entries, [](const TomlEntry& e) { return e.value.kind == TomlKind::table; });
}

void print_table(const TomlEntry& table, const std::string& title, std::string& text)
{
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", title);
    for (const TomlEntry& entry : table.value.entries)
        text += fmt::format("{} = {}\n", key_text(entry.name()), inline_text(entry.value));
}

} // namespace

std::string print_toml(const TomlValue& document)
{
    std::string text;
    for (const TomlEntry& entry : document.entries)
        if (entry.value.kind != TomlKind::table)
            text += fmt::format("{} = {}\n", key_text(entry.name()), inline_text(entry.value));
    for (const TomlEntry& entry : document.entries) {
        if (entry.value.kind != TomlKind::table) continue;
        if (entry.name() == "scene" && is_of_tables(entry.value))
            for (const TomlEntry& scene : entry.value.entries)
                print_table(scene, "scene." + key_text(scene.name()), text);
        else
            print_table(entry, key_text(entry.name()), text);
    }
    return text;
}

TomlValue toml_string(const std::string& text)
{
    TomlValue value;
    value.kind = TomlKind::string;
    value.text.text = text;
    return value;
}

TomlEntry toml_entry(const std::string& key, TomlValue value)
{
    TomlEntry entry;
    entry.key.text = key;
    entry.value = std::move(value);
    return entry;
}

TomlValue& entry_in(TomlValue& table, const std::string& key)
{
    const auto found = std::ranges::find(table.entries, key, &TomlEntry::name);
    if (found != table.entries.end()) return found->value;
    table.entries.push_back(toml_entry(key, {}));
    return table.entries.back().value;
}

} // namespace lagen
