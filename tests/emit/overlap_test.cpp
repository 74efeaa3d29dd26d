// SPDX-License-Identifier: GPL-2.0-or-later
/// The order of long bodies: a chain of divisions beside sums that do not need it.
#include "emit/overlap_steps.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;

namespace {

/// x_k = 1/(c_k + x_(k-1)), s_k = s_(k-1) c_k + c_k^2, and the product of their ends.
struct TwoChains {
    explicit TwoChains(int length)
    {
        NodeId x = graph.input("x");
        NodeId s = graph.input("s");
        for (int k = 0; k < length; ++k) {
            const NodeId c = graph.input("c" + std::to_string(k));
            x = graph.divide(graph.constant(1), graph.add(x, c));
            pivots.push_back(x);
            s = graph.add(graph.multiply(s, c), graph.multiply(c, c));
            sums.push_back(s);
            outputs.push_back(graph.multiply(x, x));
            outputs.push_back(graph.multiply(s, s));
        }
        outputs.push_back(graph.multiply(x, s));
        plan = plan_body(graph, outputs);
        for (const std::vector<NodeId>* chain : {&pivots, &sums})
            for (const NodeId id : *chain) {
                steps.push_back(make_step(graph, plan, BodyStep::Kind::define, id));
                if (chain == &pivots) steps.push_back(make_step(graph, plan, BodyStep::Kind::check, id));
            }
        for (std::size_t k = 0; k < outputs.size(); ++k)
            steps.push_back(make_step(graph, plan, BodyStep::Kind::store, outputs[k], k));
    }

    Graph graph;
    std::vector<NodeId> pivots;
    std::vector<NodeId> sums;
    std::vector<NodeId> outputs;
    BodyPlan plan;
    std::vector<BodyStep> steps;
};

bool same(const BodyStep& a, const BodyStep& b)
{
    return a.kind == b.kind && a.node == b.node && a.index == b.index;
}

std::size_t place_of(const std::vector<BodyStep>& steps, NodeId id)
{
    const auto defines = [id](const BodyStep& s) { return s.kind == BodyStep::Kind::define && s.node == id; };
    return static_cast<std::size_t>(std::ranges::find_if(steps, defines) - steps.begin());
}

} // namespace

TEST_CASE("sums that do not need a chain of divisions fill the time that it takes", "[emit]")
{
    const TwoChains chains(60);
    const std::vector<BodyStep> order = overlap_steps(chains.graph, chains.plan, chains.steps);
    REQUIRE(order.size() == chains.steps.size());
    CHECK(std::ranges::is_permutation(order, chains.steps, same));
    for (std::size_t k = 0; k < order.size(); ++k)
        for (const NodeId id : order[k].needs)
            if (chains.graph.op(id) != Op::input) CHECK(place_of(order, id) < k);
    CHECK(place_of(order, chains.sums[20]) < place_of(order, chains.pivots[59]));
    CHECK(std::ranges::equal(order, overlap_steps(chains.graph, chains.plan, order), same));
}

TEST_CASE("a body that a processor oversees as it stands keeps its order", "[emit]")
{
    const TwoChains chains(4);
    CHECK(std::ranges::equal(chains.steps, overlap_steps(chains.graph, chains.plan, chains.steps), same));
}
