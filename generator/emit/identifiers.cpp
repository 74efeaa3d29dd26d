// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/identifiers.hpp"

#include "text/alphabet.hpp"
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <set>

namespace lagen {

namespace {

/// Letters of ASCII, digits and '_' are kept, Greek is spelled, everything else is uXXXX; "x[1]" becomes x_1; a leading
/// digit and an empty name gain an 'n' in front. Two underscores in a row are reserved in C++, so runs of them become
/// one.
std::string spell(std::string_view name)
{
    std::string result;
    for (std::size_t at = 0; at < name.size();) {
        const char c = name[at];
        const GreekLetter* greek = greek_letter_at(name, at);
        const CodePoint point = decode_utf8(name, at);
        std::string piece;
        if (c == '_' || is_digit(point.value) || (point.value < 0x80 && is_letter(point.value)))
            piece = c;
        else if (c == '[' || c == ',')
            piece = "_";
        else if (greek != nullptr && !greek->name.empty())
            piece = greek->name;
        else if (c != ']' && c != ' ')
            piece = fmt::format("u{:04X}", static_cast<std::uint32_t>(point.value));
        at += std::max<std::size_t>(point.length, 1);
        if (piece == "_" && !result.empty() && result.back() == '_') continue;
        result += piece;
    }
    if (result.empty() || (result[0] >= '0' && result[0] <= '9')) result.insert(0, "n");
    if (result[0] == '_') result.insert(0, "n"); // reserved at file scope, and _X everywhere
    return result;
}

} // namespace

std::vector<std::string> identifiers(const std::vector<std::string>& names,
                                     const std::function<bool(std::string_view)>& is_reserved)
{
    std::set<std::string> plain; // a name that needs no change is never taken by one that does
    for (const std::string& name : names)
        if (spell(name) == name && !is_reserved(name)) plain.insert(name);
    std::set<std::string> taken;
    std::vector<std::string> result;
    for (const std::string& name : names) {
        std::string spelled = spell(name);
        if (is_reserved(spelled)) spelled += '_';
        while (taken.contains(spelled) || (spelled != name && plain.contains(spelled)))
            spelled += spelled.back() == '_' ? "1_" : "_"; // never two underscores in a row
        taken.insert(spelled);
        result.push_back(std::move(spelled));
    }
    return result;
}

} // namespace lagen
