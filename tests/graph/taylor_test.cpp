// SPDX-License-Identifier: GPL-2.0-or-later
/// Recurrences of Taylor coefficients: every operation of the table along curves, against repeated derivatives on the
/// graph divided by factorials; linear systems and implicit functions against the equations that define them.
#include "graph/series/taylor.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

using Real = long double;
using Values = std::map<std::string, Real>;

constexpr int orders = 9;
constexpr Real start = 0.3L;

/// Coefficients of orders 0 .. orders of each function along the curve of time alone, by running the recurrence.
std::vector<std::vector<Real>> run_recurrence(Graph& graph, const std::vector<NodeId>& functions, NodeId time,
                                              const std::vector<ImplicitBlock>& blocks = {}, Values values = {})
{
    const NodeId coordinates[] = {time};
    const TaylorRecurrence series = taylor_recurrence(graph, functions, coordinates, blocks);
    values[graph.input_name(time)] = start;
    std::vector<std::vector<Real>> result;
    for (const Real value : evaluate<Real>(graph, functions, values)) result.push_back({value});
    std::vector<NodeId> sides;
    for (const auto& pair : series.pairs) sides.insert(sides.end(), pair.begin(), pair.end());
    std::vector<std::vector<Real>> known(sides.size(), {0});
    for (int k = 1; k <= orders; ++k) {
        values[graph.input_name(series.order)] = k;
        values[graph.input_name(series.curve[0])] = k == 1 ? 1 : 0;
        for (std::size_t m = 0; m < series.sums.size(); ++m) {
            Real sum = 0;
            for (std::size_t j = 1; j < static_cast<std::size_t>(k); ++j)
                sum += known[2 * m][j] * known[2 * m + 1][static_cast<std::size_t>(k) - j];
            values[graph.input_name(series.sums[m])] = series.are_means[m] ? sum / k : sum;
        }
        const std::vector<Real> next = evaluate<Real>(graph, series.outputs, values);
        for (std::size_t i = 0; i < next.size(); ++i) result[i].push_back(next[i]);
        const std::vector<Real> kept = evaluate<Real>(graph, sides, values);
        for (std::size_t i = 0; i < kept.size(); ++i) known[i].push_back(kept[i]);
    }
    return result;
}

/// The same by derivatives over factorials.
std::vector<Real> by_derivatives(Graph& graph, NodeId function, NodeId time)
{
    std::vector<Real> result;
    Real factorial = 1;
    for (int k = 0; k <= orders; ++k) {
        const NodeId outputs[] = {function};
        result.push_back(evaluate<Real>(graph, outputs, {{graph.input_name(time), start}})[0] / factorial);
        factorial *= k + 1;
        const std::pair<NodeId, NodeId> seed[] = {{time, graph.constant(1)}};
        function = directional(graph, outputs, seed)[0];
    }
    return result;
}

void check_equal(const std::vector<Real>& found, const std::vector<Real>& expected)
{
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        INFO("order " << k);
        CHECK(std::abs(found[k] - expected[k]) <= 1e-14L * (1 + std::abs(expected[k])));
    }
}

/// u = (2 + sin t)/5 and v = 1/2 + t^2/(1 + t): positive, below 1, u != v.
struct Curves {
    Graph graph;
    NodeId t = graph.input("t");
    NodeId u = graph.divide(graph.add(graph.constant(2), graph.apply(Op::sin, t)), graph.constant(5));
    NodeId v =
        graph.add(graph.constant(Rational(1, 2)), graph.divide(graph.power(t, 2), graph.add(graph.constant(1), t)));

    void check(NodeId function)
    {
        INFO(to_text(graph, function));
        const std::vector<Real> expected = by_derivatives(graph, function, t);
        check_equal(run_recurrence(graph, {function}, t)[0], expected);
    }
};

} // namespace

