// SPDX-License-Identifier: GPL-2.0-or-later
/// What `simplify` tells of its work.
#include "graph/simplify/passes.hpp"
#include "graph/simplify/simplify.hpp"

#include "graph/formulas.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

struct Reported {
    std::vector<NodeId> outputs;
    SimplifyReport report;
};

Reported reported(Graph& graph, const std::vector<NodeId>& outputs)
{
    Reported result;
    std::vector<NodeId> divisors;
    result.outputs = simplify(graph, outputs, divisors, &result.report);
    return result;
}

} // namespace

TEST_CASE("the report begins with the outputs as written and ends with those that are kept")
{
    Graph graph;
    const auto top = test::heavy_top(graph);
    const auto [outputs, report] = reported(graph, top);
    CHECK(report.written.weight == count_operations(graph, top).weight);
    CHECK(report.kept.weight == count_operations(graph, outputs).weight);
    CHECK(report.kept.weight < report.written.weight);
    REQUIRE(!report.passes.empty());
    CHECK(report.passes.front().form == name_of(strategies().front()));
    CHECK(report.passes.front().pass == "flattened");
    CHECK(report.passes.front().before.weight == report.written.weight);
    CHECK(report.passes.back().form == "outputs of several forms");
    CHECK(report.passes.back().after.weight == report.kept.weight);
    for (std::size_t k = 1; k < report.passes.size(); ++k)
        if (report.passes[k].form == report.passes[k - 1].form)
            CHECK(report.passes[k].before.weight == report.passes[k - 1].after.weight);
}

TEST_CASE("asking for a report does not change what is kept")
{
    Graph told;
    Graph silent;
    const auto [outputs, report] = reported(told, test::heavy_top(told));
    CHECK(outputs == simplify(silent, test::heavy_top(silent)));
    CHECK(told.size() == silent.size());
}

TEST_CASE("the costliest terms are those whose own operations weigh most")
{
    Graph graph;
    const NodeId x = graph.input("x");
    const NodeId y = graph.input("y");
    const NodeId shared = graph.multiply(x, y);
    const NodeId cheap = graph.add(shared, x);
    const NodeId costly = graph.apply(Op::exp, graph.subtract(shared, y));
    const NodeId outputs[] = {cheap, costly};
    const auto terms = costliest_terms(graph, outputs, 2);
    REQUIRE(terms.size() == 2);
    CHECK(terms[0].text == "exp(x*y - y)");
    CHECK(terms[0].uses == 1);
    CHECK(terms[0].weight > 10);
    CHECK(terms[1].text == "x*y");
    CHECK(terms[1].uses == 2);
    CHECK(terms[1].weight == 1);
    CHECK(costliest_terms(graph, outputs, 9).size() == 3);
}

TEST_CASE("the terms of a product of sums are counted without multiplying it out")
{
    Graph graph;
    const NodeId x = graph.input("x");
    const NodeId sum = graph.add(graph.add(x, graph.input("y")), graph.input("z"));
    CHECK(expanded_terms(graph, x, 100) == 1);
    CHECK(expanded_terms(graph, sum, 100) == 3);
    CHECK(expanded_terms(graph, graph.power(sum, 2), 100) == 9);
    CHECK(expanded_terms(graph, graph.multiply(graph.power(sum, 2), graph.subtract(x, sum)), 100) == 36);
    CHECK(expanded_terms(graph, graph.apply(Op::sin, sum), 100) == 1);
    CHECK(expanded_terms(graph, graph.divide(sum, graph.power(sum, 2)), 100) == 3);
    NodeId tower = sum;
    for (int k = 0; k < 40; ++k) tower = graph.multiply(tower, graph.add(tower, x));
    CHECK(expanded_terms(graph, tower, 1'000) == 1'000);
}
