// SPDX-License-Identifier: GPL-2.0-or-later
/// The four tolerances of the tests, and the reason for each.
#pragma once

#include <limits>

namespace lagen::tolerance {

/// Nothing is rounded: equality.
inline constexpr double exact = 0.0;

/// k roundings of relative size epsilon, one after another.
constexpr double roundoff(double k)
{
    return k * std::numeric_limits<double>::epsilon();
}

/// Central finite differences with step eps^(1/3): truncation and cancellation balance near eps^(2/3).
inline constexpr double difference = 1e-9;

/// Measured order against nominal order: pre-asymptotic terms at step ratios of 2.
inline constexpr double order = 0.25;

} // namespace lagen::tolerance