TEST_CASE("every operation's recurrence gives the coefficients that its derivatives give", "[taylor]")
{
    for (const Operator& row : operator_table()) {
        if (row.series == SeriesRule::refused || row.kind == OpKind::leaf || row.kind == OpKind::system) continue;
        INFO(row.name);
        Curves curves;
        const NodeId condition = curves.graph.apply(Op::less, curves.u, curves.v);
        const std::vector<NodeId> all{row.op == Op::select ? condition : curves.u, curves.v, curves.u};
        const auto operands = std::span(all).first(static_cast<std::size_t>(row.arity < 0 ? 3 : row.arity));
        curves.check(curves.graph.make(row.op, row.op == Op::power ? 5U : 0U, operands));
        // As a part of something else: its own series is then a factor of others.
        curves.check(curves.graph.multiply(
            curves.v, curves.graph.apply(Op::exp, curves.graph.make(row.op, row.op == Op::power ? 3U : 0U, operands))));
    }
}

TEST_CASE("powers, negative operands and repeated factors have the coefficients of their derivatives", "[taylor]")
{
    Curves c;
    Graph& g = c.graph;
    const NodeId root = g.apply(Op::sqrt, c.v);
    for (const int n : {-7, -3, -2, -1, 2, 3, 4, 6, 7}) {
        c.check(g.power(c.u, n));
        c.check(g.power(root, n));
    }
    c.check(g.divide(g.input("t"), g.multiply(root, c.v)));
    c.check(g.divide(g.constant(3), g.multiply(root, c.v)));
    c.check(g.divide(g.multiply(c.v, c.v), g.multiply(root, g.power(c.v, 3))));
    c.check(g.apply(Op::real_power, c.v, g.constant(Rational(-7, 3))));
    c.check(g.apply(Op::abs, g.negate(c.u)));
    c.check(g.multiply(g.negate(c.u), g.multiply(g.constant(3), c.u)));
    c.check(g.select(g.apply(Op::greater, c.u, c.v), c.u, g.power(c.v, 2)));
}

TEST_CASE("a natural power is expanded where its base vanishes", "[taylor]")
{
    Graph g;
    const NodeId t = g.input("t");
    const NodeId base = g.subtract(t, g.constant(Rational(3, 10)));
    for (const int n : {2, 3, 5}) {
        const std::vector<Real> found = run_recurrence(g, {g.power(base, n)}, t)[0];
        for (std::size_t k = 0; k < found.size(); ++k)
            CHECK(std::abs(found[k] - (static_cast<int>(k) == n ? 1 : 0)) < 1e-17L);
    }
}

TEST_CASE("the kinematics of N bodies takes six sums a pair, and static factors no series", "[taylor]")
{
    Graph g;
    const NodeId x = g.input("x"), y = g.input("y"), m = g.input("m"), coordinates[] = {x, y};
    const NodeId square = g.add(g.power(x, 2), g.power(y, 2));
    const NodeId pull = g.divide(m, g.multiply(g.apply(Op::sqrt, square), square));
    const NodeId forces[] = {g.multiply(pull, x), g.negate(g.multiply(y, pull))};
    CHECK(taylor_recurrence(g, forces, coordinates, {}).sums.size() == 6);
    const NodeId linear[] = {g.multiply(m, g.add(x, g.divide(y, m)))};
    CHECK(taylor_recurrence(g, linear, coordinates, {}).sums.empty());
}

TEST_CASE("static factors of a rate are one factor, which all orders round alike", "[taylor]")
{
    Graph g;
    const NodeId x = g.input("x"), y = g.input("y"), I = g.input("I"), J = g.input("J"), coordinates[] = {x, y};
    const NodeId rate = g.divide(g.multiply(g.negate(g.multiply(g.subtract(J, I), x)), y), I);
    const NodeId joined = with_joined_factors(g, std::vector{rate}, coordinates)[0];
    const NodeId factor = g.divide(g.subtract(J, I), I);
    CHECK(joined == g.negate(g.multiply(factor, g.multiply(x, y))));
    const TaylorRecurrence series = taylor_recurrence(g, std::vector{joined}, coordinates, {});
    REQUIRE(series.sums.size() == 1);
    const NodeId ends = g.add(g.multiply(x, series.curve[1]), g.multiply(y, series.curve[0]));
    CHECK(series.outputs[0] == g.negate(g.multiply(factor, g.add(ends, series.sums[0]))));
}

