// SPDX-License-Identifier: GPL-2.0-or-later
/// A Lie algebroid E -> M in local coordinates, on the graph: the anchor rho(e_a) = rho^i_a d/dx^i and the bracket
/// [e_a, e_b] = C^c_ab e_c as sparse columns. n = 0 (a Lie algebra), r > n, r < n and directions in ker rho all occur.
/// Whether the two satisfy the structure equations is another question (geometry/structure_equations.hpp).
#pragma once

#include "graph/core/graph.hpp"

namespace lagen {

/// One nonzero entry of a column: rho^i_a for fixed a, C^c_ab for fixed (a, b), or the component s^a of a section.
struct ColumnEntry {
    std::size_t index; ///< i, c or a
    NodeId value;
};
using Column = std::vector<ColumnEntry>; ///< ascending index

struct Algebroid {
    std::vector<NodeId> x, y;   ///< input nodes: base coordinates, shape (n); fibre coordinates, shape (r)
    std::vector<Column> anchor; ///< anchor[a]: rho^i_a
    std::vector<Column>
        bracket;             ///< bracket[a * r + b]: C^c_ab; an order that is not given is the negative of the other
    std::vector<bool> given; ///< given[a * r + b]: this order of the pair was given

    [[nodiscard]] std::size_t n() const { return x.size(); }
    [[nodiscard]] std::size_t r() const { return anchor.size(); }
    [[nodiscard]] const Column& C(std::size_t a, std::size_t b) const { return bracket[a * r() + b]; }
    /// All entries of anchor and bracket.
    [[nodiscard]] std::vector<NodeId> entries() const;
    /// The value at `index`, or the constant 0.
    [[nodiscard]] static NodeId entry(Graph& graph, const Column& column, std::size_t index);
};

/// Fills an algebroid entry by entry; zeros are left out. `finish` sorts the columns and completes C by
/// C^c_ba = -C^c_ab where one order of a pair alone was given.
class AlgebroidBuilder {
  public:
    AlgebroidBuilder(Graph& graph, std::vector<NodeId> x, std::size_t r);
    void add_anchor(std::size_t i, std::size_t a, NodeId value);
    void add_bracket(std::size_t c, std::size_t a, std::size_t b, NodeId value);
    /// `y`: the inputs of the fibre coordinates, shape (r).
    [[nodiscard]] Algebroid finish(std::vector<NodeId> y);

  private:
    Graph& graph_;
    Algebroid result_;
};

} // namespace lagen
