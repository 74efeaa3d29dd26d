// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a model in one of its forms.
#pragma once

#include "expression/equation_set.hpp"
#include "geometry/verify.hpp"

namespace lagen {

/// The forms that `derive` knows, the names of --form.
[[nodiscard]] const std::vector<std::string>& derived_forms();

/// `form` is one of derived_forms(). Throws MathematicsError where the model has no equations of that form.
[[nodiscard]] EquationSet derive(const std::string& form, const Model& model, const VerifiedAlgebroid& verified);

} // namespace lagen
