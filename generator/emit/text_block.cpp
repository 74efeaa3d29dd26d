// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/text_block.hpp"

#include "emit/print_literal.hpp"

namespace lagen {

namespace {

constexpr std::size_t line_width = 120;

/// Where to break so that the first part has at most `room` bytes: behind the last space outside of a string literal,
/// else behind the first space beyond it; npos where there is none.
std::size_t find_break(std::string_view text, std::size_t room)
{
    bool quoted = false;
    std::size_t best = std::string_view::npos;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\\')
            ++k;
        else if (text[k] == '"')
            quoted = !quoted;
        else if (text[k] == ' ' && !quoted && k > 0) {
            if (k > room && best != std::string_view::npos) return best;
            best = k;
            if (k > room) return best;
        }
    }
    return best;
}

} // namespace

void TextBlock::line(std::string_view text)
{
    std::size_t indentation = 4 * static_cast<std::size_t>(level_);
    bool first = true;
    while (true) {
        const std::size_t room = line_width - indentation;
        const std::size_t cut = text.size() <= room ? std::string_view::npos : find_break(text, room);
        text_.append(indentation, ' ').append(text.substr(0, cut)) += '\n';
        if (cut == std::string_view::npos) return;
        text = text.substr(cut + 1);
        if (first) indentation += 8;
        first = false;
    }
}

void TextBlock::list(std::string_view prefix, const std::vector<std::string>& items, std::string_view suffix)
{
    const std::size_t indentation = 4 * static_cast<std::size_t>(level_);
    std::string row(prefix);
    std::size_t used = indentation;
    for (std::size_t k = 0; k < items.size(); ++k) {
        const std::string item = items[k] + (k + 1 < items.size() ? "," : std::string(suffix));
        if (used + row.size() + 1 + item.size() > line_width && k > 0) {
            text_.append(used, ' ').append(row) += '\n';
            used = indentation + 8;
            row.clear();
        }
        row += (k > 0 && !row.empty() ? " " : "") + item;
    }
    text_.append(used, ' ').append(row) += '\n';
}

void TextBlock::comment(std::string_view text)
{
    const std::string clean = plain_text(text);
    text_.append(4 * static_cast<std::size_t>(level_), ' ') += clean.empty() ? "///\n" : "/// " + clean + "\n";
}

} // namespace lagen
