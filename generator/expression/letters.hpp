// SPDX-License-Identifier: GPL-2.0-or-later
/// Which characters may stand in a name.
#pragma once

#include <optional>
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

/// '₀' to '₉'.
[[nodiscard]] constexpr bool is_lowered_digit(char32_t c)
{
    return c >= U'₀' && c <= U'₉';
}

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

} // namespace lagen
