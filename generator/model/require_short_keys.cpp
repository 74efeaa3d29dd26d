// SPDX-License-Identifier: GPL-2.0-or-later
/// The parser nests a table for each part of a dotted key, without a bound of its own.
#include "model/require_short_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace lagen {

namespace {

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

} // namespace

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

} // namespace lagen
