// SPDX-License-Identifier: GPL-2.0-or-later
/// What the rows of the operator table say of functions, against their values.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "graph/unknowns/implicit.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace lagen;

namespace {

/// The functions of one operand, with the order 3 for Stumpff's.
std::vector<Op> functions_of_one()
{
    std::vector<Op> result;
    for (const Operator& row : operator_table())
        if (row.kind == OpKind::function && row.arity == 1) result.push_back(row.op);
    return result;
}

std::uint32_t payload_of(Op op)
{
    return op == Op::stumpff ? 3 : 0;
}

double value_at(Op op, double x)
{
    return operator_of(op).value.in_double(&x, static_cast<std::int32_t>(payload_of(op)));
}

NodeId function_of(Graph& graph, Op op, NodeId a)
{
    return graph.make(op, payload_of(op), std::vector<NodeId>{a});
}

double at(const Graph& graph, NodeId node, double x)
{
    return evaluate<double>(graph, std::vector<NodeId>{node}, {{"x", x}})[0];
}

} // namespace

TEST_CASE("exact values are the values in floating point, rounded")
{
    std::size_t compared = 0;
    for (const Op op : functions_of_one())
        for (const Rational& x : {Rational(0), Rational(1), Rational(-1), Rational(9, 4), Rational(-2)}) {
            const auto exact = exact_value(op, &x, payload_of(op), 1000);
            if (!exact) continue;
            ++compared;
            INFO(operator_of(op).name << "(" << x << ")");
            CHECK(exact->get_d() == Approx(value_at(op, x.get_d())).epsilon(tolerance::roundoff(1)));
        }
    CHECK(compared >= 24);
    const Rational two = 2;
    CHECK(exact_value(Op::power, &two, 10, 100) == Rational(1024));
    CHECK(!exact_value(Op::power, &two, 1000, 100)); // longer than was asked for
    const Rational ratio[] = {1, 0};
    CHECK(!exact_value(Op::divide, ratio, 0, 100));
}

TEST_CASE("a function has a value where its domain says, and none beyond a condition that is negative")
{
    Graph g;
    const NodeId x = g.input("x");
    std::size_t ends = 0;
    for (const Op op : functions_of_one()) {
        const NodeId f = function_of(g, op, x);
        INFO(operator_of(op).name);
        const Sense sense = domain_of(g, f);
        for (const double place : {-2.5, -0.5, 0.25, 0.75, 2.5}) {
            const bool always = sense == Sense::always;
            const double condition = always ? 1 : at(g, condition_of(g, f), place);
            const bool inside = sense == Sense::nonzero ? condition != 0 : condition > 0;
            CHECK(std::isfinite(value_at(op, place)) == inside);
            ends += inside ? 0 : 1;
        }
    }
    CHECK(ends >= 6);
}

TEST_CASE("a slope is no smaller than the derivative, wherever the function is smooth")
{
    Graph g;
    const NodeId x = g.input("x");
    for (const Op op : functions_of_one()) {
        const NodeId f = function_of(g, op, x);
        const NodeId derivative = gradient(g, f, std::vector<NodeId>{x})[0];
        const NodeId bound = slope_bound(g, f, 0);
        INFO(operator_of(op).name);
        for (const double place : {-30.0, -3.0, -0.7, -0.1, 0.1, 0.7, 3.0, 30.0}) {
            const double slope = std::abs(at(g, derivative, place));
            if (!std::isfinite(slope)) continue;
            CHECK(at(g, bound, place) >= slope * (1 - tolerance::roundoff(8)));
        }
    }
}

TEST_CASE("parity and zeros of functions are those of their values")
{
    std::size_t odd = 0;
    for (const Op op : functions_of_one()) {
        const Operator& row = operator_of(op);
        if (op == Op::stumpff) continue; // of two arguments in the language
        const Parity parity = entry_of(*row.function).parity;
        INFO(row.name);
        bool even_here = true;
        bool odd_here = true;
        for (const double x : {0.125, 0.5, 0.875}) {
            const double left = value_at(op, -x);
            even_here = even_here && left == value_at(op, x);
            odd_here = odd_here && left == -value_at(op, x);
            if (row.vanishes_with_operand) CHECK(value_at(op, x) != 0);
        }
        CHECK(even_here == (parity == Parity::even));
        CHECK(odd_here == (parity == Parity::odd || op == Op::sign)); // sign is no function of GiNaC's door
        if (row.vanishes_with_operand) CHECK(value_at(op, 0) == 0);
        odd += odd_here ? 1 : 0;
    }
    CHECK(odd >= 7);
}

TEST_CASE("comparisons hold as their rows say")
{
    for (const Operator& row : operator_table()) {
        if (row.kind != OpKind::comparison) continue;
        const auto holds = [&](double a, double b) {
            const double x[] = {a, b};
            return row.value.in_double(x, 0) != 0;
        };
        CHECK(holds(1, 2) == row.holds.below);
        CHECK(holds(2, 2) == row.holds.equal);
        CHECK(holds(2, 1) == row.holds.above);
        CHECK(op_of(*row.comparison) == row.op);
    }
}

TEST_CASE("every scalar function of the language is an operation of the same name")
{
    for (const FunctionEntry& entry : function_table())
        if (!entry.array) CHECK(operator_of(op_of(entry.function)).name == std::string(entry.name));
}

TEST_CASE("rounding errors grow by the slopes of Stumpff functions, angles and exponents")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.add(x, g.constant(1)); // one rounding of size |y|
    const auto size = [&](NodeId node, double place) {
        return at(g, rounding_sizes(g, std::vector<NodeId>{node})[0], place);
    };
    // c_0(-z) = cosh(sqrt(z)) rises by 2.1e3 a unit at z = 121.
    const double stumpff = size(g.stumpff(0, y), -122);
    CHECK(stumpff >= 121 * std::sinh(11.0) / 22);
    // Near the origin an angle turns by 1/r a unit.
    const NodeId small = g.constant(Rational(1, 1000));
    CHECK(size(g.apply(Op::atan2, y, small), -1.0) == 0.0);
    CHECK(size(g.apply(Op::atan2, y, small), -0.9999) >= 0.0001 * 0.98 / 0.001 + 0.099);
    // d x^p / dp = x^p log(x).
    const NodeId power = g.apply(Op::real_power, g.constant(100), y);
    CHECK(size(power, 2.0) >= 3 * 1e6 * std::log(100.0));
}

TEST_CASE("a solution of linear equations passes the rounding of its entries on")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.add(x, g.constant(1));
    const std::vector<NodeId> matrix{g.constant(2), y, y, g.constant(3)};
    const auto z = g.solve(matrix, std::vector<NodeId>{g.constant(1), x}, MatrixStructure::symmetric);
    const NodeId size = rounding_sizes(g, std::vector<NodeId>{z[0]})[0];
    for (const NodeId node : reachable(g, std::vector<NodeId>{size}))
        if (g.op(node) == Op::abs) {
            const Op inner = g.op(g.operands(node)[0]);
            CHECK((inner != Op::factor && inner != Op::solve));
        }
    CHECK(at(g, size, 0.5) >= 1.5);
}
