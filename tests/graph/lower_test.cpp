// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering of trees, and the way back.
#include "graph/lower.hpp"

#include "expression/parse.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

NodeId lower(Graph& g, const std::string& text, Binding binding = {})
{
    return Lowering(g, std::move(binding))(parse_expression(whole_text("<test>", text)));
}

std::string message(const std::string& text)
{
    Graph g;
    try {
        (void)lower(g, text);
    } catch (const ModelError& error) {
        return error.diagnostic().message + " | " + error.diagnostic().hint;
    }
    return "";
}

} // namespace

TEST_CASE("trees lower to nodes in the user's own form, factors in order of creation")
{
    Graph g;
    CHECK(to_text(g, lower(g, "m*l^2*v^2/2 - m*grav*l*(1 - cos(q))")) == "v^2*m*l^2/2 - (1 - cos(q))*l*m*grav");
    CHECK(to_text(g, lower(g, "(x^2 + y^2)^(-3/2)")) == "sqrt(x^2 + y^2)^-3");
    CHECK(to_text(g, lower(g, "x^y + 2^(1/3)")) == "x^y + 2^(1/3)");
    CHECK(to_text(g, lower(g, "a - b"), 400) == "a - b");
    CHECK(to_text(g, lower(g, "0.1*x + pi")) == "1/10*x + pi");
}

TEST_CASE("names stand for bound nodes")
{
    Graph g;
    const NodeId y = g.input("y");
    CHECK(lower(g, "a + x", {{"a", g.multiply(y, y)}}) == g.add(g.power(y, 2), g.input("x")));
}

TEST_CASE("a divisor that vanishes identically is an error of the model")
{
    CHECK(message("1/(x - x)") == "division by zero: the divisor `x - x` is 0 everywhere, a divisor that is not "
                                  "identically zero is required | check the divisor for terms that cancel");
    CHECK(message("(x - x)^(-2)").substr(0, 18) == "0^-2 has no value:");
    CHECK(message("(x - x)^0").substr(0, 17) == "0^0 has no value:");
}

TEST_CASE("a node becomes a tree that lowers to the same node")
{
    Graph g;
    for (const char* text :
         {"sin(x)*y - 1/3", "x^-2/(1 + abs(y))", "atan2(y, x)^(1/3)", "if(x < y, x, -y)", "sqrt(x)^3"}) {
        const NodeId id = lower(g, text);
        CHECK(Lowering(g)(to_tree(g, id)) == id);
    }
    const auto z =
        g.solve(std::vector<NodeId>(4, g.input("a")), std::vector<NodeId>(2, g.input("b")), MatrixStructure::general);
    CHECK_THROWS_AS(to_tree(g, z[0]), InternalError);
}
