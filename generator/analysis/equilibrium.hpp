// SPDX-License-Identifier: GPL-2.0-or-later
/// An equilibrium of sdot = f(s, u) near a start, and the equations linearised there:
///   d/dt ds = A ds + B du,      A = df/ds, B = df/du.
/// The inputs u are held at first. Where no s is found with f(s, u) = 0 they are unknowns too, and (s, u) is what the
/// steps of least length end at (proof/least_squares.hpp), from the start or else from the inputs that best keep it at
/// rest. Coordinates that no rate depends on stay at the start.
///
/// The state stays on the leaf of the start (analysis/leaf.hpp): the first steps go along the fields that make it, the
/// last ones on the levels of functions that are constant on it. Where these are too few the leaf is kept in floating
/// point, and the certificate is none.
///
/// Certificate: coordinates that are 0 are taken out, with the equations that hold identically then; so is all but a
/// point of a family, by g.(z - z_0) = 0 along directions g that the equations leave free. Of the rest, as many
/// equations as unknowns, an interval Newton step proves a root (proof/interval_newton.hpp). Where the equations depend
/// on each other there is no certificate.
#pragma once

#include "graph/unknowns/implicit.hpp"
#include "proof/eigenvalues.hpp"

namespace lagen {

/// Everything over `state`, `inputs` and the unknowns of `implicit` alone.
struct MotionEquations {
    std::vector<NodeId> state, inputs;   ///< s and u: input nodes, shapes (n), (m)
    std::vector<NodeId> rates;           ///< f, shape (n)
    std::vector<ImplicitBlock> implicit; ///< what f is written with beside them
    std::vector<NodeId> constraints;     ///< functions of s that are 0 along every motion
    std::vector<NodeId> casimirs;        ///< and those that are so on the leaf of the start
    std::vector<NodeId> domain;          ///< comparisons that hold
    std::vector<NodeId> base; ///< the first of the state, which the leaves are in; empty: as the functions say
    std::vector<std::vector<NodeId>> fields; ///< tangent to the leaves, over the base
};

/// How the leaf of the start was kept.
enum class LeafKept {
    by_functions,      ///< by as many as there are directions off it
    in_floating_point, ///< there are more directions than functions
    approached         ///< the equilibrium is on a smaller leaf, which motions only tend to
};

/// Values of the state, the inputs, the unknowns of the blocks.
struct MotionPoint {
    std::vector<double> state, inputs, unknowns;
};

struct Equilibrium {
    MotionPoint at;
    bool moves_inputs = false; ///< none was found with the inputs of the start
    LeafKept leaf_kept = LeafKept::by_functions;
    bool certified = false;
    double radius = 0;                           ///< where certified: one is no farther than this in each coordinate
    double residual = 0;                         ///< the largest |f| at these numbers
    std::vector<std::vector<double>> A, B, leaf; ///< by rows: df/ds, df/du, and slopes of what the leaf is made of
    std::vector<proof::Eigenvalue> eigenvalues;  ///< of A, from more digits than a double has
};

/// Throws MathematicsError where Newton's method ends at none, or at one outside the domain or at a kink or jump of f.
/// `starts`, at least one on one leaf: tried in turn, each with its inputs held, then each with inputs that move, then
/// each with inputs that have moved first.
[[nodiscard]] Equilibrium equilibrium_near(Graph& graph, const MotionEquations& equations,
                                           const std::vector<MotionPoint>& starts);

} // namespace lagen
