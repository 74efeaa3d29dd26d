// SPDX-License-Identifier: GPL-2.0-or-later
/// Entries one after the other: "a, b, c".
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace lagen {

/// The texts that `each` makes of the entries (a text, or a member that is one), with `between` between them; what it
/// leaves empty is left out.
template <class Range, class Each = std::identity>
[[nodiscard]] std::string comma_list(const Range& entries, Each each = {}, std::string_view between = ", ")
{
    std::string text;
    for (const auto& entry : entries) {
        const std::string part(std::invoke(each, entry));
        if (!part.empty()) text.append(text.empty() ? "" : between).append(part);
    }
    return text;
}

} // namespace lagen
