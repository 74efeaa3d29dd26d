// SPDX-License-Identifier: GPL-2.0-or-later
/// Sections of a Lie algebroid E and vector fields on its base: the anchor and the bracket as functions.
///   rho(s) = s^a rho^i_a d/dx^i,      X(f) = X^i df/dx^i
///   [s, t]^c = rho(s)(t^c) - rho(t)(s^c) + s^a t^b C^c_ab                                  [Martinez 2001]
#pragma once

#include "geometry/algebroid.hpp"

namespace lagen {

/// s = s^a e_a: its components that are not zero by structure, by a.
using Section = Column;
/// X = X^i d/dx^i: likewise, by i.
using VectorField = Column;

/// First partial derivatives with respect to the base coordinates, zero ones left out, computed once a node.
class BaseGradient {
  public:
    BaseGradient(Graph& graph, const std::vector<NodeId>& x);
    [[nodiscard]] Graph& graph() { return graph_; }
    /// df/dx^i
    const Column& of(NodeId f);
    /// Appends the nonzero products X^i df/dx^i to `terms`.
    void append_along(std::vector<NodeId>& terms, const VectorField& field, NodeId f);
    /// X(f)
    [[nodiscard]] NodeId along(const VectorField& field, NodeId f);

  private:
    Graph& graph_;
    std::map<NodeId, std::size_t> places_; ///< of the coordinates: i by x^i
    std::map<NodeId, Column> known_;
};

/// f_a s^a
[[nodiscard]] NodeId pairing(Graph& graph, const std::vector<NodeId>& f, const Section& s);

/// e_a
[[nodiscard]] Section basis_section(Graph& graph, std::size_t a);

/// rho(s), entries whose terms cancel left out.
[[nodiscard]] VectorField anchor_of(Graph& graph, const Algebroid& algebroid, const Section& s);

/// [s, t] of the algebroid. Components with at least one term are listed; they may be the constant 0 where terms
/// cancel.
[[nodiscard]] Section bracket(BaseGradient& partial, const Algebroid& algebroid, const Section& s, const Section& t);

/// [X, Y]^i = X(Y^i) - Y(X^i) of vector fields on the base, listed likewise.
[[nodiscard]] VectorField bracket(BaseGradient& partial, const VectorField& X, const VectorField& Y);

/// a + b, or a - b.
[[nodiscard]] Column sum(Graph& graph, const Column& a, const Column& b);
[[nodiscard]] Column difference(Graph& graph, const Column& a, const Column& b);

} // namespace lagen
