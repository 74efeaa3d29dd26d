// SPDX-License-Identifier: GPL-2.0-or-later
/// The elements of a group near 1 in coordinates, W = cay(s^c E_c): what holds on them and is analytic holds on the
/// connected group.
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

struct GroupChart {
    std::vector<NodeId> s; ///< inputs NAME(1), NAME(2), ..
    Replacements element;  ///< the entries W by those of cay(s^c E_c)
};

/// Of a matrix whose inverse is written out in a proof.
inline constexpr std::size_t most_chart_rows = 6;

/// Whether the group has such coordinates, in matrices that are not too large for a proof.
[[nodiscard]] bool has_chart(const Groupoid& groupoid);

/// `W`: inputs of a matrix of the groupoid.
[[nodiscard]] GroupChart group_chart(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& W,
                                     const std::string& name);

} // namespace lagen
