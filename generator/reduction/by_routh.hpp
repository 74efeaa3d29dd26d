// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce MODEL --routh x`: the model file of a Routh reduction is that of the whole model with what the
/// reduction changes. Velocities of cyclic coordinates become definitions and the coordinates first-order states, so
/// that forces, observables and events stand as they did, and an angle is integrated where it is observed; momenta
/// become parameters, with values from the scenes.
#pragma once

#include "reduction/reduced_document.hpp"

namespace lagen {

/// By the coordinates of these names. R is what is read back from the file, and proved to have the motions of L. Throws
/// where one is no coordinate, or not cyclic, where the model is not of the sort that is reduced, and where none would
/// be left.
[[nodiscard]] ReducedModel reduce_by_routh(const CheckedModel& checked, const std::vector<std::string>& names);

} // namespace lagen
