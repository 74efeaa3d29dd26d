// SPDX-License-Identifier: GPL-2.0-or-later
/// Unknowns that equations define: z with F(z, s) = 0, solved by Newton's method inside a kernel, between bounds where
/// a block has a bracket. The unknowns are ordinary inputs of the graph; a block says what they mean. Its derivative is
/// that of the implicit function,   dz = -F_z^-1 F_s ds.
#pragma once

#include "graph/core/graph.hpp"

#include <optional>

namespace lagen {

/// Intervals for unknowns whose equations stand apart: F_i holds z_i alone and falls with it. A missing end is
/// infinite.
struct Bracket {
    std::vector<std::optional<NodeId>> lower, upper; ///< shape (N), free of z
};

/// Unknowns that are angles: F_i = c_i cos z_i - b_i sin z_i vanishes where b_i cos z_i + c_i sin z_i is largest.
struct Angles {
    std::vector<NodeId> b, c; ///< shape (N), free of z
};

struct ImplicitBlock {
    std::string name;              ///< as in C++: "velocity"
    std::string documentation;     ///< the equations, e.g. "y with dL/dy^a = mu_a"
    std::vector<NodeId> unknowns;  ///< input nodes z, N of them
    std::vector<NodeId> residuals; ///< F, shape (N); may use the unknowns of earlier blocks
    std::vector<NodeId> jacobian;  ///< dF/dz, shape (N, N), entry (i, j) at i * N + j
    std::vector<NodeId> guess;     ///< where Newton's method starts, free of z
    std::vector<NodeId> sizes;     ///< rounding errors of F in units of epsilon, shape (N)
    std::vector<NodeId> inside;    ///< functions of z that are positive at a solution; elsewhere F may be another's
    MatrixStructure structure = MatrixStructure::general;
    /// Where it is there, z_i is the root of F_i in its interval, or the end next to it; there is no guess then.
    std::optional<Bracket> bracket = {};
    /// Where it is there, z_i is the angle of (b_i, c_i) that is nearest to the guess.
    std::optional<Angles> angles = {};
    /// The z of the last step is the guess of the next one; `guess` is where a run begins. Where there are no `angles`,
    /// dF/dz is negative definite at the z that is followed.
    bool follows = false;
};

/// A block with its Jacobian, differentiated here, and its sizes; `inside` is empty.
[[nodiscard]] ImplicitBlock implicit_block(Graph& graph, std::string name, std::string documentation,
                                           std::vector<NodeId> unknowns, std::vector<NodeId> residuals,
                                           std::vector<NodeId> guess, MatrixStructure structure);

/// The rounding error of each F_i as it is written, in units of epsilon, to first order: |f| for each operation,
/// carried on by the slopes of those behind it. Inputs and constants have none; operations without a slope pass on the
/// sum.
[[nodiscard]] std::vector<NodeId> rounding_sizes(Graph& graph, std::span<const NodeId> residuals);

/// What must be positive for `function` to be smooth at z: operands of roots, logarithms and real powers that depend on
/// the unknowns, and 1 - a^2 of asin(a) and acos(a). In its slopes they may have cancelled.
[[nodiscard]] std::vector<NodeId> positive_operands(Graph& graph, NodeId function, std::span<const NodeId> unknowns);

/// Where Newton's method starts. The unknowns of a condition f > 0 that shares none with others: 0 where f > 0 there,
/// else where f is largest, if it is quadratic, or 1, if it is affine. An unknown between affine conditions: the middle
/// of its interval. The others: the constants `start`, 0 where that is empty.
[[nodiscard]] std::vector<NodeId> guess_inside(Graph& graph, std::span<const NodeId> inside,
                                               std::span<const NodeId> unknowns, std::span<const Rational> start);

/// A block whose equations hold slopes of `function` in the unknowns: kept where that is smooth, and started there.
[[nodiscard]] ImplicitBlock gradient_block(Graph& graph, std::string name, std::string documentation,
                                           std::vector<NodeId> unknowns, std::vector<NodeId> residuals, NodeId function,
                                           std::span<const Rational> start);

/// The tangents of all unknowns along `seeds` (pairs input node, its tangent), behind the seeds: what `directional`
/// needs to differentiate through the blocks.
[[nodiscard]] std::vector<std::pair<NodeId, NodeId>> seeds_through(Graph& graph, std::span<const ImplicitBlock> blocks,
                                                                   std::vector<std::pair<NodeId, NodeId>> seeds);

/// d outputs[r] / d inputs[c] with the unknowns as functions of the inputs; one factorisation a block.
[[nodiscard]] std::vector<std::vector<NodeId>> jacobian_through(Graph& graph, std::span<const NodeId> outputs,
                                                                std::span<const NodeId> inputs,
                                                                std::span<const ImplicitBlock> blocks);

} // namespace lagen
