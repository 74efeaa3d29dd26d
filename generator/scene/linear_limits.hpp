// SPDX-License-Identifier: GPL-2.0-or-later
/// How long a step of each method may be on linear equations.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

namespace lagen {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// An interval is [0, a] with the largest a so that no step in all of it
/// makes anything grow: what is stable again beyond a does not count.
struct LinearLimits {
    std::string_view of = {}; ///< the runtime's type of a method, "Rk4"; a scheme, "gauss:2"; "taylor:4", by its order
    double imaginary = 0;     ///< h omega of x'' = -omega^2 x, which is h |lambda| on the imaginary axis
    std::optional<double> real = {}; ///< h |lambda| of x' = lambda x, lambda < 0; nothing where x'' alone is stepped
    std::size_t calls = 0;           ///< of the right-hand side (a splitting: kicks) in a step; 0 where that depends
    bool a_stable = false;           ///< stable wherever Re lambda <= 0
    bool l_stable = false;           ///< and R = 0 at infinity
};
/// nullptr where there are none.
[[nodiscard]] const LinearLimits* find_limits(std::string_view of);

} // namespace lagen
