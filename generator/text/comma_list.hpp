// SPDX-License-Identifier: GPL-2.0-or-later
/// Entries one after the other: "a, b, c".
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

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

/// The texts that `each` makes of the entries, each of them once, in the order in which they come first.
template <class Range, class Each = std::identity>
[[nodiscard]] std::vector<std::string> distinct(const Range& entries, Each each = {})
{
    std::vector<std::string> texts;
    for (const auto& entry : entries)
        if (std::string text(std::invoke(each, entry)); std::ranges::find(texts, text) == texts.end())
            texts.push_back(std::move(text));
    return texts;
}

} // namespace lagen
