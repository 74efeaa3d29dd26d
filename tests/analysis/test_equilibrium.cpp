// SPDX-License-Identifier: GPL-2.0-or-later
/// Equilibria near a start, certified or not, and the slopes there.
#include "analysis/equilibrium.hpp"

#include "expression/parse.hpp"
#include "expression/scope.hpp"
#include "graph/core/lower.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace lagen;

namespace {

struct SmallMotion {
    Graph graph;
    MotionEquations equations;

    SmallMotion(const std::vector<std::string>& state, const std::vector<std::string>& inputs,
                const std::vector<std::string>& rates)
    {
        for (const std::string& each : state) equations.state.push_back(graph.input(each));
        for (const std::string& each : inputs) equations.inputs.push_back(graph.input(each));
        for (const std::string& each : rates) equations.rates.push_back(node(each));
    }
    NodeId node(const std::string& text)
    {
        Scope scope;
        for (const NodeId each : graph.inputs()) scope.declare(graph.input_name(each), {});
        return Lowering(graph)(scope.close(parse_expression(whole_text("test", text)), true));
    }
    Equilibrium near(std::vector<double> state, std::vector<double> inputs = {})
    {
        return equilibrium_near(graph, equations, {{std::move(state), std::move(inputs), {}}});
    }
};

} // namespace

TEST_CASE("an equilibrium near the start is certified, with slopes in full precision")
{
    SmallMotion pendulum({"q", "v"}, {"u"}, {"v", "-9.81*sin(q) - v/2 + u/2"});
    const Equilibrium up = pendulum.near({3, 0.1}, {0});
    CHECK(up.certified);
    CHECK(up.radius < 1.3e-16); // pi and the nearest double
    CHECK(up.at.state == std::vector<double>{std::numbers::pi, 0});
    CHECK_FALSE(up.moves_inputs);
    CHECK(up.A == std::vector<std::vector<double>>{{0, 1}, {9.81, -0.5}});
    CHECK(up.B == std::vector<std::vector<double>>{{0}, {0.5}});
    CHECK(up.residual < 1e-14);
    REQUIRE(up.eigenvalues.size() == 2);
    CHECK(up.eigenvalues[1].real == Approx(-0.25 + std::sqrt(0.0625 + 9.81)).epsilon(1e-15));
    // A torque that stands moves it.
    const Equilibrium held = pendulum.near({0.2, 0}, {9.81});
    CHECK(held.at.state[0] == Approx(std::numbers::pi / 6).epsilon(1e-15));
    CHECK(held.at.inputs[0] == 9.81);
}

TEST_CASE("a coordinate that no rate depends on stays at the start, also in a family")
{
    SmallMotion cart({"x", "v"}, {}, {"v", "-v"});
    const Equilibrium found = cart.near({0.7, 2});
    CHECK(found.certified);
    CHECK(found.at.state == std::vector<double>{0.7, 0});
    SmallMotion circle({"x", "y"}, {}, {"x*(1 - x^2 - y^2)", "y*(1 - x^2 - y^2)"});
    const Equilibrium near = circle.near({0.9, 1.2});
    CHECK(near.at.state[0] / near.at.state[1] == Approx(0.75).epsilon(1e-12));
    CHECK(std::hypot(near.at.state[0], near.at.state[1]) == Approx(1).epsilon(1e-14));
    CHECK_FALSE(near.certified); // both equations say the same
}

TEST_CASE("where the inputs of the start have no equilibrium they move with the state, as little as possible")
{
    SmallMotion mass({"x", "v"}, {"u", "w"}, {"v", "u + 2*w - 3*x - 10 + 3*x"});
    const Equilibrium found = mass.near({1, 0}, {0, 0});
    CHECK(found.moves_inputs);
    CHECK(found.certified);
    CHECK(found.at.state == std::vector<double>{1, 0});
    CHECK(found.at.inputs[0] == Approx(2).epsilon(1e-14)); // 10 (1, 2)/5
    CHECK(found.at.inputs[1] == Approx(4).epsilon(1e-14));
}

