// SPDX-License-Identifier: GPL-2.0-or-later
/// Which characters may stand in a name.
#pragma once

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

} // namespace lagen
