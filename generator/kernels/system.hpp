// SPDX-License-Identifier: GPL-2.0-or-later
/// rho and C on a graph, with t, the parameters and the base coordinates as inputs: what every form starts from.
#pragma once

#include "geometry/algebroid.hpp"
#include "graph/lower.hpp"

namespace lagen {

/// [e_a, e_b] contains value * e_c, a < b.
struct PairBracket {
    std::size_t a, b, c;
    NodeId value;
};

struct SystemNodes {
    NodeId time = 0;
    std::vector<NodeId> parameters;
    std::vector<NodeId> x;   ///< x^i, shape (n)
    std::vector<NodeId> rho; ///< rho^i_a, shape (n, r), at i * r + a
    std::vector<PairBracket> brackets;
    std::size_t r = 0;
};

[[nodiscard]] SystemNodes system_nodes(Graph& graph, const Model& model, const Algebroid& algebroid);

/// xdot^i = rho^i_a y^a, shape (n).
[[nodiscard]] std::vector<NodeId> base_velocity(Graph& graph, const SystemNodes& system, const std::vector<NodeId>& y);

/// rho_a(f) = rho^i_a df/dx^i, shape (r).
[[nodiscard]] std::vector<NodeId> along_anchor(Graph& graph, const SystemNodes& system,
                                               const std::vector<NodeId>& df_dx);

/// right_a -= p_c C^c_ab y^b.
void subtract_brackets(Graph& graph, const SystemNodes& system, const std::vector<NodeId>& p,
                       const std::vector<NodeId>& y, std::vector<NodeId>& right);

/// Partial derivatives of a function of (lanes, x, t).
struct Slopes {
    std::vector<NodeId> lanes; ///< shape (r), or as many as there are controls
    std::vector<NodeId> x;     ///< shape (n)
    NodeId t = 0;
};
[[nodiscard]] Slopes slopes_of(Graph& graph, NodeId f, const std::vector<NodeId>& lanes, const SystemNodes& system);

/// Pairs for `substitute`.
[[nodiscard]] std::vector<std::pair<NodeId, NodeId>> replacements(const std::vector<NodeId>& inputs,
                                                                  const std::vector<NodeId>& nodes);

/// t, parameters and base coordinates by name.
[[nodiscard]] Binding system_names(const Model& model, const SystemNodes& system);

/// Entries of an r x r matrix that are alone in their row and column and no constants: divisors of a solve.
[[nodiscard]] std::vector<NodeId> single_blocks(const Graph& graph, const std::vector<NodeId>& W, std::size_t r);

/// sum a_k b_k
[[nodiscard]] NodeId contraction(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b);

} // namespace lagen
