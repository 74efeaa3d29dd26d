// SPDX-License-Identifier: GPL-2.0-or-later
/// What would mend a refuted algebroid: one sign, one entry or the order of one pair, with which every equation is
/// proved again; or, where there is no such change, one with which at least the anchor equations of a pair are.
#pragma once

#include "advice/repair.hpp"
#include "algebroid/structure_equations.hpp"
#include "verify/judge.hpp"

#include <functional>

namespace lagen {

class RepairSearch {
  public:
    /// `editable`: what the model file gives itself, so that a hint can ask to change it.
    RepairSearch(Graph& graph, BaseGradient& partial, Judge& judge, const WrittenAlgebroid& names,
                 const Algebroid& lowered, const BaseFunctions& functions, Editable editable);

    /// A hint for each residual of structure_equations, "" where there is none (and where it is not refuted). The
    /// effort is bounded by a count of operations, so that the same model has the same hints everywhere.
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
    const WrittenAlgebroid& names_;
    Algebroid lowered_; ///< changed and changed back by each trial
    BaseFunctions functions_;
    Editable editable_;
    std::size_t effort_ = 0, proofs_ = 0;
};

} // namespace lagen