TEST_CASE("what is kept along every motion is kept")
{
    // A direction that turns with w, on the sphere of the start; w' = g x e3 pulls it down.
    SmallMotion top({"g1", "g2", "g3", "w1", "w2"}, {}, {"-g3*w2", "g3*w1", "g1*w2 - g2*w1", "-g2 - w1", "g1 - w2"});
    top.equations.constraints = {top.node("g1^2 + g2^2 + g3^2 - 4")};
    top.equations.casimirs = {top.node("(g1^2 + g2^2 + g3^2)^2 - 16")}; // it says the same
    const Equilibrium found = top.near({0.2, 0, std::sqrt(4 - 0.04), 0, 0.1});
    CHECK(found.certified);
    CHECK(found.at.state == std::vector<double>{0, 0, 2, 0, 0});
    CHECK(found.leaf == std::vector<std::vector<double>>{{0, 0, 4, 0, 0}});
}

TEST_CASE("what acts on the rates through unknowns is differentiated through them")
{
    SmallMotion motion({"x"}, {"u"}, {});
    Graph& graph = motion.graph;
    const NodeId z = graph.input("z");
    motion.equations.rates = {motion.node("u - z")};
    motion.equations.implicit.push_back(implicit_block(graph, "z", "", {z}, {motion.node("z^3 + z - x")},
                                                       {graph.constant(1)}, MatrixStructure::general));
    const Equilibrium found = equilibrium_near(graph, motion.equations, {{{9}, {2}, {1.9}}});
    CHECK(found.certified);
    CHECK(found.at.state[0] == 10);
    CHECK(found.at.unknowns[0] == 2);
    CHECK(found.A[0][0] == Approx(-1.0 / 13).epsilon(1e-15)); // dz/dx = 1/(3 z^2 + 1)
    CHECK(found.B[0][0] == 1);
}

TEST_CASE("forces with derivatives that the chain rule does not give are linearised at rest")
{
    struct Case {
        const char* force;
        double x, v; ///< slopes of the second of two forces, by x and v
    };
    const Case cases[] = {
        {"-x - v*abs(v)", -1, 0},
        {"-x - v*sqrt(v^2 + w^2)", -1, 0},
        {"-x - w*sqrt(v^2 + w^2)", -1, 0},
        {"-x - 3*v*sqrt(v^2 + 2*w^2 + x^2)/7", -1, 0},
        {"-x - v*w/(1 + sqrt(v^2 + w^2))", -1, 0},
        {"-x - abs(v)^1.5", -1, 0},
        {"-x - abs(v)^1.001", -1, 0},
        {"-x - v*abs(v)^(1/5)", -1, 0},
        {"-x - 2*(3*abs(v)^0.2)*v/5", -1, 0},
        {"-x - v*(v^2 + w^2)^(1/4)", -1, 0},
        {"-x - (v - w)*((v - w)^2 + 4*x^2)^0.1", -1, 0},
        {"-x - (v^2 + w^2)^(3/4)", -1, 0},
        {"-x - (v^2 + w^2)^(3/2)", -1, 0},
        {"-x - sqrt(v^2 + w^2)^3", -1, 0},
        {"-x - sqrt(v^4 + w^4)", -1, 0},
        {"-x - (abs(v)^0.3)^4", -1, 0},
        {"-x - v*sqrt(abs(v)^1.5 + w^2)", -1, 0},
        {"-x - v - abs(x)*abs(v)", -1, -1},
        {"-x - abs(x*v)*v", -1, 0},
        {"-x - max(0, v)^2", -1, 0},
        {"-x - max(0, v)^1.5", -1, 0},
        {"-x - v*max(v, w)", -1, 0},
        {"-x - sqrt(max(0, -1 - v))", -1, 0},
        {"-x - sign(v)*v^2", -1, 0},
        {"-x + 1 - cos(sqrt(v^2 + w^2))", -1, 0},
        {"-x - v*exp(sqrt(v^2 + w^2))", -1, -1},
        {"-x - sin(v)*sqrt(1 + v^2)", -1, -1},
    };
    for (const Case& each : cases) {
        INFO(each.force);
        SmallMotion motion({"x", "v", "w"}, {}, {"v", each.force, "-w"});
        const Equilibrium found = motion.near({0, 0, 0});
        CHECK(found.A[1] == std::vector<double>{each.x, each.v, 0});
    }
    SmallMotion drag({"x", "v"}, {}, {"v", "-x - v*abs(v)"});
    CHECK(drag.near({1, 0}).A == std::vector<std::vector<double>>{{0, 1}, {-1, 0}});
    // A wind that is no floating-point number: the drag vanishes at v = 1/3.
    SmallMotion wind({"v", "w"}, {},
                     {"-(v - 1/3)*sqrt((v - 1/3)^2 + w^2) - v + 1/3", "-w*sqrt((v - 1/3)^2 + w^2) - 2*w"});
    const Equilibrium carried = wind.near({0, 0.5});
    CHECK(carried.certified);
    CHECK(carried.A == std::vector<std::vector<double>>{{-1, 0}, {0, -2}});
}

