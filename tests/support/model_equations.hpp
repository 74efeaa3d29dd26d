// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a model whose report is at hand.
#pragma once

#include "equations/derive.hpp"
#include "support/stages.hpp"

namespace lagen {

[[nodiscard]] inline EquationSet derive(const std::string& form, const Model& model, const Report& report)
{
    return derive(form, model, elaborate(model), report);
}

} // namespace lagen
