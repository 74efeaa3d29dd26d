// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: same values, fewer operations, bounded effort.
#include "graph/simplify/simplify.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/formulas.hpp"

#include <catch2/catch.hpp>

#include <chrono>

using namespace lagen;

namespace {

std::vector<std::string> texts(const Graph& g, const std::vector<NodeId>& ids)
{
    std::vector<std::string> result;
    for (const NodeId id : ids) result.push_back(to_text(g, id, 2000));
    return result;
}

/// Values at seeded inputs in (0.2, 1.2).
std::vector<long double> sample(const Graph& g, const std::vector<NodeId>& ids)
{
    std::map<std::string, long double> at;
    long double k = 0;
    for (const NodeId input : g.inputs()) {
        k += 0.6180339887L;
        at[g.input_name(input)] = 0.2L + (k - static_cast<long double>(static_cast<int>(k)));
    }
    return evaluate<long double>(g, ids, at);
}

void check_same_values(const Graph& g, const std::vector<NodeId>& a, const std::vector<NodeId>& b)
{
    const auto x = sample(g, a);
    const auto y = sample(g, b);
    REQUIRE(x.size() == y.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        CHECK(x[k] != 0);
        CHECK(static_cast<double>(std::abs(x[k] - y[k]) / (1 + std::abs(x[k]))) < 1e-15);
    }
}

} // namespace

TEST_CASE("like terms are collected and common factors drawn out")
{
    Graph g;
    const auto top = test::heavy_top(g);
    const auto simple = simplify(g, top);
    CHECK(texts(g, simple) == std::vector<std::string>{"g2*w3 - g3*w2", "g3*w1 - g1*w3", "g1*w2 - g2*w1",
                                                       "(mgl*g2 + w2*w3*(I2 - I3))/I1", "(w1*w3*(I3 - I1) - mgl*g1)/I2",
                                                       "w1*w2*(I1 - I2)/I3"});
    check_same_values(g, top, simple);
}

TEST_CASE("Kepler's accelerations share one root and one division")
{
    Graph g;
    const auto simple = simplify(g, test::kepler(g));
    const OperationCount count = count_operations(g, simple);
    CHECK(count.divisions == 1);
    CHECK(count.functions == 1);
    CHECK(count.multiplications == 5);
    check_same_values(g, test::kepler(g), simple);
    Graph other;
    const NodeId a = other.input("a");
    const NodeId x = other.input("x");
    const NodeId u = other.add(other.power(x, 2), a);
    const std::vector<NodeId> quotient{other.divide(u, other.apply(Op::sqrt, u))};
    CHECK(texts(other, simplify(other, quotient)) == std::vector<std::string>{"sqrt(x^2 + a)"});
}

TEST_CASE("the double pendulum needs fewer operations than as written, mass matrix and right side included")
{
    Graph g;
    const auto written = test::double_pendulum(g);
    const auto simple = simplify(g, written);
    const OperationCount count = count_operations(g, simple);
    CHECK(count.additions + count.multiplications <= 30);
    CHECK(count.functions == 2);
    CHECK(count.solves == 1);
    check_same_values(g, written, simple);
}

TEST_CASE("random rational expressions keep their exact values and never grow heavier")
{
    test::Random random(11);
    int regular = 0;
    for (int round = 0; round < 150; ++round) {
        Graph g;
        std::vector<NodeId> outputs;
        for (int k = 0; k < 3; ++k) outputs.push_back(test::random_rational(g, random, 4 + round / 10, round % 2 == 0));
        std::vector<NodeId> simple;
        simple = simplify(g, outputs);
        CHECK(count_operations(g, simple).weight <= count_operations(g, outputs).weight);
        const std::map<std::string, Rational> at{{"x", Rational(1, 3)}, {"y", Rational(-2, 5)}, {"z", Rational(3, 7)}};
        const auto exact = evaluate_exactly(g, outputs, at);
        if (exact.empty()) continue;
        ++regular;
        INFO("round " << round);
        CHECK(evaluate_exactly(g, simple, at) == exact);
    }
    CHECK(regular > 140);
}

