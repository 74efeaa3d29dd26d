// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/identifiers.hpp"

#include <fmt/format.h>

#include <set>

namespace lagen {

namespace {

constexpr std::string_view greek_small[] = {
    "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta",    "eta",   "theta", "iota",
    "kappa", "lambda", "mu",      "nu",    "xi",      "omicron", "pi",    "rho",   "sigma",
    "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",     "omega",
};

/// U+03B1..U+03C9 and U+0391..U+03A9 by name, everything else as uXXXX.
std::string transliterate(char32_t c)
{
    if (c >= 0x3b1 && c <= 0x3c9) return std::string(greek_small[c - 0x3b1]);
    if (c >= 0x391 && c <= 0x3a9) {
        std::string name(greek_small[c - 0x391]);
        name[0] = static_cast<char>(name[0] - 'a' + 'A');
        return name;
    }
    return fmt::format("u{:04X}", static_cast<std::uint32_t>(c));
}

/// The code point that starts at `at`, which moves behind it; a broken byte stands for itself.
char32_t next_code_point(std::string_view text, std::size_t& at)
{
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    const unsigned lead = byte(at);
    const std::size_t length = lead < 0x80U ? 1 : lead >= 0xf0U ? 4 : lead >= 0xe0U ? 3 : lead >= 0xc0U ? 2 : 1;
    char32_t value = length == 1 ? lead : lead & (0xffU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) value = (value << 6U) | (byte(at + k) & 0x3fU);
    at += length;
    return value;
}

/// Letters, digits and '_' kept; "x[1]" becomes x_1; a leading digit and an empty name gain a '_' in front.
/// Two underscores in a row are reserved in C++, so runs of them become one.
std::string spell(std::string_view name)
{
    std::string result;
    for (std::size_t at = 0; at < name.size();) {
        const char32_t c = next_code_point(name, at);
        const bool kept = c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        std::string piece;
        if (kept)
            piece = static_cast<char>(c);
        else if (c == '[' || c == ',')
            piece = "_";
        else if (c != ']' && c != ' ')
            piece = transliterate(c);
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
