// SPDX-License-Identifier: GPL-2.0-or-later
/// toml++ behind a wall: the only file that includes it.
#include "model/toml_document.hpp"

#include "model/decode_string.hpp"
#include "model/require_short_keys.hpp"
#include "model/source_positions.hpp"

#ifdef __GNUC__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#endif
#include <toml++/toml.h>
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lagen {

namespace {

/// Walks a toml++ tree (its parser bounds the nesting at 256) and rebuilds it in the order of the file.
class Rebuilder {
  public:
    explicit Rebuilder(std::shared_ptr<const SourceFile> file) : file_(std::move(file)), positions_(file_->text) {}

    [[nodiscard]] SourceRange range(const toml::source_region& region) const
    {
        const std::size_t begin = positions_.byte_of(region.begin.line, region.begin.column);
        const std::size_t end = positions_.byte_of(region.end.line, region.end.column);
        return {file_, begin, std::max(begin, end)};
    }

    [[nodiscard]] TomlValue value(const toml::node& node) const
    {
        TomlValue out;
        out.where = range(node.source());
        if (const auto* text = node.as_string()) {
            out.kind = TomlKind::string;
            out.text = decode_string(file_, out.where.begin, out.where.end, text->get());
        } else if (node.is_number()) {
            number(out, node);
        } else if (const auto* flag = node.as_boolean()) {
            out.kind = TomlKind::boolean;
            out.boolean = flag->get();
        } else if (const auto* list = node.as_array()) {
            out.kind = TomlKind::array;
            for (const toml::node& item : *list) out.items.push_back(value(item));
        } else if (const auto* table = node.as_table()) {
            out.kind = TomlKind::table;
            entries(out, *table);
        } else {
            out.kind = TomlKind::date;
        }
        return out;
    }

  private:
    void number(TomlValue& out, const toml::node& node) const
    {
        out.text = Excerpt{file_, file_->text.substr(out.where.begin, out.where.end - out.where.begin), {}};
        for (std::size_t k = out.where.begin; k <= out.where.end; ++k) out.text.origin.push_back(k);
        if (const auto* whole = node.as_integer()) {
            out.kind = TomlKind::integer;
            out.integer = static_cast<long>(whole->get());
        } else {
            out.kind = TomlKind::decimal;
            out.finite = std::isfinite(node.as_floating_point()->get());
        }
    }

    /// toml++ keeps tables sorted by name; the order of the file comes back from the places of the keys.
    void entries(TomlValue& out, const toml::table& table) const
    {
        for (const auto& [key, node] : table) {
            const SourceRange place = range(key.source());
            out.entries.push_back(
                TomlEntry{decode_string(file_, place.begin, place.end, std::string(key.str())), value(node)});
        }
        std::stable_sort(out.entries.begin(), out.entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
            return a.key.origin.front() < b.key.origin.front();
        });
    }

    std::shared_ptr<const SourceFile> file_;
    SourcePositions positions_;
};

/// toml++ says "Error while parsing array: expected ..."; we say what was expected first.
std::string reworded(std::string_view text)
{
    constexpr std::string_view opening = "Error while parsing ";
    const std::size_t colon = text.find(": ");
    if (!text.starts_with(opening) || colon == std::string_view::npos) return std::string(text);
    return fmt::format("{} (in the {})", text.substr(colon + 2), text.substr(opening.size(), colon - opening.size()));
}

void require_utf8(const std::shared_ptr<const SourceFile>& file)
{
    const std::size_t bad = find_invalid_utf8(file->text);
    if (bad == std::string::npos) return;
    throw ModelError(fmt::format("byte 0x{:02X} is not valid UTF-8 here; a model file must be UTF-8 text",
                                 static_cast<unsigned>(static_cast<unsigned char>(file->text[bad]))),
                     SourceRange{file, bad, bad + 1}, "save the file with the encoding UTF-8");
}

} // namespace

TomlValue parse_toml(const std::shared_ptr<const SourceFile>& file)
{
    require_utf8(file);
    require_short_keys(file);
    try {
        const toml::table table = toml::parse(std::string_view(file->text), std::string_view(file->name));
        return Rebuilder(file).value(table);
    } catch (const toml::parse_error& error) {
        const SourceRange where = Rebuilder(file).range(error.source());
        const bool beyond_ascii = where.begin < file->text.size() && (file->text[where.begin] & 0x80) != 0;
        throw ModelError(fmt::format("the file is not valid TOML: {}", reworded(error.description())), where,
                         beyond_ascii ? "keys with letters beyond a to z stand in quotes, as expressions do: \"θ\" = 1"
                                      : "expressions are quoted strings, and each key stands once: key = "
                                        "\"expression\"");
    }
}

const char* kind_text(TomlKind kind)
{
    switch (kind) {
    case TomlKind::string: return "a string";
    case TomlKind::integer: return "an integer";
    case TomlKind::decimal: return "a decimal number";
    case TomlKind::boolean: return "a boolean";
    case TomlKind::date: return "a date or time";
    case TomlKind::array: return "an array";
    case TomlKind::table: return "a table";
    }
    return "a value";
}

} // namespace lagen
