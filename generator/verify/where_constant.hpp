// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a function whose rate vanishes is constant: along each stretch of a motion on which the function is defined
/// and does not jump. abs(x)/x has a hole at x = 0, atan2(v, u) a cut at v = 0, u < 0, log(x) an end at x = 0; their
/// derivatives do not show it.
///
/// One rule: an operation of the function asks for what the operator table says, that it is defined (a divisor is not
/// 0, a radicand is positive) and does not jump (sign, comparisons, the cut of atan2); kinks are no jumps. A condition
/// is left out where it is proved, where the motion itself is not defined without it, and where it is about a constant
/// of the motion, so that no motion crosses it. What is left stands beside the verdict.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "verify/verify.hpp"

#include <functional>
#include <map>
#include <memory>
#include <set>

namespace lagen {

class WhereConstant {
  public:
    /// Is a function proved to be constant along every motion, given that it does not jump?
    using Conserved = std::function<bool(NodeId)>;

    /// `setting.defined`: what the equations of motion are made of as they are written, and nothing else: a motion ends
    /// where one of these is not defined.
    WhereConstant(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved);

    /// Of a check that is proved because the rate of a function vanishes: its conditions, `Check::where`. `functions`:
    /// the function and what else must be defined of it; `divisors`: of its rate. The check becomes `undecided` where a
    /// condition is too long to be read, and where no point is found that satisfies all of them.
    void restrict(Check& check, const std::vector<NodeId>& functions, const std::vector<NamedNode>& divisors = {});

  private:
    struct Condition {
        NodeId f;
        bool positive;    ///< f > 0; else f != 0
        std::string name; ///< of f, where it has one
    };

    void know_nonzero(NodeId divisor);
    [[nodiscard]] bool is_nonzero(NodeId f) const;
    [[nodiscard]] bool is_positive(NodeId f) const;
    [[nodiscard]] bool is_conserved(NodeId f);
    void require(NodeId node);
    void require_off_cut(NodeId node);
    void require_regular(NodeId factor);
    void require_nonzero(NodeId f);
    void require_nonzero_factors(NodeId f);
    void require_positive(NodeId f);
    void require_divisor(const NamedNode& divisor);
    void add(NodeId f, bool positive, const std::string& name = {});
    [[nodiscard]] ProofSetting with_conditions_but(std::size_t left_out);
    void drop_implied();
    [[nodiscard]] bool hold_somewhere(const std::vector<NodeId>& functions);
    [[nodiscard]] std::string text_of(const Condition& condition);

    Graph& graph_;
    ProofSetting setting_;
    std::unique_ptr<ZeroDecider> decider_;
    Conserved conserved_;
    std::map<NodeId, bool> known_conserved_;
    std::set<NodeId> certain_; ///< defined all along a motion
    std::set<NodeId> nonzero_; ///< nonzero there
    std::vector<Condition> conditions_;
    std::string obstacle_; ///< why a condition cannot be named
};

} // namespace lagen
