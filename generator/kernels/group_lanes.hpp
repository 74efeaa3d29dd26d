// SPDX-License-Identifier: GPL-2.0-or-later
/// The matrices of [reconstruct] among the lanes of a form.
#pragma once

#include "graph/kernel.hpp"
#include "model/model.hpp"

namespace lagen {

/// Those whose entries are among `states`, numbers of first-order states that stand behind `before` other lanes.
[[nodiscard]] std::vector<GroupLanes> group_lanes(const Model& model, const std::vector<std::size_t>& states,
                                                  std::size_t before);

} // namespace lagen
