// SPDX-License-Identifier: GPL-2.0-or-later
/// What of the equations has no number at a point.
#pragma once

#include "graph/kernel.hpp"

#include <map>
#include <string>

namespace lagen {

/// "the rate of v" or "the derivative of the rate of v by y": the first entry of the right-hand side, else of its
/// Jacobian, that is not finite where the inputs of the module's graph have these values. Empty where all are finite,
/// where a value is missing, and where unknowns are solved for.
[[nodiscard]] std::string non_finite_entry(const KernelModule& module, const std::map<std::string, double>& at);

} // namespace lagen
