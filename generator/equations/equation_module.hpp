// SPDX-License-Identifier: GPL-2.0-or-later
/// Derived equations with all that a program needs to compute with them.
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "notation/equation_module.hpp"

namespace lagen {

/// The forms of `derive` that have such a module.
[[nodiscard]] const std::vector<std::string>& module_forms();

/// `equations` are those of one of module_forms(). Throws MathematicsError where they leave the rate of a state open,
/// or write it in a symbol without a formula (velocities y(x, mu), controls).
[[nodiscard]] EquationModule equation_module(const Model& model, const System& system, EquationSet equations);

} // namespace lagen
