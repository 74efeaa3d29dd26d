// SPDX-License-Identifier: GPL-2.0-or-later
/// The first lines of a generated header, for its reader.
#pragma once

#include "emit/text_block.hpp"
#include "graph/kernel.hpp"

namespace lagen {

/// Licence, title, hash, how to regenerate, warnings, equations, operation counts, parameters and layout of the state.
void print_banner(TextBlock& out, const KernelModule& module);

/// Operations of the outputs as trees, every shared part counted at each of its uses (may be astronomical, hence
/// double).
[[nodiscard]] double count_unshared(const Graph& graph, std::span<const NodeId> outputs);

} // namespace lagen
