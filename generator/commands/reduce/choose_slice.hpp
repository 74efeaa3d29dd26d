// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the orbits of a group are cut: which coordinates stay, and at what values.
#pragma once

#include "mechanics/quotient.hpp"
#include "pipeline.hpp"

namespace lagen {

/// The slice that `text` ("x=0, y=l") names. Without it: as many coordinates as the group has dimensions, at their
/// values in the first scene (that called default, where there is one), else at 0, such that the orbits cross it: where
/// possible at every point, else at the start of that scene. Throws UsageError for a text that names others, and
/// MathematicsError where there is none.
[[nodiscard]] Slice choose_slice(Graph& graph, const CheckedModel& checked, const InfinitesimalAction& action,
                                 const std::string& group, const std::string& text);

} // namespace lagen
