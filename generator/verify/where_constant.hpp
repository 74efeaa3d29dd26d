// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a function whose rate vanishes is constant: along each stretch of a motion on which the function is defined
/// and does not jump. abs(x)/x has a hole at x = 0, atan2(v, u) a cut at v = 0, u < 0, log(x) an end at x = 0; their
/// derivatives do not show it.
///
/// One rule: an operation of the function asks for what the operator table says, that it is defined (a divisor is not
/// 0, a radicand is positive) and does not jump (sign, comparisons, the cut of atan2); kinks are no jumps. A condition
/// is left out where it follows from the domain, which a run does not leave (but for f != 0, which that of a header
/// steps over), and where it is about a constant of the motion, so that no motion crosses it. What is left stands
/// beside the verdict. That L is not defined at x = 0 as it is written is no reason to leave x != 0 out: a run steps
/// over that, and its equations may have lost the divisor.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "verify/verify.hpp"

#include <functional>
#include <map>
#include <memory>

namespace lagen {

class WhereConstant {
  public:
    /// Is a function proved to be constant along every motion, given that it does not jump?
    using Conserved = std::function<bool(NodeId)>;

    struct Conditions {
        std::vector<std::string> texts; ///< sufficient together
        std::string obstacle;           ///< why they cannot be named, or none can be met; may be empty
    };

    WhereConstant(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved);

    /// `functions`: a function whose rate vanishes and what else must be defined of it; `divisors`: of its rate.
    [[nodiscard]] Conditions of(const std::vector<NodeId>& functions, const std::vector<NamedNode>& divisors = {});

    /// Where the functions are defined and do not jump and the comparisons `domain` hold.
    [[nodiscard]] Conditions reaching(const std::vector<NodeId>& functions, const std::vector<NodeId>& domain);

    /// Of a check that is proved because the rate vanishes: `Check::where`. It becomes `undecided` where there is an
    /// obstacle.
    static void restrict(Check& check, const Conditions& conditions);

  private:
    struct Condition {
        NodeId f;
        bool positive;    ///< f > 0; else f != 0
        std::string name; ///< of f, where it has one
    };

    void drop_what_is_stepped_over();
    [[nodiscard]] bool depends_only_on_parameters(NodeId f);
    [[nodiscard]] bool is_conserved(NodeId f);
    void require(NodeId node);
    void require_defined(NodeId node);
    void require_off_cut(NodeId node);
    void require_regular(NodeId factor);
    void require_nonzero(NodeId f);
    void require_nonzero_factors(NodeId f, bool but_conserved);
    void require_positive(NodeId f);
    void require_divisor(const NamedNode& divisor);
    void add(NodeId f, bool positive, const std::string& name = {});
    [[nodiscard]] ProofSetting with_conditions_but(std::size_t left_out);
    void drop_implied();
    [[nodiscard]] Conditions conditions(const std::vector<NodeId>& functions);
    [[nodiscard]] bool hold_somewhere(const std::vector<NodeId>& functions);
    [[nodiscard]] std::string text_of(const Condition& condition);

    Graph& graph_;
    ProofSetting setting_; ///< the domain alone: nothing is said of where functions are defined
    std::vector<NodeId> defined_;
    std::unique_ptr<ZeroDecider> decider_;
    Conserved conserved_;
    std::map<NodeId, bool> known_conserved_;
    std::vector<Condition> conditions_;
    std::string obstacle_; ///< why a condition cannot be named
};

} // namespace lagen
