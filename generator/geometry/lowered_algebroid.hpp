// SPDX-License-Identifier: GPL-2.0-or-later
/// rho and C as sparse lists of graph nodes, as the structure equations walk them.
#pragma once

#include "geometry/algebroid.hpp"
#include "graph/graph.hpp"
#include "graph/lower.hpp"

namespace lagen {

/// One nonzero entry of a column: rho^i_a for fixed a, or C^c_ab for fixed (a, b).
struct ColumnEntry {
    std::size_t index; ///< i or c
    NodeId value;
};
using Column = std::vector<ColumnEntry>; ///< ascending index

struct LoweredAlgebroid {
    std::vector<NodeId> x, y;    ///< input nodes
    std::vector<Column> anchor;  ///< anchor[a]: rho^i_a
    std::vector<Column> bracket; ///< bracket[a * r + b]: C^c_ab; the order that the model leaves out is the negative
    std::vector<bool> given;     ///< given[a * r + b]: the model lists this order

    [[nodiscard]] std::size_t r() const { return anchor.size(); }
    [[nodiscard]] const Column& C(std::size_t a, std::size_t b) const { return bracket[a * r() + b]; }
    /// All entries of anchor and bracket.
    [[nodiscard]] std::vector<NodeId> entries() const;
    /// The value at `index`, or the constant 0.
    [[nodiscard]] static NodeId entry(Graph& graph, const Column& column, std::size_t index);
};

[[nodiscard]] LoweredAlgebroid lower_algebroid(Graph& graph, Lowering& lower, const Algebroid& algebroid);

/// First partial derivatives with respect to the base coordinates, zero ones left out, computed once a node.
class BaseGradient {
  public:
    BaseGradient(Graph& graph, const std::vector<NodeId>& x) : graph_(graph), x_(x) {}
    const Column& of(NodeId f);
    /// Appends the nonzero products rho^i_a df/dx^i to `terms`.
    void append_anchor_derivative(std::vector<NodeId>& terms, const Column& anchor, NodeId f, bool negative);

  private:
    Graph& graph_;
    std::vector<NodeId> x_;
    std::map<NodeId, Column> known_;
};

} // namespace lagen
