// SPDX-License-Identifier: GPL-2.0-or-later
/// What --lqr says: 'Q=expr;R=expr' over parameters. A number stands for so many times the unit matrix, a vector for a
/// diagonal.
#pragma once

#include "commands/line/options.hpp"
#include "linear/linear_system.hpp"
#include "scene/values.hpp"

namespace lagen {

struct QuadraticCost {
    linear::Matrix Q, R; ///< shapes (n, n), (m, m)
};

/// Throws UsageError where it has other parts, ModelError with the place in the option: no number, vector or matrix of
/// that many rows, not symmetric, Q not semidefinite, R not definite.
[[nodiscard]] QuadraticCost read_cost(const Options& options, const Model& model, const Values& parameters,
                                      std::size_t n, std::size_t m);

} // namespace lagen
