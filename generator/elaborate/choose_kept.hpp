// SPDX-License-Identifier: GPL-2.0-or-later
/// Which coordinates of its ambient algebroid a nonholonomic model by constraints keeps, where it does not say so.
#pragma once

#include "model/read_model.hpp"

namespace lagen {

/// The first choice, in the order of the ambient coordinates, whose minor of the constraints is proved to vanish
/// nowhere on the domain; of constraints that are dependent everywhere the first one. Throws MathematicsError where
/// there is none.
[[nodiscard]] std::vector<std::size_t> choose_kept(const Model& model);

} // namespace lagen
