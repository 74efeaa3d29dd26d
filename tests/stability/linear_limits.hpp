// SPDX-License-Identifier: GPL-2.0-or-later
/// How long a step of each method may be on linear equations: what LinearLimits says, exactly, and rounded once.
#pragma once

#include "scene/linear_limits.hpp"

#include <string>
#include <vector>

namespace lagen {

/// Of the method with the runtime's type `type`, "Rk4"; nothing where it has no limits of its own.
[[nodiscard]] std::optional<LinearLimits> linear_limits_of(const std::string& type);

/// Of Taylor's method with a fixed order.
[[nodiscard]] LinearLimits taylor_limits(std::size_t order);

/// Of every method, of Taylor's with orders 4, 10, 20 and 30, and of every scheme of [discrete].
[[nodiscard]] std::vector<LinearLimits> computed_limits();

} // namespace lagen
