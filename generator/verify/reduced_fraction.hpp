// SPDX-License-Identifier: GPL-2.0-or-later
/// Fractions reduced by GiNaC, which is believed only where the zero decision confirms it, and their factors.
#pragma once

#include "proof/decide.hpp"
#include "symbolic/shortest_form.hpp"

namespace lagen {

/// The names of inputs in the order in which a person writes them, parameters before variables.
[[nodiscard]] Order writing_order(const Graph& graph, const ProofSetting& setting);

/// `tree`, which is `node`, as a reduced fraction in its shortest form; none where that is not proved to be the same,
/// or cannot be made.
[[nodiscard]] std::optional<Tree> reduced_fraction(Graph& graph, NodeId node, const Tree& tree, const Order& order,
                                                   const ZeroDecider& decider);

/// The factors of the numerator of a reduced fraction, without exponents and numbers; nothing where the node is too
/// long for that. Where it is defined the node vanishes exactly where one of them does.
[[nodiscard]] std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order,
                                                          const ZeroDecider& decider);

} // namespace lagen
