// SPDX-License-Identifier: GPL-2.0-or-later
/// The exterior differential of a Lie algebroid on the coordinates and on the dual of its frame.
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// dx^i = rho^i_a e^a and de^c = -1/2 C^c_ab e^a ^ e^b, the sum over a < b, and A and dA of each form A of the model.
/// [Martinez 2001]
[[nodiscard]] EquationSet derive_exterior(const Model& model, const System& system);

} // namespace lagen
