// SPDX-License-Identifier: GPL-2.0-or-later
/// Rows and columns of the minors of a matrix: ascending numbers, in lexicographic order.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace lagen {

using Places = std::vector<std::size_t>;

/// 0, 1, .., count - 1
[[nodiscard]] inline Places first_places(std::size_t count)
{
    Places places(count);
    std::iota(places.begin(), places.end(), std::size_t{0});
    return places;
}

/// The next ascending numbers below `limit`; false after the last.
[[nodiscard]] inline bool next_places(Places& places, std::size_t limit)
{
    for (std::size_t k = places.size(); k-- > 0;) {
        if (places[k] + (places.size() - k) >= limit) continue;
        ++places[k];
        for (std::size_t l = k + 1; l < places.size(); ++l) places[l] = places[l - 1] + 1;
        return true;
    }
    return false;
}

} // namespace lagen
