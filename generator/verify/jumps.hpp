// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions that jump although their derivatives do not show it: atan2(v, u) across v = 0, u < 0, abs(x)/x across
/// x = 0, atan(1/x). A function whose rate vanishes is constant along a motion only where it does not jump.
///
/// How a function of the state goes along a motion is followed from node to node:
/// - analytic, or continuous with kinks: it does not jump;
/// - a quotient of analytic functions p/q: p = c q before a zero of q, hence behind it, since both are analytic; and
///   likewise with logarithms of analytic functions in p and q;
/// - the sum of such a quotient and something continuous: what is bounded at a pole is removable there;
/// - everything else that may meet a zero of a divisor, the pole of a tangent or a cut is said to jump.
/// Functions of constants of the motion are constants, and what depends on parameters alone is one. A function may
/// leave the set where it is defined for a while, as sqrt(x) does: nothing is said of its value after.
#pragma once

#include "verify/motion_divisors.hpp"

#include <functional>
#include <map>

namespace lagen {

class Continuity {
  public:
    /// Is the rate of a node proved to vanish? May be empty.
    using Conserved = std::function<bool(NodeId)>;

    /// `setting.defined`: what the equations of motion are made of, and nothing else: it is defined all along a motion,
    /// so that its divisors do not vanish there.
    Continuity(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved);

    /// What is known to be nonzero along motions, to which more may be added before the first question.
    [[nodiscard]] MotionDivisors& divisors() { return divisors_; }

    /// What jumps in `f`, and where, unless it is shown that no motion meets it; empty: nothing.
    [[nodiscard]] std::string jump_of(NodeId f);

    /// A proof that rests on the derivatives of `f` becomes `undecided` where f jumps.
    void respect_jumps(Decision& decision, NodeId f);

  private:
    enum class Course { analytic, continuous, quotient, sum, jumps };
    struct Along {
        Course course = Course::analytic;
        NodeId hole = 0;       ///< of quotients and sums: what may vanish
        std::string jump;      ///< of what jumps
        bool constant = false; ///< along every motion
    };

    [[nodiscard]] const Along& along(NodeId f);
    [[nodiscard]] Along step(NodeId node);
    [[nodiscard]] Along operation(NodeId node);
    [[nodiscard]] Along function(NodeId node);
    [[nodiscard]] Along analytic_inside(NodeId node);
    void classify_motion();
    [[nodiscard]] Along add(NodeId node) const;
    [[nodiscard]] Along multiply(const Along& a, const Along& b, NodeId node) const;
    [[nodiscard]] Along reciprocal(NodeId divisor, const Along& below, NodeId node);
    [[nodiscard]] Along smooth_function(NodeId node) const;
    [[nodiscard]] Along kinked(NodeId node, bool smooth) const;
    [[nodiscard]] Along logarithm(NodeId node) const;
    [[nodiscard]] Along angle(NodeId node);
    [[nodiscard]] Along solution(NodeId node);
    [[nodiscard]] Along jumping(NodeId node, NodeId hole) const;

    [[nodiscard]] bool is_smooth(NodeId node);

    Graph& graph_;
    std::vector<NodeId> motion_; ///< what it is made of, until it is classified
    MotionDivisors divisors_;
    Conserved conserved_;
    bool analytic_motion_ = true;
    std::map<NodeId, Along> along_;
};

} // namespace lagen