TEST_CASE("the components of a linear system satisfy it in every order", "[taylor]")
{
    for (const MatrixStructure structure :
         {MatrixStructure::general, MatrixStructure::symmetric, MatrixStructure::positive_definite}) {
        Curves c;
        Graph& g = c.graph;
        const NodeId one = g.constant(1), mixed = g.multiply(c.u, c.v), large = g.constant(4);
        const std::vector<NodeId> A{g.add(large, c.v), c.u, one, c.u, large, mixed, one, mixed, g.add(large, c.u)};
        const std::vector<NodeId> b{c.v, one, g.apply(Op::sin, c.v)};
        const std::vector<NodeId> z = g.solve(A, b, structure);
        for (const NodeId component : z) c.check(component);
        std::vector<NodeId> products;
        for (std::size_t i = 0; i < 3; ++i) {
            NodeId sum = g.constant(0);
            for (std::size_t j = 0; j < 3; ++j) sum = g.add(sum, g.multiply(A[3 * i + j], z[j]));
            products.push_back(sum);
        }
        for (std::size_t i = 0; i < 3; ++i)
            check_equal(run_recurrence(g, {products[i]}, c.t)[0], run_recurrence(g, {b[i]}, c.t)[0]);
    }
}

TEST_CASE("implicit functions satisfy their equations in every order, through a second block", "[taylor]")
{
    Curves c;
    Graph& g = c.graph;
    const NodeId z = g.input("z"), w = g.input("w");
    const NodeId first = g.subtract(g.add(g.power(z, 3), z), c.v);
    const NodeId second = g.subtract(g.add(w, g.apply(Op::sin, w)), g.multiply(z, c.u));
    const std::vector<ImplicitBlock> blocks{
        implicit_block(g, "one", "", {z}, {first}, {g.constant(0)}, MatrixStructure::general),
        implicit_block(g, "two", "", {w}, {second}, {g.constant(0)}, MatrixStructure::general)};
    const auto newton = [](Real guess, const auto& step) {
        for (int k = 0; k < 60; ++k) guess -= step(guess);
        return guess;
    };
    const Real u = (2 + std::sin(start)) / 5, v = 0.5L + start * start / (1 + start);
    const Real z0 = newton(0.5L, [&](Real x) { return (x * x * x + x - v) / (3 * x * x + 1); });
    const Real w0 = newton(0.1L, [&](Real x) { return (x + std::sin(x) - z0 * u) / (1 + std::cos(x)); });
    const auto found =
        run_recurrence(g, {w, z, g.add(g.power(z, 3), z), g.add(w, g.apply(Op::sin, w)), g.multiply(z, c.u)}, c.t,
                       blocks, {{"z", z0}, {"w", w0}});
    check_equal(found[2], run_recurrence(g, {c.v}, c.t)[0]);
    check_equal(found[3], found[4]);
    CHECK(std::abs(found[0][3]) > 1e-4L);
    CHECK(std::abs(found[1][3]) > 1e-4L);
}

TEST_CASE("an operation without a recurrence is refused by its name", "[taylor]")
{
    Graph g;
    const NodeId t = g.input("t"), functions[] = {g.stumpff(1, t)}, coordinates[] = {t};
    CHECK_THROWS_WITH(
        taylor_recurrence(g, functions, coordinates, {}),
        "error: there is no Taylor series of stumpff() in finitely many functions: take another method, such as "
        "dop853");
}
