// SPDX-License-Identifier: GPL-2.0-or-later
/// A Lie groupoid over M in coordinates, on the graph. Its arrows g are (x, x_next, W): the point x = s(g), the point
/// x_next = t(g) where it is free, and a matrix W of a group H; what a kind lacks is empty.
///   pair      (x, y)      t = y      (x, y)(y, z) = (x, z)
///   group     W           M a point  W W'
///   action    (x, W)      t = x.W    (x, W)(x.W, W') = (x, W W')
///   Atiyah    (x, y, W)   t = y      (x, y, W)(y, z, W') = (x, z, W W')       locally, of M x H
/// The sections of its algebroid E are one a coordinate of x_next (of the frame d_i - A_i^c E_c where there is a
/// connection A), then one a generator E_c of H. For a curve eta of arrows from t(g) in the direction of e_a
///   <-e_a(g) = d/ds g eta(s),      ->e_a(h) = -d/ds eta(s)^-1 h
/// are the left and right invariant fields; on (x, x_next, W) they are
///   <-e_i = (0, d_i, -A_i^c(x_next) W E_c),     ->e_i = (-d_i, 0, -A_i^c(x) E_c W)
///   <-e_c = (0, 0, W E_c),                      ->e_c = (-rho_c(x), 0, E_c W),    rho_c = d/ds x.exp(s E_c)
/// with [<-a, <-b] = <-[a, b],  [->a, ->b] = -(->[a, b]),  [<-a, ->b] = 0.                     [Martinez 2001]
#pragma once

#include "geometry/section.hpp"

#include <span>

namespace lagen {

/// An arrow in coordinates; matrices by rows.
struct Arrow {
    std::vector<NodeId> x, next, W;
};

/// What a groupoid is made of.
struct GroupoidParts {
    Arrow arrow;                                 ///< inputs
    std::size_t size = 0;                        ///< W is size x size
    std::vector<NodeId> action;                  ///< (x.W)^i, shape (n); empty where the group does not move M
    std::vector<std::vector<NodeId>> generators; ///< E_c by rows, over parameters
    std::vector<std::size_t> rows; ///< as many entries of the matrices as there are generators, on which these are
                                   ///< linearly independent
    bool has_cayley_map = false;   ///< the matrices (1 - A/2)^-1 (1 + A/2), A = s^c E_c, lie in the group
    std::vector<std::vector<NodeId>> connection; ///< [i][c]: A_i^c over x; empty where there is none
};

struct Groupoid : GroupoidParts {
    std::vector<VectorField> left, right; ///< [a]: <-e_a, ->e_a, by the numbers of coordinates()

    [[nodiscard]] std::size_t n() const { return arrow.x.size(); }
    [[nodiscard]] std::size_t r() const { return left.size(); }
    /// How many sections are horizontal; they come first.
    [[nodiscard]] std::size_t horizontal() const { return arrow.next.size(); }
    /// x, x_next, W
    [[nodiscard]] std::vector<NodeId> coordinates() const;
};

[[nodiscard]] Groupoid make_groupoid(Graph& graph, GroupoidParts parts);

/// s(g), t(g), g h (of arrows with t(g) = s(h)), the arrow 1 at x, g^-1.
[[nodiscard]] std::vector<NodeId> source(const Arrow& g);
[[nodiscard]] std::vector<NodeId> target(Graph& graph, const Groupoid& groupoid, const Arrow& g);
[[nodiscard]] Arrow product(Graph& graph, const Groupoid& groupoid, const Arrow& g, const Arrow& h);
[[nodiscard]] Arrow identity(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& x);
[[nodiscard]] Arrow inverse(Graph& graph, const Groupoid& groupoid, const Arrow& g);

/// The entries of W that are 0 or 1 on the whole connected group, as `substitute` takes them: W - 1 is a sum of
/// products of the E_c, and no product has this entry.
[[nodiscard]] std::vector<std::pair<NodeId, NodeId>> constant_entries(Graph& graph, const GroupoidParts& parts,
                                                                      const std::vector<NodeId>& W);

/// Functions of the coordinates of an arrow, at the arrow g.
[[nodiscard]] std::vector<NodeId> at(Graph& graph, const Groupoid& groupoid, std::span<const NodeId> functions,
                                     const Arrow& g);

/// n x n matrices by rows: a b; 1.
[[nodiscard]] std::vector<NodeId> matrix_product(Graph& graph, const std::vector<NodeId>& a,
                                                 const std::vector<NodeId>& b, std::size_t n);
[[nodiscard]] std::vector<NodeId> matrix_one(Graph& graph, std::size_t n);
/// W^-1 b of an element W of the group: by its transpose where all generators are skew, which rounds without a bias.
[[nodiscard]] std::vector<NodeId> element_quotient(Graph& graph, const GroupoidParts& parts,
                                                   const std::vector<NodeId>& W, const std::vector<NodeId>& b);
/// a^-1 b
[[nodiscard]] std::vector<NodeId> matrix_quotient(Graph& graph, const std::vector<NodeId>& a,
                                                  const std::vector<NodeId>& b, std::size_t n);

} // namespace lagen
