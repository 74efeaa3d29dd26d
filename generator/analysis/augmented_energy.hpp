// SPDX-License-Identifier: GPL-2.0-or-later
/// H and conserved functions F_i on E* with their first two derivatives and the flows zdot = {F, z} that they generate,
/// in balls: what relative equilibria are sought and judged with.
#pragma once

#include "mechanics/hamilton.hpp"
#include "proof/ball_matrix.hpp"

namespace lagen {

/// A function at a point: n coordinates.
struct FunctionJet {
    proof::Ball value;
    proof::BallMatrix slope;      ///< df/dz^k, n x 1
    proof::BallMatrix curvature;  ///< n x n
    proof::BallMatrix flow;       ///< {f, z^k}, n x 1
    proof::BallMatrix flow_slope; ///< of the flow, row k by d/dz^l, n x n
};

using Doubles = std::vector<double>;

/// The middles of a column, and exact balls around numbers.
[[nodiscard]] Doubles middles(const proof::BallMatrix& column);
[[nodiscard]] proof::Ball exact_ball(double value);
[[nodiscard]] std::vector<proof::Ball> exact_balls(const Doubles& values);

class AugmentedEnergy {
  public:
    static constexpr slong precision = 256;

    /// `F`: functions of z alone. The graph lives longer.
    AugmentedEnergy(Graph& graph, const System& system, NodeId H, const std::vector<NodeId>& F, std::vector<NodeId> z);

    [[nodiscard]] std::size_t n() const { return z_.size(); }
    [[nodiscard]] std::size_t count() const { return functions_.size() - 1; } ///< of the F
    [[nodiscard]] const std::vector<NodeId>& z() const { return z_; }
    /// dH/dz^k, or dF_i/dz^k.
    [[nodiscard]] NodeId slope_node(std::optional<std::size_t> i, std::size_t k) const;

    /// True where the flow of F_i may move z^k at some point.
    [[nodiscard]] bool moves(std::size_t i, std::size_t k) const { return functions_[i + 1].moves[k]; }

    /// H, then the F.
    [[nodiscard]] std::vector<FunctionJet> at(const std::vector<proof::Ball>& z, slong bits = precision) const;
    /// Exactly; nothing where an operation is not rational. By functions the value, then the slopes.
    [[nodiscard]] std::optional<std::vector<std::vector<Rational>>> exactly_at(const std::vector<Rational>& z) const;

  private:
    struct Nodes {
        NodeId value;
        std::vector<NodeId> slope, curvature, flow, flow_slope;
        std::vector<bool> moves;
    };
    std::vector<NodeId> z_;
    std::vector<Nodes> functions_;
    std::optional<proof::Evaluation> all_, slopes_;
};

} // namespace lagen
