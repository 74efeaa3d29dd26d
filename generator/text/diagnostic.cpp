// SPDX-License-Identifier: GPL-2.0-or-later
/// Rendering of diagnostics, UTF-8 decoding, and the search for the name that was meant.
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace lagen {

namespace {

constexpr std::size_t widest_line = 120; ///< characters of a source line that are shown
constexpr std::size_t widest_quote = 40;
constexpr std::size_t longest_name =
    200; ///< names above this length are no slip of the hand; bounds the quadratic search

/// A character for the terminal: itself, or '?' for a control character (tabs aside) or a byte that is not UTF-8.
struct Shown {
    std::string_view bytes;
    std::size_t begin; ///< its byte in the text
};

bool is_control(char32_t c)
{
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x2028 && c <= 0x202E);
}

std::vector<Shown> characters(std::string_view text, std::size_t begin, std::size_t end)
{
    std::vector<Shown> shown;
    for (std::size_t at = begin; at < end;) {
        const CodePoint c = decode_utf8(text, at);
        const std::size_t length = std::max<std::size_t>(c.length, 1);
        const bool printable = c.length > 0 && (c.value == '\t' || !is_control(c.value));
        shown.push_back({printable ? text.substr(at, length) : std::string_view("?"), at});
        at += length;
    }
    return shown;
}

/// The line that a byte belongs to, without its line break.
struct Line {
    std::size_t number; ///< from 1
    std::size_t begin, end;
};

Line line_at(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, byte);
    const auto breaks = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t last = before.rfind('\n');
    const std::size_t begin = last == std::string_view::npos ? 0 : last + 1;
    std::size_t end = std::min(text.find('\n', byte), text.size());
    if (end > begin && text[end - 1] == '\r') --end;
    return {breaks + 1, begin, std::max(begin, end)};
}

std::size_t clamped_begin(const SourceRange& range)
{
    return std::min(range.begin, range.file->text.size());
}

/// The source line and the caret line, both indented by two spaces.
std::string show_line(const SourceRange& where)
{
    const std::string& text = where.file->text;
    const std::size_t begin = clamped_begin(where);
    const Line line = line_at(text, begin);
    const std::vector<Shown> shown = characters(text, line.begin, line.end);
    const auto before = [&](std::size_t byte) {
        return static_cast<std::size_t>(
            std::count_if(shown.begin(), shown.end(), [byte](const Shown& c) { return c.begin < byte; }));
    };
    const std::size_t caret = before(begin);
    const std::size_t caret_end = std::max(caret + 1, before(where.end));

    std::size_t first = 0;
    std::size_t last = shown.size();
    if (shown.size() > widest_line) {
        const std::size_t room = widest_line - 6; // "..." on both sides
        first = caret > room - 20 ? std::min(caret - room / 2, shown.size() - room) : 0;
        last = std::min(shown.size(), first + room);
    }
    std::string source = first > 0 ? "  ..." : "  ";
    std::string marks(source.size(), ' ');
    for (std::size_t k = first; k < last; ++k) {
        source += shown[k].bytes;
        if (k < caret) marks += shown[k].bytes == "\t" ? '\t' : ' ';
    }
    if (last < shown.size()) source += "...";
    marks += '^';
    const std::size_t tail_end = std::min(caret_end, std::max(last, caret + 1));
    marks.append(tail_end - caret - 1, '~');
    return source + "\n" + marks;
}

/// A name of the file may hold anything: what the terminal would obey is shown as '?'.
std::string printable(std::string_view text)
{
    std::string result;
    for (const Shown& c : characters(text, 0, text.size())) result += c.bytes;
    return result;
}

const char* spelling(Severity severity)
{
    switch (severity) {
    case Severity::error: return "error";
    case Severity::warning: return "warning";
    case Severity::note: return "note";
    }
    return "error";
}

std::u32string code_points(std::string_view text)
{
    std::u32string result;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint c = decode_utf8(text, at);
        result += c.length > 0 ? c.value : U'\uFFFD';
        at += std::max<std::size_t>(c.length, 1);
    }
    return result;
}

std::u32string lower_case(std::u32string text)
{
    for (char32_t& c : text)
        if (c >= U'A' && c <= U'Z') c += U'a' - U'A';
    return text;
}

/// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours cost 1 each.
std::size_t edit_distance(const std::u32string& a, const std::u32string& b)
{
    std::vector<std::size_t> older(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                current[j] = std::min(current[j], older[j - 2] + 1);
        }
        std::swap(older, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

/// The length of a UTF-8 sequence by its first byte and the least value that needs it; 0 for no first byte.
struct Lead {
    std::size_t length;
    char32_t bits;
    char32_t least;
};

Lead lead_of(unsigned char byte)
{
    if (byte < 0x80) return {1, byte, 0};
    if (byte >= 0xC2 && byte <= 0xDF) return {2, byte & 0x1Fu, 0x80};
    if (byte >= 0xE0 && byte <= 0xEF) return {3, byte & 0x0Fu, 0x800};
    if (byte >= 0xF0 && byte <= 0xF4) return {4, byte & 0x07u, 0x10000};
    return {0, 0, 0};
}

} // namespace

SourceRange Excerpt::range(std::size_t begin, std::size_t end) const
{
    if (!file || origin.empty()) return {file, 0, 0};
    const auto mapped = [this](std::size_t byte) { return origin[std::min(byte, origin.size() - 1)]; };
    return {file, mapped(begin), std::max(mapped(begin), mapped(end))};
}

Excerpt trimmed(const Excerpt& text, std::size_t begin, std::size_t end)
{
    const auto blank = [&](std::size_t k) { return text.text[k] == ' ' || text.text[k] == '\t'; };
    while (begin < end && blank(begin)) ++begin;
    while (end > begin && blank(end - 1)) --end;
    Excerpt out{text.file, text.text.substr(begin, end - begin), {}};
    const auto first = text.origin.begin() + static_cast<std::ptrdiff_t>(begin);
    out.origin.assign(first, first + static_cast<std::ptrdiff_t>(end - begin + 1));
    return out;
}

Excerpt whole_text(std::string name, std::string text)
{
    Excerpt excerpt;
    excerpt.origin.resize(text.size() + 1);
    for (std::size_t k = 0; k <= text.size(); ++k) excerpt.origin[k] = k;
    excerpt.file = std::make_shared<const SourceFile>(SourceFile{std::move(name), text});
    excerpt.text = std::move(text);
    return excerpt;
}

CodePoint decode_utf8(std::string_view text, std::size_t at)
{
    if (at >= text.size()) return {};
    const Lead lead = lead_of(static_cast<unsigned char>(text[at]));
    if (lead.length == 0 || at + lead.length > text.size()) return {};
    char32_t value = lead.bits;
    for (std::size_t k = 1; k < lead.length; ++k) {
        const auto byte = static_cast<unsigned char>(text[at + k]);
        if ((byte & 0xC0u) != 0x80u) return {};
        value = (value << 6) | (byte & 0x3Fu);
    }
    const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
    if (value < lead.least || surrogate || value > 0x10FFFF) return {};
    return {value, lead.length};
}

std::size_t find_invalid_utf8(std::string_view text)
{
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = decode_utf8(text, at).length;
        if (length == 0) return at;
        at += length;
    }
    return std::string_view::npos;
}

std::string quote(std::string_view text)
{
    // 4 bytes hold any character, so this much of the text decides what is shown.
    const std::vector<Shown> shown = characters(text, 0, std::min(text.size(), 4 * (widest_quote + 1)));
    std::string result = "'";
    for (std::size_t k = 0; k < std::min(shown.size(), widest_quote); ++k)
        result += shown[k].bytes == "\t" ? std::string_view(" ") : shown[k].bytes;
    if (shown.size() > widest_quote) result += "...";
    return result + "'";
}

std::string place(const SourceRange& range)
{
    if (!range.file) return "";
    const std::string& text = range.file->text;
    const std::size_t begin = clamped_begin(range);
    const Line line = line_at(text, begin);
    const std::size_t column = characters(text, line.begin, std::max(line.begin, begin)).size() + 1;
    return fmt::format("{}:{}:{}", range.file->name, line.number, column);
}

std::string source_text(const SourceRange& range)
{
    if (!range.file) return "";
    const std::size_t begin = clamped_begin(range);
    return range.file->text.substr(begin, std::max(range.end, begin) - begin);
}

std::string render(const Diagnostic& diagnostic)
{
    std::string text;
    if (diagnostic.where.file) text = printable(place(diagnostic.where)) + ": ";
    text += fmt::format("{}: {}", spelling(diagnostic.severity), printable(diagnostic.message));
    if (diagnostic.where.file) text += fmt::format("\n{}", show_line(diagnostic.where));
    return with_hint(text, printable(diagnostic.hint));
}

std::string with_hint(const std::string& text, const std::string& hint)
{
    return hint.empty() ? text : fmt::format("{}\nhint: {}", text, hint);
}

ModelError::ModelError(Diagnostic diagnostic)
    : Error(ExitCode::model_error, render(diagnostic)), diagnostic_(std::move(diagnostic))
{
}

ModelError::ModelError(std::string message, SourceRange where, std::string hint)
    : ModelError(Diagnostic{Severity::error, std::move(message), std::move(where), std::move(hint)})
{
}

MathematicsError::MathematicsError(std::string message, std::string hint)
    : Error(ExitCode::refuted, render({Severity::error, message, {}, hint})), message_(std::move(message)),
      hint_(std::move(hint))
{
}

InternalError::InternalError(const std::string& text)
    : text_(with_hint("internal error: " + text,
                      "this is a defect of lagen; please report it together with the model file and the command"))
{
}

namespace {

/// The only name that begins with `unknown`, if it is more than two characters.
std::string continuation_of(std::string_view unknown, std::span<const std::string> known)
{
    const auto begins = [&](const std::string& name) { return name.starts_with(unknown) && name != unknown; };
    if (unknown.size() < 3 || std::ranges::count_if(known, begins) != 1) return "";
    return *std::ranges::find_if(known, begins);
}

} // namespace

std::string nearest_name(std::string_view unknown, std::span<const std::string> known)
{
    if (unknown.size() > longest_name) return "";
    const std::u32string wanted = code_points(unknown);
    const std::u32string wanted_lower = lower_case(wanted);
    const std::string* best = nullptr;
    std::size_t best_distance = (wanted.size() + 2) / 4 + (wanted.size() == 1 ? 1 : 0) + 1;
    for (const std::string& name : known) {
        if (name.size() > longest_name || name == unknown) continue; // what was refused helps nobody
        const std::u32string candidate = code_points(name);
        const bool same_letters = lower_case(candidate) == wanted_lower;
        // One letter for another is no slip: something of the name must be left.
        const std::size_t distance = same_letters ? 0 : edit_distance(wanted, candidate);
        if (distance >= best_distance) continue;
        if (!same_letters && distance >= std::max(wanted.size(), candidate.size())) continue;
        best = &name;
        best_distance = distance;
    }
    return best ? *best : continuation_of(unknown, known);
}

} // namespace lagen
