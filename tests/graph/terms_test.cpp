// SPDX-License-Identifier: GPL-2.0-or-later
/// Alike terms: which nodes become lanes of one operation, and that no lane waits for another.
#include "graph/terms/group_terms.hpp"

#include "graph/core/operators.hpp"
#include "graph/series/taylor.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace lagen;

namespace {

/// Accelerations of bodies in the plane that attract each other; inputs of one kind are a family.
struct Bodies {
    Graph graph;
    std::vector<NodeId> m, x, y, functions;

    explicit Bodies(int n)
    {
        for (int i = 0; i < n; ++i) {
            m.push_back(graph.input("m" + std::to_string(i)));
            x.push_back(graph.input("x" + std::to_string(i)));
            y.push_back(graph.input("y" + std::to_string(i)));
        }
        const NodeId zero = graph.constant(0);
        std::vector<NodeId> ax(x.size(), zero), ay(x.size(), zero);
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t j = i + 1; j < x.size(); ++j) {
                const NodeId dx = graph.subtract(x[i], x[j]), dy = graph.subtract(y[i], y[j]);
                const NodeId square = graph.add(graph.multiply(dx, dx), graph.multiply(dy, dy));
                const NodeId factor =
                    graph.divide(graph.constant(1), graph.multiply(square, graph.apply(Op::sqrt, square)));
                const NodeId on_i = graph.multiply(m[j], factor), on_j = graph.multiply(m[i], factor);
                ax[i] = graph.subtract(ax[i], graph.multiply(on_i, dx));
                ay[i] = graph.subtract(ay[i], graph.multiply(on_i, dy));
                ax[j] = graph.add(ax[j], graph.multiply(on_j, dx));
                ay[j] = graph.add(ay[j], graph.multiply(on_j, dy));
            }
        functions = ax;
        functions.insert(functions.end(), ay.begin(), ay.end());
    }

    [[nodiscard]] AlikeGroups groups() const { return group_terms(graph, {functions, {m, x, y}}); }
};

/// Every group is one operation, of nodes that are in no other place and do not depend on each other, on operands that
/// are its own.
void check_groups(const Graph& graph, const AlikeGroups& found, const TermRequest& request)
{
    std::set<NodeId> seen;
    for (std::size_t k = 0; k < found.groups.size(); ++k) {
        const AlikeTerms& group = found.groups[k];
        const bool given = request.sums.contains(group.lanes[0]);
        for (std::size_t l = 0; l < group.lanes.size(); ++l) {
            const NodeId lane = group.lanes[l];
            CHECK(seen.insert(lane).second);
            CHECK(found.place_of.at(lane) == std::pair(k, l));
            CHECK(graph.op(lane) == graph.op(group.lanes[0]));
            if (!given) CHECK(graph.payload(lane) == graph.payload(group.lanes[0]));
            std::vector<NodeId> mine(graph.operands(lane).begin(), graph.operands(lane).end());
            if (given) mine.assign(request.sums.at(lane).begin(), request.sums.at(lane).end());
            std::vector<NodeId> theirs;
            for (const TermOperand& operand : group.operands)
                theirs.push_back(operand.group               ? found.groups[*operand.group].lanes[l]
                                 : operand.nodes.size() == 1 ? operand.nodes[0]
                                                             : operand.nodes[l]);
            if (group.is_inverse_cube) { // 1/(x sqrt(x)) of x
                const auto product = graph.operands(mine[1]);
                CHECK(graph.is_one(mine[0]));
                mine = {graph.op(product[0]) == Op::sqrt ? product[1] : product[0]};
            }
            if (mine != theirs) {
                CHECK((given || operator_of(graph.op(lane)).commutative));
                std::swap(theirs.front(), theirs.back());
            }
            CHECK(mine == theirs);
            if (given) continue;
            std::vector<NodeId> others = group.lanes;
            std::erase(others, lane);
            CHECK_FALSE(depends_on_any(graph, std::vector<NodeId>{lane}, others));
        }
    }
    CHECK(seen.size() == found.place_of.size());
}

} // namespace

TEST_CASE("pairs of many bodies are lanes of one operation each, and none waits for another", "[graph][terms]")
{
    for (const int n : {4, 5, 7}) {
        const Bodies bodies(n);
        const auto pairs = static_cast<std::size_t>(n * (n - 1) / 2);
        const AlikeGroups found = bodies.groups();
        // Two differences and their squares, the square of the distance, its root, their product and its reciprocal,
        // two masses by that, four products.
        CHECK(found.groups.size() == 14);
        for (const AlikeTerms& group : found.groups) CHECK(group.lanes.size() == pairs);
        check_groups(bodies.graph, found, {bodies.functions, {}});
    }
}

TEST_CASE("the sums over lower orders of a series are grouped by their factors", "[graph][terms]")
{
    Bodies bodies(5);
    std::vector<NodeId> coordinates = bodies.x;
    coordinates.insert(coordinates.end(), bodies.y.begin(), bodies.y.end());
    const TaylorRecurrence series = taylor_recurrence(bodies.graph, bodies.functions, coordinates, {});
    std::vector<NodeId> roots = bodies.functions;
    roots.insert(roots.end(), series.outputs.begin(), series.outputs.end());
    const std::span<const NodeId> curve = series.curve;
    TermRequest request{roots, {bodies.m, bodies.x, bodies.y, series.sums}};
    request.families.emplace_back(curve.begin(), curve.begin() + 5);
    request.families.emplace_back(curve.begin() + 5, curve.end());
    for (std::size_t m = 0; m < series.sums.size(); ++m) request.sums[series.sums[m]] = series.pairs[m];
    const AlikeGroups found = group_terms(bodies.graph, request);
    check_groups(bodies.graph, found, request);
    for (const NodeId sum : series.sums) CHECK(found.contains(sum));
}

TEST_CASE("few terms, unlike ones and cheap ones are no groups", "[graph][terms]")
{
    CHECK(Bodies(3).groups().groups.empty()); // three pairs
    Graph g;
    std::vector<NodeId> x, cheap, chained;
    for (int k = 0; k < 8; ++k) x.push_back(g.input("x" + std::to_string(k)));
    for (int k = 0; k < 7; ++k)
        cheap.push_back(g.multiply(x[static_cast<std::size_t>(k)], x[static_cast<std::size_t>(k) + 1]));
    CHECK(group_terms(g, {cheap, {x}}).groups.empty());
    NodeId last = x[0]; // each root waits for the one before
    for (int k = 1; k < 8; ++k) {
        last = g.apply(Op::sqrt, g.add(last, x[static_cast<std::size_t>(k)]));
        chained.push_back(last);
    }
    CHECK(group_terms(g, {chained, {x}}).groups.empty());
}