TEST_CASE("a term with a kink or a jump, or one that ends at an equilibrium, is refused by its name")
{
    const std::pair<const char*, const char*> cases[] = {
        {"-x - abs(x)/2", "abs(x)"},
        {"-x - sign(v)", "sign(v)"},
        {"if(v > 0, -x, -2*x)", "if(v > 0, -x, -2*x)"},
        {"-min(x, 2*x)", "min(x, 2*x)"},
        {"-x - sqrt(v^2)", "abs(v)"},
        {"-x - 2*sqrt(v^2 + x^2)/3", "sqrt(v^2 + x^2)"},
        {"-x - (1 + v)*sqrt(v^2 + x^2)", "(1 + v)*sqrt(v^2 + x^2)"},
        {"-x - abs(v)^0.5", "sqrt(abs(v))"},
        {"-x - v*sqrt(v)", "v*sqrt(v)"},
        {"-x - x*abs(v)^0.5", "x*sqrt(abs(v))"},
        {"-x - (v^2 + x^2)^(1/3)", "(v^2 + x^2)^(1/3)"},
        {"-x - cos(x)*abs(v)", "cos(x)*abs(v)"},
        {"-x - 10000000000*v*abs(v) - abs(v)/1000000", "abs(v)"}, // beside one that bends much more
    };
    for (const auto& [force, term] : cases) {
        INFO(force);
        SmallMotion rough({"x", "v"}, {}, {"v", force});
        CHECK_THROWS_WITH(rough.near({0, 0}), Catch::Contains(std::string(": ") + term + " has a kink"));
    }
}

TEST_CASE("a search that begins at a term without derivatives names it")
{
    SmallMotion orifice({"y", "v"}, {}, {"v", "-sqrt(max(0, y)) - (y + 1)/4"});
    CHECK_THROWS_WITH(orifice.near({0, 0.1}),
                      Catch::Contains("no equilibrium was found: sqrt(max(0, y)) has no derivatives where the search"));
    CHECK(orifice.near({-0.5, 0.1}).A == std::vector<std::vector<double>>{{0, 1}, {-0.25, 0}});
}

TEST_CASE("rates without a zero, and a zero outside the domain, are no equilibrium")
{
    SmallMotion none({"x", "v"}, {}, {"v", "1 + x^2"});
    CHECK_THROWS_WITH(none.near({1, 0}), Catch::Contains("no equilibrium was found"));
    SmallMotion outside({"x"}, {}, {"1 + x"});
    outside.equations.domain = {outside.graph.apply(Op::greater, outside.node("x"), outside.graph.constant(0))};
    CHECK_THROWS_WITH(outside.near({1}), Catch::Contains("the equilibrium x = -1 is not certain to be in the domain"));
}

TEST_CASE("a double zero is no certified equilibrium")
{
    SmallMotion flat({"x"}, {}, {"(x - 1)^2"});
    const Equilibrium found = flat.near({2});
    CHECK_FALSE(found.certified);
    CHECK(found.at.state[0] == Approx(1).epsilon(1e-11));
}
