// SPDX-License-Identifier: GPL-2.0-or-later
/// What folding drops and definedness needs.
#include "problem.hpp"
#include "proof/partial_parts.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

std::vector<std::string> parts(const std::string& text)
{
    Graph graph;
    Lowering lower(graph);
    std::vector<std::string> texts;
    for (const NodeId node : partial_parts(graph, lower, parse_expression(whole_text("<test>", text))))
        texts.push_back(to_text(graph, node));
    return texts;
}

} // namespace

TEST_CASE("partial operations are found where they fold away too, and those of branches are not")
{
    CHECK(parts("0*log(-1 - x^2) + x") == std::vector<std::string>{"log(-1 - x^2)"});
    CHECK(parts("sqrt(x) - sqrt(x)") == std::vector<std::string>{"sqrt(x)"});
    CHECK(parts("x/x + 1") == std::vector<std::string>{"1/x"});
    CHECK(parts("sqrt(x)^2") == std::vector<std::string>{"sqrt(x)"});
    CHECK(parts("log(x) + 1/y") == std::vector<std::string>{"log(x)", "1/y"});
    CHECK(parts("0*if(x > 0, log(x), 1)").empty());
}

TEST_CASE("an identity is undecided where a folded part is defined nowhere")
{
    Problem problem({{"x"}, {}, {}, {}, {}});
    ProofSetting setting;
    setting.variables = {problem.node("x")};
    Lowering lower(problem.graph);
    setting.defined =
        partial_parts(problem.graph, lower, parse_expression(whole_text("<test>", "0*log(-1 - x^2) + x")));
    const ZeroDecider decider(problem.graph, setting);
    const Decision decision = decider.decide(problem.node("sin(x)^2 + cos(x)^2 - 1"));
    CHECK(to_text(decision.status) == std::string("undecided"));
    CHECK(decision.evidence == "no regular point found in 200 tries");
}