TEST_CASE("random expressions with functions keep their values")
{
    test::Random random(5);
    for (int round = 0; round < 60; ++round) {
        Graph g;
        std::vector<NodeId> pool{g.input("x"), g.input("y"), g.constant(Rational(1, 2))};
        for (int k = 0; k < 16; ++k) {
            const NodeId a = pool[random.below(pool.size())];
            const NodeId b = pool[random.below(pool.size())];
            const NodeId square = g.add(g.constant(1), g.power(a, 2));
            switch (random.below(7)) {
            case 0: pool.push_back(g.apply(Op::sin, a)); break;
            case 1: pool.push_back(g.apply(Op::cos, a)); break;
            case 2: pool.push_back(g.apply(Op::sqrt, square)); break;
            case 3: pool.push_back(g.divide(b, g.apply(Op::sqrt, square))); break;
            case 4: pool.push_back(g.divide(b, g.power(g.apply(Op::sqrt, square), 3))); break;
            case 5: pool.push_back(g.subtract(g.multiply(a, b), a)); break;
            default: pool.push_back(g.add(g.multiply(a, b), g.divide(b, square)));
            }
        }
        const std::vector<NodeId> outputs{g.add(pool[17], pool[18]), g.multiply(pool[16], pool[18])};
        const auto simple = simplify(g, outputs);
        const auto x = sample(g, outputs);
        const auto y = sample(g, simple);
        for (std::size_t k = 0; k < x.size(); ++k)
            CHECK(static_cast<double>(std::abs(x[k] - y[k]) / (1 + std::abs(x[k]))) < 1e-13);
    }
}

TEST_CASE("squares of a sine and cosine with one coefficient are one term")
{
    Graph g;
    const NodeId q = g.input("q");
    const NodeId m = g.input("m");
    const auto square = [&](Op op) { return g.multiply(m, g.power(g.apply(op, q), 2)); };
    const std::vector<NodeId> sum{g.add(square(Op::sin), square(Op::cos))};
    CHECK(simplify(g, sum) == std::vector<NodeId>{m});
}

TEST_CASE("expansion that does not pay gives up quickly and keeps what was written")
{
    Graph g;
    NodeId sum = g.constant(0);
    for (int k = 0; k < 8; ++k) sum = g.add(sum, g.input("a" + std::to_string(k)));
    const std::vector<NodeId> power{g.power(sum, 64)};
    const auto start = std::chrono::steady_clock::now();
    CHECK(simplify(g, power) == power);
    NodeId product = g.constant(1);
    for (int k = 0; k < 40; ++k) product = g.multiply(product, g.add(g.input("x"), g.input("a" + std::to_string(k))));
    const auto simple = simplify(g, std::vector<NodeId>{product});
    CHECK(count_operations(g, simple).weight <= 79);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
}

TEST_CASE("shared expressions and long chains are simplified in bounded time")
{
    Graph g;
    const NodeId x = g.input("x");
    NodeId e = x;
    for (int k = 0; k < 40; ++k) e = g.multiply(g.apply(Op::sin, e), g.apply(Op::cos, e));
    const std::vector<NodeId> shared{e};
    CHECK(count_operations(g, simplify(g, shared)).weight == count_operations(g, shared).weight);
    NodeId chain = x;
    for (int k = 0; k < 20'000; ++k) chain = k % 2 == 0 ? g.multiply(chain, x) : g.add(chain, g.input("y"));
    const std::vector<NodeId> deep{chain};
    CHECK(count_operations(g, simplify(g, deep)).weight <= count_operations(g, deep).weight);
}

TEST_CASE("a divisor that cancels to zero leaves the outputs as written")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const NodeId zero = g.subtract(g.multiply(x, g.add(y, g.constant(1))), g.add(g.multiply(x, y), x));
    const std::vector<NodeId> outputs{g.divide(y, zero)};
    const auto simple = simplify(g, outputs);
    CHECK(evaluate_exactly(g, simple, {{"x", 1}, {"y", 2}}).empty());
}
