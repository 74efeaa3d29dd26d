// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_system.hpp"

namespace lagen {

[[nodiscard]] EquationSystem equation_system(const Model& model, const System& system);

} // namespace lagen
