// SPDX-License-Identifier: GPL-2.0-or-later
/// How long a step of each method may be on linear equations. An interval is [0, a] with the largest a so that no step
/// in all of it makes anything grow: what is stable again beyond a does not count.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace lagen {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

struct LinearLimits {
    double imaginary = 0;       ///< h omega of x'' = -omega^2 x, which is h |lambda| on the imaginary axis
    std::optional<double> real; ///< h |lambda| of x' = lambda x, lambda < 0; nothing for methods of x'' = f(t, x) alone
    std::size_t calls = 0;      ///< of the right-hand side (a splitting: kicks) in a step; 0 where that depends
    bool a_stable = false;      ///< stable wherever Re lambda <= 0
    bool l_stable = false;      ///< and R = 0 at infinity
};

/// Of the method with the runtime's type `type`, "Rk4"; nothing where it has no limits of its own.
[[nodiscard]] std::optional<LinearLimits> linear_limits(const std::string& type);

/// The `imaginary` of a method; no_limit also where it is not known.
[[nodiscard]] double oscillation_limit(const std::string& type);

/// Of Taylor's method with a fixed order.
[[nodiscard]] LinearLimits taylor_limits(std::size_t order);

} // namespace lagen
