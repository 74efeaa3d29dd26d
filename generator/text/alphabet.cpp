// SPDX-License-Identifier: GPL-2.0-or-later
/// Letters are those of the general category of the Unicode Character Database (Lu, Ll, Lt, Lo).
#include "text/alphabet.hpp"

#include "text/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

namespace lagen {

namespace {

struct Range {
    char32_t first, last;
};

/// Ascending and disjoint.
constexpr Range letters[] = {
    // Latin
    {0xB5, 0xB5},
    {0xC0, 0xD6},
    {0xD8, 0xF6},
    {0xF8, 0x2AF},
    // Greek, Cyrillic
    {0x370, 0x373},
    {0x376, 0x377},
    {0x37B, 0x37D},
    {0x37F, 0x37F},
    {0x386, 0x386},
    {0x388, 0x38A},
    {0x38C, 0x38C},
    {0x38E, 0x3A1},
    {0x3A3, 0x3F5},
    {0x3F7, 0x481},
    {0x48A, 0x52F},
    // Armenian
    {0x531, 0x556},
    {0x560, 0x588},
    // Hebrew, Arabic, Devanagari, Thai
    {0x5D0, 0x5EA},
    {0x620, 0x63F},
    {0x641, 0x64A},
    {0x904, 0x939},
    {0xE01, 0xE30},
    // Georgian
    {0x10A0, 0x10C5},
    {0x10C7, 0x10C7},
    {0x10CD, 0x10CD},
    {0x10D0, 0x10FA},
    {0x10FD, 0x10FF},
    // Latin additional, Greek extended
    {0x1E00, 0x1F15},
    {0x1F18, 0x1F1D},
    {0x1F20, 0x1F45},
    {0x1F48, 0x1F4D},
    {0x1F50, 0x1F57},
    {0x1F59, 0x1F59},
    {0x1F5B, 0x1F5B},
    {0x1F5D, 0x1F5D},
    {0x1F5F, 0x1F7D},
    {0x1F80, 0x1FB4},
    {0x1FB6, 0x1FBC},
    {0x1FBE, 0x1FBE},
    {0x1FC2, 0x1FC4},
    {0x1FC6, 0x1FCC},
    {0x1FD0, 0x1FD3},
    {0x1FD6, 0x1FDB},
    {0x1FE0, 0x1FEC},
    {0x1FF2, 0x1FF4},
    {0x1FF6, 0x1FFC},
    // letter-like symbols
    {0x2102, 0x2102},
    {0x2107, 0x2107},
    {0x210A, 0x2113},
    {0x2115, 0x2115},
    {0x2119, 0x211D},
    {0x2124, 0x2124},
    {0x2126, 0x2126},
    {0x2128, 0x2128},
    {0x212A, 0x212D},
    {0x212F, 0x2139},
    {0x213C, 0x213F},
    // kana, Han, Hangul
    {0x3041, 0x3096},
    {0x309F, 0x309F},
    {0x30A1, 0x30FA},
    {0x3400, 0x4DBF},
    {0x4E00, 0x9FFF},
    {0xAC00, 0xD7A3},
    // mathematical alphabets
    {0x1D400, 0x1D454},
    {0x1D456, 0x1D49C},
    {0x1D49E, 0x1D49F},
    {0x1D4A2, 0x1D4A2},
    {0x1D4A5, 0x1D4A6},
    {0x1D4A9, 0x1D4AC},
    {0x1D4AE, 0x1D4B9},
    {0x1D4BB, 0x1D4BB},
    {0x1D4BD, 0x1D4C3},
    {0x1D4C5, 0x1D505},
    {0x1D507, 0x1D50A},
    {0x1D50D, 0x1D514},
    {0x1D516, 0x1D51C},
    {0x1D51E, 0x1D539},
    {0x1D53B, 0x1D53E},
    {0x1D540, 0x1D544},
    {0x1D546, 0x1D546},
    {0x1D54A, 0x1D550},
    {0x1D552, 0x1D6A5},
    {0x1D6A8, 0x1D6C0},
    {0x1D6C2, 0x1D6DA},
    {0x1D6DC, 0x1D6FA},
    {0x1D6FC, 0x1D714},
    {0x1D716, 0x1D734},
    {0x1D736, 0x1D74E},
    {0x1D750, 0x1D76E},
    {0x1D770, 0x1D788},
    {0x1D78A, 0x1D7A8},
    {0x1D7AA, 0x1D7C2},
    {0x1D7C4, 0x1D7CB},
};

struct DottedLetter {
    std::string_view letter, dotted;
};

constexpr DottedLetter dotted_letters[] = {
    {"a", "ȧ"}, {"b", "ḃ"}, {"c", "ċ"}, {"d", "ḋ"}, {"e", "ė"}, {"f", "ḟ"}, {"g", "ġ"}, {"h", "ḣ"},
    {"m", "ṁ"}, {"n", "ṅ"}, {"o", "ȯ"}, {"p", "ṗ"}, {"r", "ṙ"}, {"s", "ṡ"}, {"t", "ṫ"}, {"w", "ẇ"},
    {"x", "ẋ"}, {"y", "ẏ"}, {"z", "ż"}, {"A", "Ȧ"}, {"B", "Ḃ"}, {"C", "Ċ"}, {"D", "Ḋ"}, {"E", "Ė"},
    {"F", "Ḟ"}, {"G", "Ġ"}, {"H", "Ḣ"}, {"I", "İ"}, {"M", "Ṁ"}, {"N", "Ṅ"}, {"O", "Ȯ"}, {"P", "Ṗ"},
    {"R", "Ṙ"}, {"S", "Ṡ"}, {"T", "Ṫ"}, {"W", "Ẇ"}, {"X", "Ẋ"}, {"Y", "Ẏ"}, {"Z", "Ż"}};

constexpr DottedLetter letters_of_two_dots[] = {{"a", "ä"}, {"e", "ë"}, {"h", "ḧ"}, {"i", "ï"}, {"o", "ö"}, {"t", "ẗ"},
                                                {"u", "ü"}, {"w", "ẅ"}, {"x", "ẍ"}, {"y", "ÿ"}, {"A", "Ä"}, {"E", "Ë"},
                                                {"H", "Ḧ"}, {"I", "Ï"}, {"O", "Ö"}, {"U", "Ü"}, {"W", "Ẅ"}, {"X", "Ẍ"},
                                                {"Y", "Ÿ"}, {"ι", "ϊ"}, {"υ", "ϋ"}};

constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
constexpr std::array<std::string_view, 10> lowered{"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};

// clang-format off
constexpr GreekLetter greek[] = {
    {"α", "alpha", "\\alpha"}, {"β", "beta", "\\beta"}, {"γ", "gamma", "\\gamma"}, {"δ", "delta", "\\delta"},
    {"ε", "epsilon", "\\varepsilon"}, {"ζ", "zeta", "\\zeta"}, {"η", "eta", "\\eta"}, {"θ", "theta", "\\theta"},
    {"ι", "iota", "\\iota"}, {"κ", "kappa", "\\kappa"}, {"λ", "lambda", "\\lambda"}, {"μ", "mu", "\\mu"},
    {"ν", "nu", "\\nu"}, {"ξ", "xi", "\\xi"}, {"ο", "omicron", "o"}, {"π", "pi", "\\pi"}, {"ρ", "rho", "\\rho"},
    {"σ", "sigma", "\\sigma"}, {"ς", "sigma", "\\varsigma"}, {"τ", "tau", "\\tau"}, {"υ", "upsilon", "\\upsilon"},
    {"φ", "phi", "\\varphi"}, {"χ", "chi", "\\chi"}, {"ψ", "psi", "\\psi"}, {"ω", "omega", "\\omega"},
    {"ϕ", "", "\\phi"}, {"ϑ", "", "\\vartheta"}, {"Α", "Alpha", ""}, {"Β", "Beta", ""}, {"Γ", "Gamma", "\\Gamma"},
    {"Δ", "Delta", "\\Delta"}, {"Ε", "Epsilon", ""}, {"Ζ", "Zeta", ""}, {"Η", "Eta", ""},
    {"Θ", "Theta", "\\Theta"}, {"Ι", "Iota", ""}, {"Κ", "Kappa", ""}, {"Λ", "Lambda", "\\Lambda"}, {"Μ", "Mu", ""},
    {"Ν", "Nu", ""}, {"Ξ", "Xi", "\\Xi"}, {"Ο", "Omicron", ""}, {"Π", "Pi", "\\Pi"}, {"Ρ", "Rho", ""},
    {"Σ", "Sigma", "\\Sigma"}, {"Τ", "Tau", ""}, {"Υ", "Upsilon", "\\Upsilon"}, {"Φ", "Phi", "\\Phi"},
    {"Χ", "Chi", ""}, {"Ψ", "Psi", "\\Psi"}, {"Ω", "Omega", "\\Omega"},
};
// clang-format on

constexpr std::string_view combining_dot = "\u0307", two_combining_dots = "\u0308";

std::size_t first_letter_size(std::string_view name)
{
    return !name.empty() && static_cast<unsigned char>(name[0]) >= 0x80 ? 2 : 1;
}

std::optional<std::string> without_accent(std::string_view name, std::span<const DottedLetter> whole,
                                          std::string_view combining)
{
    for (const auto& [letter, dotted] : whole)
        if (name.starts_with(dotted)) return std::string(letter) + std::string(name.substr(dotted.size()));
    const std::size_t size = first_letter_size(name);
    if (name.size() < size || !name.substr(size).starts_with(combining)) return std::nullopt;
    return std::string(name.substr(0, size)) + std::string(name.substr(size + combining.size()));
}

} // namespace

std::string raised_digits(std::string_view text)
{
    std::string result;
    for (const char c : text)
        result += c == '-' ? "⁻" : is_digit(c) ? raised[static_cast<std::size_t>(c - '0')] : std::string_view(&c, 1);
    return result;
}

std::string lowered_digits(std::string_view text)
{
    std::string result;
    for (const char c : text)
        result += is_digit(c) ? lowered[static_cast<std::size_t>(c - '0')] : std::string_view(&c, 1);
    return result;
}

std::string with_plain_digits(std::string_view name)
{
    std::string plain;
    for (std::size_t k = 0; k < name.size();) {
        const auto digit = std::ranges::find_if(lowered, [&](auto each) { return name.substr(k).starts_with(each); });
        plain += digit == lowered.end() ? name[k] : static_cast<char>('0' + (digit - lowered.begin()));
        k += digit == lowered.end() ? 1 : digit->size();
    }
    return plain;
}

std::string with_dot(const std::string& name)
{
    for (const auto& [letter, dotted] : dotted_letters)
        if (name.starts_with(letter)) return std::string(dotted) + name.substr(1);
    const std::size_t size = first_letter_size(name);
    return name.substr(0, size) + std::string(combining_dot) + name.substr(size);
}

std::optional<std::string> without_dot(std::string_view name)
{
    return without_accent(name, dotted_letters, combining_dot);
}

std::optional<std::string> without_two_dots(std::string_view name)
{
    return without_accent(name, letters_of_two_dots, two_combining_dots);
}

bool is_letter(char32_t c)
{
    if (c < 0x80) return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z');
    const Range* after = std::upper_bound(std::begin(letters), std::end(letters), c,
                                          [](char32_t value, const Range& range) { return value < range.first; });
    return after != std::begin(letters) && c <= std::prev(after)->last;
}

const GreekLetter* greek_letter_at(std::string_view text, std::size_t at)
{
    const auto found = std::ranges::find_if(
        greek, [&](const GreekLetter& each) { return text.substr(at).starts_with(each.character); });
    return found == std::end(greek) ? nullptr : found;
}

const GreekLetter* greek_letter_called(std::string_view name)
{
    const auto found = std::ranges::find_if(greek, [&](const GreekLetter& each) {
        return each.latex.starts_with('\\') && (each.name == name || each.latex.substr(1) == name);
    });
    return found == std::end(greek) ? nullptr : found;
}

std::string whole_characters(std::string_view text, std::size_t size)
{
    if (text.size() <= size) return std::string(text);
    while (size > 0 && !begins_character(text[size])) --size;
    return std::string(text.substr(0, size));
}

std::size_t columns_of(std::string_view text)
{
    std::size_t columns = 0;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text, at);
        if (!is_accent(point.value)) ++columns;
        at += std::max<std::size_t>(point.length, 1);
    }
    return columns;
}

} // namespace lagen
