// SPDX-License-Identifier: GPL-2.0-or-later
/// Systems that were not read from a file.
#include "algebroid/kinds.hpp"
#include "mechanics/lagrange.hpp"
#include "mechanics/pontryagin.hpp"
#include "verify/verify.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

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
