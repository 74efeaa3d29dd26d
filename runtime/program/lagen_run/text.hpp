// SPDX-License-Identifier: MIT
/// Numbers and rows as tables have them.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace lagen::detail {

/// The shortest decimal that reads back as the same number; "nan" and "inf" for what is no finite number.
inline std::string number_text(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Fields with commas between them; nothing stands for what is no finite number.
inline void append_fields(std::string& line, std::span<const double> values)
{
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (k > 0) line += ',';
        if (std::isfinite(values[k])) line += number_text(values[k]);
    }
}

} // namespace lagen::detail
