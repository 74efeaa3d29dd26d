// SPDX-License-Identifier: GPL-2.0-or-later
/// toml++ behind a wall: the only file that includes it.
#include "model/toml_document.hpp"

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
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace lagen {

namespace {

constexpr std::size_t milestone = 64;

/// From (line, column in code points), as a TOML parser counts, to bytes of the file.
class SourcePositions {
  public:
    /// `text` must outlive this object.
    explicit SourcePositions(std::string_view text) : text_(text)
    {
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        std::size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
        lines_.push_back({at, 0});
        for (std::size_t character = 0; at < text.size(); ++character) {
            if (character % milestone == 0) milestones_.push_back(at);
            const bool ends_line = text[at] == '\n';
            at += std::max<std::size_t>(1, decode_utf8(text, at).length);
            if (ends_line) lines_.push_back({at, character + 1});
        }
    }

    /// The byte where the character at `line`, `column` (both from 1) starts; past the end of a line its end, past the
    /// end of the text the text's end.
    [[nodiscard]] std::size_t byte_of(std::size_t line, std::size_t column) const;

  private:
    struct Line {
        std::size_t byte;      ///< where it starts
        std::size_t character; ///< how many characters of the text stand before it
    };
    std::string_view text_;
    std::vector<Line> lines_;
    std::vector<std::size_t> milestones_; ///< bytes of every 64th character: long lines cost no more than short ones
};

std::size_t SourcePositions::byte_of(std::size_t line, std::size_t column) const
{
    if (line == 0) return 0;
    if (line > lines_.size()) return text_.size();
    const std::size_t line_end = line < lines_.size() ? lines_[line].byte - 1 : text_.size();
    const std::size_t character = lines_[line - 1].character + std::max<std::size_t>(1, column) - 1;
    if (character / milestone >= milestones_.size()) return line_end;
    std::size_t at = milestones_[character / milestone];
    for (std::size_t k = 0; k < character % milestone && at < line_end; ++k)
        at += std::max<std::size_t>(1, decode_utf8(text_, at).length);
    return std::min(at, line_end);
}

/// The byte that each byte of `value` came from, as bytes [begin, end) of the text say it, as far as the two agree.
std::vector<std::size_t> origins_of(std::string_view value, std::string_view text, std::size_t begin, std::size_t end,
                                    bool escapes)
{
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<std::size_t> origins;
    for (std::size_t at = begin; at < end && origins.size() < value.size();) {
        const char next = text[std::min(at + 1, end - 1)];
        if (!escapes || text[at] != '\\') {
            if (text[at] != value[origins.size()]) break;
            origins.push_back(at++);
        } else if (blanks.find(next) != std::string_view::npos) { // at the end of a line: the blanks behind it go
            at = std::min(text.find_first_not_of(blanks, at + 1), end);
        } else {
            const bool by_number = next == 'u' || next == 'U';
            origins.insert(origins.end(), by_number ? decode_utf8(value, origins.size()).length : 1, at);
            at += next == 'u' ? 6 : next == 'U' ? 10 : 2;
        }
    }
    return origins;
}

/// The excerpt of `value`, which the TOML parser read in the literal (basic, literal, multi-line of either, or a bare
/// key) from byte `begin` of the file to before `end`. Where the literal does not say that (it always should), every
/// byte is said to come from `begin`, so that positions are coarse.
Excerpt decode_string(const std::shared_ptr<const SourceFile>& file, std::size_t begin, std::size_t end,
                      const std::string& value)
{
    const std::string_view literal = std::string_view(file->text).substr(begin, end - begin);
    std::size_t quotes = 0;
    bool escapes = false;
    for (const std::string_view quote : {"\"\"\"", "'''", "\"", "'"}) {
        if (literal.size() < 2 * quote.size() || !literal.starts_with(quote) || !literal.ends_with(quote)) continue;
        quotes = quote.size();
        escapes = quote.front() == '"';
        break;
    }
    std::size_t first = begin + quotes;
    if (quotes == 3 && literal.substr(3).starts_with("\r\n")) first += 2;
    if (quotes == 3 && literal.substr(3).starts_with("\n")) first += 1;
    Excerpt out{file, value, origins_of(value, file->text, first, end - quotes, escapes)};
    if (out.origin.size() == value.size())
        out.origin.push_back(end - quotes);
    else
        out.origin.assign(value.size() + 1, begin);
    return out;
}

constexpr std::size_t most_parts = 64;

/// The end of the string or comment that begins at `k`, or `k` where none does.
std::size_t end_of_text(std::string_view text, std::size_t k)
{
    if (text[k] == '#') return std::min(text.find('\n', k), text.size());
    if (text[k] != '"' && text[k] != '\'') return k;
    const char quote = text[k];
    const std::string three(3, quote);
    const bool long_string = text.substr(k, 3) == three;
    std::size_t at = k + (long_string ? 3 : 1);
    while (at < text.size()) {
        if (quote == '"' && text[at] == '\\') {
            at += 2;
        } else if (long_string && text.substr(at, 3) == three) {
            return at + 3;
        } else if (!long_string && (text[at] == quote || text[at] == '\n')) {
            return at + 1;
        } else {
            ++at;
        }
    }
    return text.size();
}

bool is_key_character(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ' ' || c == '\t';
}

/// toml++ recurses along a dotted key, so that its parts are bounded before it.
void require_short_keys(const std::shared_ptr<const SourceFile>& file)
{
    const std::string_view text = file->text;
    std::size_t parts = 1, begin = 0;
    for (std::size_t k = 0; k < text.size();) {
        if (const std::size_t end = end_of_text(text, k); end != k) {
            if (text[k] == '#') parts = 1;
            k = end;
            continue;
        }
        const char c = text[k++];
        if (c == '.' && ++parts > most_parts)
            throw ModelError(fmt::format("a key has more than {} parts", most_parts), SourceRange{file, begin, k},
                             "no key of a model has more than 6");
        if (c == '.' || is_key_character(c)) continue;
        parts = 1;
        begin = k;
    }
}

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
