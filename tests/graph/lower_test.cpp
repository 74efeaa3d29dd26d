// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering of trees, and the way back.
#include "graph/core/lower.hpp"

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

TEST_CASE("trees lower to nodes in the user's own form, terms and factors in their order")
{
    Graph g;
    CHECK(to_text(g, lower(g, "m*l^2*v^2/2 - m*grav*l*(1 - cos(q))")) == "m*l^2*v^2/2 - m*grav*l*(1 - cos(q))");
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
    for (const char* text : {"sin(x)*y - 1/3", "x^-2/(1 + abs(y))", "atan2(y, x)^(1/3)", "if(x < y, x, -y)",
                             "sqrt(x)^3", "stumpff(2, x*y) - y"}) {
        const NodeId id = lower(g, text);
        CHECK(Lowering(g)(to_tree(g, id)) == id);
    }
    const auto z =
        g.solve(std::vector<NodeId>(4, g.input("a")), std::vector<NodeId>(2, g.input("b")), MatrixStructure::general);
    CHECK(Lowering(g)(to_tree(g, z[1])) == z[1]);
}

TEST_CASE("a component of a linear system lowers to one solve, split where the unknowns do not touch")
{
    Graph g;
    const auto x = [](const char* text) { return name(text); };
    const std::vector<Tree> matrix{x("a"), x("b"), x("c"), x("d")};
    const std::vector<Tree> right{x("u"), x("v")};
    const NodeId first = Lowering(g)(solve_component(matrix, right, 0));
    const NodeId second = Lowering(g)(solve_component(matrix, right, 1));
    REQUIRE(g.op(first) == Op::component);
    CHECK(g.operands(first)[0] == g.operands(second)[0]);
    CHECK(g.payload(second) == 1);
    const std::vector<Tree> diagonal{x("a"), number(0), number(0), x("d")};
    CHECK(to_text(g, Lowering(g)(solve_component(diagonal, right, 1))) == "v/d");
    const std::vector<Tree> singular{x("a"), number(0), number(0), number(0)};
    CHECK(g.op(Lowering(g)(solve_component(singular, right, 1))) == Op::component); // answers at run time
    CHECK_THROWS_AS(Lowering(g)(solve_component({number(0)}, {x("u")}, 0)), ModelError);
}

TEST_CASE("the order of a Stumpff function is a small integer")
{
    CHECK(message("stumpff(x, y)") ==
          "the first argument of stumpff is `x`, an integer from 0 to 64 is required | stumpff(k, z) is the sum over j "
          "of (-z)^j / (2j+k)!");
    CHECK(message("stumpff(65, y)").substr(0, 38) == "the first argument of stumpff is 65, a");
    CHECK(message("stumpff(1/2, y)").substr(0, 38) == "the first argument of stumpff is 1/2, ");
}

TEST_CASE("a sum and a product are the same node in any order, and keep the order in which they were first written")
{
    Graph g;
    const NodeId z = g.input("z");
    const NodeId sum = lower(g, "y + z + x");
    CHECK(to_text(g, sum) == "y + z + x");
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    CHECK(g.add(x, g.add(z, y)) == sum);
    const NodeId product = lower(g, "y*z*x");
    CHECK(to_text(g, product) == "y*z*x");
    CHECK(g.multiply(x, g.multiply(z, y)) == product);
    CHECK(to_text(g, g.multiply(z, g.constant(3))) == "3*z");
}
