// SPDX-License-Identifier: GPL-2.0-or-later
/// Residuals over arrows of a groupoid: for all matrices W or, where that fails, for those of the group near 1: cay(A)
/// = (1 - A/2)^-1 (1 + A/2), A = s^c E_c. What is analytic holds on the connected group then.
#pragma once

#include "mechanics/system.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// The parameters, and for each of these points of M its coordinates, constraints and domain.
[[nodiscard]] ProofSetting arrow_setting(Graph& graph, const System& system,
                                         const std::vector<std::vector<NodeId>>& points);

/// A step that is no parameter of the model takes all values like one.
void append_step(ProofSetting& setting, const System& system);

/// As many inputs more, under names that no model can have.
[[nodiscard]] std::vector<NodeId> primed(Graph& graph, const std::vector<NodeId>& inputs);

class ArrowDecider {
  public:
    /// `elements`: inputs W of arrows, by rows. Keeps references to the graph and the groupoid.
    ArrowDecider(Graph& graph, ProofSetting setting, const Groupoid& groupoid,
                 std::vector<std::vector<NodeId>> elements, const ProofBudget& budget);

    [[nodiscard]] Decision decide(NodeId residual);

  private:
    [[nodiscard]] Decision on_matrices(NodeId residual) const;
    [[nodiscard]] Decision on_group(NodeId residual);

    Graph& graph_;
    ProofSetting setting_;
    const Groupoid& groupoid_;
    std::vector<std::vector<NodeId>> elements_;
    ProofBudget budget_;
    Replacements charted_;
    std::vector<NodeId> chart_variables_;
};

/// A residual over t, the step h > 0, the parameters and the coordinates of one arrow; of curves exp(xi) over xi, with
/// W = exp(xi).
[[nodiscard]] Decision decide_on_arrows(Graph& graph, const System& system, NodeId residual, const ProofBudget& budget);

// The elements of a group near 1 in coordinates, W = cay(s^c E_c): what holds on them and is analytic holds on the
// connected group.

struct GroupChart {
    std::vector<NodeId> s; ///< inputs NAME(1), NAME(2), ..
    Replacements element;  ///< the entries W by those of cay(s^c E_c)
};

/// Of a matrix whose inverse is written out in a proof.
inline constexpr std::size_t most_chart_rows = 6;

/// True where the group has such coordinates, in matrices that are not too large for a proof.
[[nodiscard]] bool has_chart(const Groupoid& groupoid);

/// `W`: inputs of a matrix of the groupoid.
[[nodiscard]] GroupChart group_chart(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& W,
                                     const std::string& name);

} // namespace lagen
