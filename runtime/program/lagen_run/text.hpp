// SPDX-License-Identifier: MIT
/// Numbers as the programs around headers write them.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace lagen::detail {

/// The shortest decimal that reads back as the same number; "nan" and "inf" for what is no finite number.
inline std::string number_text(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The same as a field: nothing for what is no finite number.
inline void append_number(std::string& line, double value)
{
    if (std::isfinite(value)) line += number_text(value);
}

} // namespace lagen::detail
