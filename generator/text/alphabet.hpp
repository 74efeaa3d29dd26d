// SPDX-License-Identifier: GPL-2.0-or-later
/// Characters: letters of names, Greek, digits above and below the line, dots over letters, UTF-8.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lagen {

/// An ASCII letter or a Unicode letter of the scripts in use for names: Latin, Greek, Cyrillic, Armenian, Hebrew,
/// Arabic, Devanagari, Thai, Georgian, kana, Han, Hangul, letter-like symbols and mathematical alphabets.
/// Modifier letters and superscripts are left out: x² must not be a name.
[[nodiscard]] bool is_letter(char32_t c);

/// '0' to '9'.
[[nodiscard]] constexpr bool is_digit(char32_t c)
{
    return c >= U'0' && c <= U'9';
}

/// The same of one byte of a text in UTF-8; the bytes of longer characters are neither letters nor digits.
[[nodiscard]] constexpr bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}
[[nodiscard]] constexpr bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// '₀' to '₉'.
[[nodiscard]] constexpr bool is_lowered_digit(char32_t c)
{
    return c >= U'₀' && c <= U'₉';
}

/// The text with its digits and '-' above the line, and with its digits below the line: s⁻², c₁.
[[nodiscard]] std::string raised_digits(std::string_view text);
[[nodiscard]] std::string lowered_digits(std::string_view text);

/// The name with '0' to '9' for '₀' to '₉'.
[[nodiscard]] std::string with_plain_digits(std::string_view name);

/// The name with a dot over its first letter, an ASCII letter or a Greek one: ẋ in one character where Unicode has it
/// (normal form C), else the letter and a combining dot.
[[nodiscard]] std::string with_dot(const std::string& name);
/// The name without the dot over its first letter; nothing where there is none.
[[nodiscard]] std::optional<std::string> without_dot(std::string_view name);

/// The name without the two dots over its first letter, in one character or two; nothing where there are none.
[[nodiscard]] std::optional<std::string> without_two_dots(std::string_view name);

/// The combining dot, and two of them, over the letter before.
[[nodiscard]] constexpr bool is_dot_above(char32_t c)
{
    return c == U'\u0307' || c == U'\u0308';
}

/// A combining mark, which takes no room of its own.
[[nodiscard]] constexpr bool is_accent(char32_t c)
{
    return c >= U'\u0300' && c <= U'\u036F';
}

struct GreekLetter {
    std::string_view character;
    std::string_view name;  ///< in ASCII; variants have none
    std::string_view latex; ///< "\\phi"; empty for capitals that look Latin
};

/// The Greek letter that begins at byte `at`; null where none does.
[[nodiscard]] const GreekLetter* greek_letter_at(std::string_view text, std::size_t at);
/// The Greek letter that LaTeX has under this name or the letter's own, φ for "varphi" and "phi"; null where there is
/// none.
[[nodiscard]] const GreekLetter* greek_letter_called(std::string_view name);

/// True for the first byte of each character in UTF-8.
[[nodiscard]] constexpr bool begins_character(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

/// The first bytes of a text, at most `size`, ending between two characters.
[[nodiscard]] std::string whole_characters(std::string_view text, std::size_t size);

/// Columns of a text on a terminal: characters, combining marks not counted.
[[nodiscard]] std::size_t columns_of(std::string_view text);

} // namespace lagen
