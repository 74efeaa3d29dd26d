// SPDX-License-Identifier: GPL-2.0-or-later
/// Lines, columns and UTF-8.
#include "model/source_positions.hpp"

#include "text/diagnostic.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t milestone = 64;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_control(char32_t c)
{
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029 || (c >= 0x202A && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

} // namespace

SourcePositions::SourcePositions(std::string_view text) : text_(text)
{
    std::size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    lines_.push_back({at, 0});
    for (std::size_t character = 0; at < text.size(); ++character) {
        if (character % milestone == 0) milestones_.push_back(at);
        const bool ends_line = text[at] == '\n';
        at += std::max<std::size_t>(1, decode_utf8(text, at).length);
        if (ends_line) lines_.push_back({at, character + 1});
    }
}

std::size_t SourcePositions::byte_of(std::size_t line, std::size_t column) const
{
    if (line == 0) return 0;
    if (line > lines_.size()) return text_.size();
    const std::size_t line_end = line < lines_.size() ? lines_[line].byte - 1 : text_.size();
    const std::size_t character = lines_[line - 1].character + std::max<std::size_t>(1, column) - 1;
    if (character / milestone >= milestones_.size()) return line_end;
    std::size_t at = milestones_[character / milestone];
    for (std::size_t k = 0; k < character % milestone && at < line_end; ++k) {
        at += std::max<std::size_t>(1, decode_utf8(text_, at).length);
    }
    return std::min(at, line_end);
}

std::size_t first_control_character(std::string_view text)
{
    std::size_t at = 0;
    while (at < text.size()) {
        const CodePoint point = decode_utf8(text, at);
        if (is_control(point.value)) return at;
        at += std::max<std::size_t>(1, point.length);
    }
    return at;
}

} // namespace lagen
