// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a model in one of its forms.
#pragma once

#include "expression/equation_set.hpp"
#include "geometry/verify.hpp"

namespace lagen {

/// `form` is one of form_names(). Throws MathematicsError where the model has no equations of that form.
[[nodiscard]] EquationSet derive(const std::string& form, const Model& model, const VerifiedAlgebroid& verified);

} // namespace lagen
