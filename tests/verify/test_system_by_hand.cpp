// SPDX-License-Identifier: GPL-2.0-or-later
/// Systems that were not read from a file.
#include "geometry/algebroid.hpp"
#include "geometry/named_algebra.hpp"
#include "mechanics/lagrange.hpp"
#include "mechanics/pontryagin.hpp"
#include "verify/verify.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::vector<NodeId> inputs(Graph& graph, const std::vector<std::string>& names)
{
    std::vector<NodeId> nodes;
    for (const std::string& name : names) nodes.push_back(graph.input(name));
    return nodes;
}

/// TM: rho(e_i) = d/dx^i, C = 0.
Algebroid tangent(Graph& graph, const std::vector<std::string>& x, const std::vector<std::string>& y)
{
    AlgebroidBuilder builder(graph, inputs(graph, x), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) builder.add_anchor(i, i, graph.constant(1));
    return builder.finish(inputs(graph, y));
}

/// A Lie algebra over a point: [e_a, e_b] = C^c_ab e_c for the constants listed, a < b.
Algebroid lie_algebra(Graph& graph, const std::vector<std::string>& y, const std::vector<StructureConstant>& constants)
{
    AlgebroidBuilder builder(graph, {}, y.size());
    for (const StructureConstant& C : constants) builder.add_bracket(C.c, C.a, C.b, graph.constant(C.value));
    return builder.finish(inputs(graph, y));
}

} // namespace

TEST_CASE("a rigid body in fifteen lines: its algebroid and its energy are proved, and its Lagrangian is regular")
{
    System system;
    Graph& graph = system.graph;
    system.time = graph.input("t");
    system.algebroid = lie_algebra(graph, {"w1", "w2", "w3"}, named_algebra("so(3)")->constants);
    NodeId kinetic = graph.constant(0);
    for (long a = 0; a < 3; ++a) {
        const NodeId square = graph.power(system.algebroid.y[static_cast<std::size_t>(a)], 2);
        kinetic = graph.add(kinetic, graph.multiply(graph.constant(Rational(a + 1, 2)), square));
    }
    system.lagrangian = kinetic;
    const Report report = verify(system, {{"E", name("energy"), {}}});
    CHECK(report.structure.verdict == Verdict::valid);
    CHECK(report.mechanics.regularity.kind == Regularity::Kind::regular);
    CHECK(report.mechanics.regularity.positive_definite);

    // Euler's equations: I1 w1' = (I2 - I3) w2 w3 with I = (1, 2, 3).
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const auto pdot = momentum_rates(graph, system.algebroid, lagrange_balance(graph, system, lagrangian));
    CHECK(to_text(graph, pdot[0]) == "2*w2*w3 - 3*w3*w2");
}

TEST_CASE("a system by hand that is no algebroid is refuted")
{
    System system;
    system.algebroid = tangent(system.graph, {"x", "y"}, {"u", "v"});
    system.time = system.graph.input("t");
    system.algebroid.anchor[1].push_back({0, system.algebroid.x[0]});
    std::ranges::sort(system.algebroid.anchor[1], {}, &ColumnEntry::index);
    const Report report = verify(system);
    REQUIRE(report.structure.verdict == Verdict::invalid);
    CHECK(report.structure.checks.at(0).indices == std::vector<std::string>{"u", "v", "x"});
    CHECK(report.structure.checks.at(0).decision.residual == "1");
}

TEST_CASE("what a simplified d2H/du2 was divided by is asked for, since the cost is not defined where it vanishes")
{
    System system;
    Graph& graph = system.graph;
    system.time = graph.input("t");
    system.algebroid = tangent(graph, {"x", "y"}, {"a", "b"});
    system.mu = {graph.input("p"), graph.input("q")};
    const NodeId x = system.algebroid.x[0], y = system.algebroid.x[1], u = graph.input("u"), one = graph.constant(1);
    // x (y z1 + z2) = x, z1 + y z2 = 1: the first row is divided by x.
    const std::vector<NodeId> matrix{graph.multiply(x, y), x, one, y}, right{x, one};
    const NodeId z = graph.solve(matrix, right, MatrixStructure::general)[0];
    ControlProblem control;
    control.u = {u};
    control.sigma = {u, graph.constant(0)};
    control.cost = graph.multiply(graph.multiply(z, graph.constant(Rational(1, 2))), graph.power(u, 2));
    system.control = control;
    bool asked = false;
    for (const NamedNode& divisor : solved_pontryagin_system(graph, system).divisors) asked |= divisor.node == x;
    CHECK(asked);
}
