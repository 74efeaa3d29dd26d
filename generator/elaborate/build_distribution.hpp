// SPDX-License-Identifier: GPL-2.0-or-later
/// The distribution of a nonholonomic model, as a person would write it, and on a graph.
#pragma once

#include "graph/core/lower.hpp"
#include "mechanics/system.hpp"
#include "model/model.hpp"

namespace lagen {

/// Of a nonholonomic model: sections and drift as given, or solved from the constraints B^A_a Y^a = beta^A for the Y
/// that are not kept, Y_S = B_S^-1 (beta - B_K y). Throws ModelError where the constraints fix a Y that is kept.
[[nodiscard]] WrittenDistribution build_distribution(const Model& model);

/// Declares y where it is new.
[[nodiscard]] Distribution lower_distribution(Graph& graph, Lowering& lower, const WrittenDistribution& written);

} // namespace lagen
