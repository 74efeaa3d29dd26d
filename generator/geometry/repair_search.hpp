// SPDX-License-Identifier: GPL-2.0-or-later
/// What would mend a refuted algebroid: one sign, one entry or the order of one pair, with which every equation is
/// proved again; or, where there is no such change, one with which at least the anchor equations of a pair are.
#pragma once

#include "geometry/judge.hpp"
#include "geometry/repair.hpp"
#include "geometry/structure_equations.hpp"

#include <functional>

namespace lagen {

/// Functions of the base that the anchor must annihilate, checked together with the structure equations.
struct BaseFunctions {
    std::vector<NodeId> constraints; ///< tangency
    std::vector<NodeId> casimirs;
};

/// antisymmetry, anchor, jacobi, tangency and casimir, in this order.
[[nodiscard]] ResidualList all_equations(Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid,
                                         const BaseFunctions& functions);

class RepairSearch {
  public:
    /// `editable`: what the model file gives itself, so that a hint can ask to change it.
    RepairSearch(Graph& graph, BaseGradient& partial, Judge& judge, const Algebroid& names,
                 const LoweredAlgebroid& lowered, const BaseFunctions& functions, Editable editable);

    /// A hint for each residual of all_equations, "" where there is none (and where it is not refuted). The effort is
    /// bounded by a count of operations, so that the same model has the same hints everywhere.
    [[nodiscard]] std::vector<std::string> hints(const ResidualList& list);

  private:
    struct Refuted {
        const Residual* residual;
        Witness witness;
    };
    using Holds = std::function<bool(const Repair&)>;

    [[nodiscard]] std::vector<Repair> needed_values(const std::vector<Refuted>& refuted);
    [[nodiscard]] std::vector<Repair> global_repairs(const std::vector<Refuted>& refuted);
    [[nodiscard]] std::string local_hint(const ResidualList& list, std::size_t a, std::size_t b);
    /// The first two of `candidates` for which `holds`.
    [[nodiscard]] std::vector<Repair> select(const std::vector<Repair>& candidates, const Holds& holds);
    [[nodiscard]] bool fits(const std::vector<Refuted>& refuted, const Repair& repair);
    [[nodiscard]] bool all_hold(const Repair& repair);
    [[nodiscard]] bool anchor_holds(const Repair& repair, std::size_t a, std::size_t b);
    [[nodiscard]] bool affords(std::size_t operations);

    Graph& graph_;
    BaseGradient& partial_;
    Judge& judge_;
    const Algebroid& names_;
    LoweredAlgebroid lowered_; ///< changed and changed back by each trial
    BaseFunctions functions_;
    Editable editable_;
    std::size_t effort_ = 0, proofs_ = 0;
};

} // namespace lagen
