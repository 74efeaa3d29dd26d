// SPDX-License-Identifier: GPL-2.0-or-later
/// A bundle map Phi: E -> E' over phi: M -> M' of two systems, in coordinates x' = phi(x), y'^a = Phi^a_b(x) y^b, and
/// where both are of groupoids G, G' the map of arrows over phi: g -> (phi(s(g)), phi(t(g)), W'(g)).
///   admissible   rho'^i_c(phi) Phi^c_b = rho_b(phi^i)
///   morphism     rho_b(Phi^a_c) - rho_c(Phi^a_b) - Phi^a_d C^d_bc + C'^a_de(phi) Phi^d_b Phi^e_c = 0      b < c
/// The two say that Phi^* d' = d Phi^* on functions and on 1-forms. Of nonholonomic systems Phi is one of the ambient
/// algebroids, which should carry D onto D' and b into b' + D'.      [Martinez 2001; Cortes, de Leon, Marrero, Martinez
/// 2009]
#pragma once

#include "mechanics/system.hpp"

#include <map>

namespace lagen {

struct SystemMorphism {
    System source, target;
    // On the graph of the source:
    std::vector<NodeId> base;            ///< phi^i, shape (n')
    std::vector<NodeId> fibre;           ///< y'^a over x and y, shape (r'); empty: what the map of arrows says
    std::vector<NodeId> controls;        ///< u' over x, u, t; may be empty
    std::vector<NodeId> element;         ///< W' by rows over an arrow; empty where there is none
    std::map<NodeId, NodeId> parameters; ///< of the target's parameters and inputs, by its own graph; one that the
                                         ///< source does not know is a symbol of its own
    std::vector<NodeId> free_parameters; ///< those symbols
    bool of_groupoids = false;
};

/// Functions of the target where the map puts its coordinates, on a graph that holds the source's nodes.
class AlongMap {
  public:
    /// Coordinates x', time and parameters are known; y', mu', u' and arrows where they are set. Keeps references.
    AlongMap(Graph& graph, const SystemMorphism& morphism);
    void set(std::span<const NodeId> inputs, std::span<const NodeId> values);
    [[nodiscard]] std::vector<NodeId> operator()(std::span<const NodeId> functions) const;
    [[nodiscard]] NodeId operator()(NodeId function) const { return (*this)(std::span(&function, 1))[0]; }

  private:
    Graph& graph_;
    const System& target_;
    std::map<NodeId, NodeId> inputs_;
};

/// Phi^a_b, shape (r', r), by rows: d y'^a / d y^b.
[[nodiscard]] std::vector<NodeId> fibre_matrix(Graph& graph, const SystemMorphism& morphism);

/// A v, A by so many rows.
[[nodiscard]] std::vector<NodeId> applied(Graph& graph, const std::vector<NodeId>& A, std::size_t rows,
                                          const std::vector<NodeId>& v);

/// Phi^* f = Phi^a_b f_a of a covector on the target, shape (r), by this matrix.
[[nodiscard]] std::vector<NodeId> pulled_covector(Graph& graph, const std::vector<NodeId>& matrix, std::size_t r,
                                                  const std::vector<NodeId>& f);

/// The residuals `admissible` (b, i) and `morphism` (b, c, a) of a map with this matrix.
[[nodiscard]] ResidualList morphism_equations(Graph& graph, const SystemMorphism& morphism,
                                              const std::vector<NodeId>& matrix);

/// The image of an arrow of the source in coordinates x', x'_next, W'.
[[nodiscard]] Arrow image_of(Graph& graph, const SystemMorphism& morphism, const Arrow& g);

/// Of a morphism of groupoids: Phi^a_b at the arrows 1, read off the left invariant fields, and the entries of dW' that
/// lie outside of the algebra of the target's group.
struct DerivedFibre {
    std::vector<NodeId> matrix;  ///< shape (r', r)
    std::vector<NodeId> outside; ///< those that are not the constant 0
};
[[nodiscard]] DerivedFibre derived_fibre(Graph& graph, const SystemMorphism& morphism);

/// `second` after `first`, whose target is `second`'s source.
[[nodiscard]] SystemMorphism composition(const SystemMorphism& first, const SystemMorphism& second);

} // namespace lagen
