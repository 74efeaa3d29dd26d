// SPDX-License-Identifier: GPL-2.0-or-later
/// Outputs whose linear systems with a remembered Hessian are taken out: what is left is simplified as always, and the
/// elimination (graph/elimination/sparse_hessian.hpp) is put between the pieces as it is, since no pass could improve
/// it.
#pragma once

#include "graph/elimination/sparse_hessian.hpp"

#include <map>

namespace lagen {

class CutSolves {
  public:
    /// Cuts `outputs`; `pieces()` is empty where there is nothing to cut.
    CutSolves(Graph& graph, std::span<const NodeId> outputs);

    /// Nodes to be rewritten to equal values: the outputs and right sides, with inputs in the place of solutions, and
    /// the entries of the sparse Hessians.
    [[nodiscard]] const std::vector<NodeId>& pieces() const { return pieces_; }

    /// The outputs again, from the pieces in their order. `pivots` receives the divisors. Empty where a pivot is 0,
    /// or where the elimination would be too large.
    [[nodiscard]] std::vector<NodeId> join(std::span<const NodeId> pieces, std::vector<NodeId>& pivots) const;

  private:
    struct System {
        NodeId factor = 0;
        SparseHessian hessian;
        std::size_t first_piece = 0; ///< of its coefficients, then its entries
    };
    struct Solve {
        std::size_t system = 0;
        std::vector<std::pair<std::size_t, NodeId>> unknowns; ///< index in the solution, input that stands for it
        std::size_t first_piece = 0;                          ///< of its right side
        std::size_t order = 0;
    };

    void read_systems(const std::vector<NodeId>& nodes);
    void cut(const std::vector<NodeId>& nodes, std::span<const NodeId> outputs);
    [[nodiscard]] SparseHessian hessian_of(const System& system, std::span<const NodeId> pieces) const;

    Graph& graph_;
    std::size_t outputs_ = 0;
    std::vector<System> systems_;
    std::map<NodeId, std::size_t> system_of_; ///< by factor
    std::vector<Solve> solves_;               ///< ascending: a right side may use the solutions of earlier ones
    std::vector<NodeId> pieces_;
};

} // namespace lagen
