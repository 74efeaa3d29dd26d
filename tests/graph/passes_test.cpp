// SPDX-License-Identifier: GPL-2.0-or-later
/// The tables of passes and strategies.
#include "graph/simplify/passes.hpp"

#include "graph/formulas.hpp"
#include "graph/simplify/simplify.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <set>

using namespace lagen;

TEST_CASE("every strategy reads polynomials off the outputs in exactly one way, and none is listed twice")
{
    std::set<std::string> names;
    for (const Choices strategy : strategies()) {
        INFO(name_of(strategy));
        Graph graph;
        Work work{graph, {graph.input("x")}, {}};
        int readings = 0;
        for (const Pass& pass : passes()) {
            if (!runs(pass, strategy) || pass.works_on != WorksOn::nodes) continue;
            if (pass.choice == angles_added) continue;
            pass.apply(work);
            CHECK(work.form.has_value());
            ++readings;
        }
        CHECK(readings == 1);
        CHECK(names.insert(name_of(strategy)).second);
    }
}

TEST_CASE("every choice is the choice of one pass, and a strategy takes it")
{
    std::map<Choices, int> passes_of;
    for (const Pass& pass : passes())
        if (pass.choice != in_every_strategy) ++passes_of[pass.choice];
    for (const auto& [choice, count] : passes_of) {
        CHECK(count == 1);
        CHECK(std::ranges::any_of(strategies(), [choice = choice](Choices s) { return (s & choice) != 0; }));
    }
    CHECK(passes_of.size() == 8);
}

TEST_CASE("passes on nodes come before those on polynomials, and a report lists them in the order of the table")
{
    const auto on_nodes = [](const Pass& pass) { return pass.works_on == WorksOn::nodes; };
    CHECK(std::ranges::is_partitioned(passes(), on_nodes));
    Graph graph;
    SimplifyReport report;
    std::vector<NodeId> divisors;
    static_cast<void>(simplify(graph, test::heavy_top(graph), divisors, &report));
    std::size_t compared = 0;
    for (const Choices strategy : strategies()) {
        auto next = passes().begin();
        for (const PassReport& told : report.passes) {
            if (told.stage != Stage::pass || told.form != name_of(strategy)) continue;
            next = std::find_if(next, passes().end(), [&](const Pass& p) { return p.name == told.pass; });
            INFO(told.form << ": " << told.pass);
            REQUIRE(next != passes().end());
            CHECK(runs(*next++, strategy));
            ++compared;
        }
    }
    CHECK(compared > strategies().size());
}

TEST_CASE("a strategy whose guard says no makes no form")
{
    Graph graph;
    SimplifyReport report;
    std::vector<NodeId> divisors;
    const std::vector<NodeId> outputs{graph.add(graph.apply(Op::sin, graph.input("x")), graph.input("y"))};
    static_cast<void>(simplify(graph, outputs, divisors, &report));
    CHECK(report.passes.size() > strategies().size());
    for (const PassReport& told : report.passes) {
        CHECK(told.pass != "angles added");
        CHECK(told.pass != "rows divided");
    }
    Work work{graph, outputs, {}};
    for (const Pass& pass : passes())
        if (pass.choice == angles_added) CHECK_FALSE(pass.guard(work));
}
