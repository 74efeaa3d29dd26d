// SPDX-License-Identifier: GPL-2.0-or-later
/// What a groupoid claims: that its action is a right action of the group, and that the algebroid given beside it is
/// its own.
///   unit       x.1 = x
///   action     x.(W W') = (x.W).W'
#include "graph/calculus/differentiate.hpp"
#include "groupoid/algebroid_of.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// The action property with two matrices of inputs, and the same in charts of the group.
class ActionClaims {
  public:
    ActionClaims(Graph& graph, const System& system, const ProofBudget& budget)
        : graph_(graph), groupoid_(*system.groupoid), W_(groupoid_.arrow.W), second_(primed(graph, W_)),
          decider_(graph, arrow_setting(graph, system, {groupoid_.arrow.x}), groupoid_, {W_, second_}, budget)
    {
        const Arrow g{groupoid_.arrow.x, {}, W_}, h{target(graph, groupoid_, g), {}, second_};
        const std::vector<NodeId> both = target(graph, groupoid_, h);
        const Arrow first{groupoid_.arrow.x, {}, second_};
        const Arrow other{target(graph, groupoid_, first), {}, W_};
        right_ = differences(target(graph, groupoid_, product(graph, groupoid_, g, h)), both);
        left_ = differences(target(graph, groupoid_, product(graph, groupoid_, g, h)), target(graph, groupoid_, other));
    }

    [[nodiscard]] Decision decide(NodeId residual) { return decider_.decide(residual); }

    /// Whether x.(W W') = (x.W').W, by a proof.
    [[nodiscard]] bool is_left_action()
    {
        return std::ranges::all_of(left_, [&](NodeId residual) {
            return graph_.is_zero(residual) || decide(residual).status == ProofStatus::proved;
        });
    }

    /// x.(W W') - (x.W).W', shape (n)
    [[nodiscard]] const std::vector<NodeId>& residuals() const { return right_; }

  private:
    [[nodiscard]] std::vector<NodeId> differences(const std::vector<NodeId>& a, const std::vector<NodeId>& b)
    {
        std::vector<NodeId> out;
        for (std::size_t i = 0; i < a.size(); ++i) out.push_back(graph_.subtract(a[i], b[i]));
        return out;
    }

    Graph& graph_;
    const Groupoid& groupoid_;
    std::vector<NodeId> W_, second_;
    ArrowDecider decider_;
    std::vector<NodeId> right_, left_; ///< x.(W W') - (x.W).W', x.(W W') - (x.W').W
};

/// Every entry of two columns, those that neither has left out.
std::set<std::size_t> indices_of(const Column& a, const Column& b)
{
    std::set<std::size_t> indices;
    for (const Column* column : {&a, &b})
        for (const ColumnEntry& entry : *column) indices.insert(entry.index);
    return indices;
}

} // namespace

void Claims::decide_action(StructureReport& structure)
{
    const Groupoid& groupoid = *system_.groupoid;
    if (groupoid.action.empty()) return;
    const std::vector<NodeId>& x = system_.algebroid.x;
    const std::vector<NodeId> moved = target(graph_, groupoid, identity(graph_, groupoid, x));
    for (std::size_t i = 0; i < x.size(); ++i)
        append_equality(structure, "unit", {graph_.input_name(x[i])}, moved[i], x[i]);
    ActionClaims claims(graph_, system_, judge_->decider().budget());
    bool hinted = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (graph_.is_zero(claims.residuals()[i])) {
            ++structure.trivial;
            continue;
        }
        Check check{"action", {graph_.input_name(x[i])}, claims.decide(claims.residuals()[i])};
        if (check.decision.status != ProofStatus::proved && !hinted) {
            hinted = true;
            if (claims.is_left_action())
                check.hint = "this is a left action; the right one has the inverse of the element: transpose(W) of a "
                             "rotation, inverse(W)";
        }
        structure.checks.push_back(std::move(check));
    }
}

/// A check that `value` is `wanted`; trivial where they are one node.
void Claims::append_equality(StructureReport& structure, const char* name, std::vector<std::string> indices,
                             NodeId value, NodeId wanted)
{
    const NodeId residual = graph_.subtract(value, wanted);
    if (graph_.is_zero(residual)) {
        ++structure.trivial;
        return;
    }
    structure.checks.push_back({name, std::move(indices), judge_->decide(residual)});
}

void Claims::decide_groupoid(StructureReport& structure)
{
    if (!system_.groupoid) return;
    decide_action(structure);
    if (!system_.groupoid_is_claim) return;
    const Algebroid& given = system_.algebroid;
    const Algebroid computed = algebroid_of(graph_, *system_.groupoid, given.y).algebroid;
    const auto section = [&](std::size_t a) { return graph_.input_name(given.y[a]); };
    const char* name = "algebroid_of_groupoid";
    for (std::size_t a = 0; a < given.r(); ++a)
        for (const std::size_t i : indices_of(given.anchor[a], computed.anchor[a]))
            append_equality(structure, name, {section(a), graph_.input_name(given.x[i])},
                            Algebroid::entry(graph_, given.anchor[a], i),
                            Algebroid::entry(graph_, computed.anchor[a], i));
    for (std::size_t a = 0; a < given.r(); ++a)
        for (std::size_t b = a + 1; b < given.r(); ++b)
            for (const std::size_t c : indices_of(given.C(a, b), computed.C(a, b)))
                append_equality(structure, name, {section(a), section(b), section(c)},
                                Algebroid::entry(graph_, given.C(a, b), c),
                                Algebroid::entry(graph_, computed.C(a, b), c));
}

} // namespace lagen
