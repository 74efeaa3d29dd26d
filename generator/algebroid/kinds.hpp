// SPDX-License-Identifier: GPL-2.0-or-later
/// Algebroids that are known by a few words, on a graph that gains their coordinates as inputs.
#pragma once

#include "algebra/named_algebra.hpp"
#include "algebroid/algebroid.hpp"

namespace lagen {

/// TM: rho(e_i) = d/dx^i, C = 0.
[[nodiscard]] Algebroid tangent(Graph& graph, const std::vector<std::string>& x, const std::vector<std::string>& y);

/// A Lie algebra over a point: [e_a, e_b] = C^c_ab e_c for the constants listed, a < b.
[[nodiscard]] Algebroid lie_algebra(Graph& graph, const std::vector<std::string>& y,
                                    const std::vector<StructureConstant>& constants);

} // namespace lagen
