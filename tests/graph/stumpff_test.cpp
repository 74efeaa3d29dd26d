// SPDX-License-Identifier: GPL-2.0-or-later
/// Stumpff functions as nodes: values, the recurrence, derivatives, and the passes that must keep the order.
#include "expression/evaluate_stumpff.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/substitute.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/simplify/simplify.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

double value(const Graph& g, NodeId id, double z)
{
    return evaluate<double>(g, std::vector<NodeId>{id}, {{"z", z}})[0];
}

} // namespace

TEST_CASE("the first four Stumpff functions are what their closed forms say")
{
    for (const double w : {1e-3, 0.5, 1.0, 2.0, 3.1, 7.0, 30.0}) {
        const double z = w * w;
        const auto near = [](double x) { return Approx(x).epsilon(tolerance::roundoff(64)); };
        CHECK(evaluate_stumpff(0, z) == near(std::cos(w)));
        CHECK(evaluate_stumpff(1, z) == near(std::sin(w) / w));
        CHECK(evaluate_stumpff(2, z) == near(2 * std::pow(std::sin(w / 2) / w, 2)));
        CHECK(evaluate_stumpff(0, -z) == near(std::cosh(w)));
        CHECK(evaluate_stumpff(1, -z) == near(std::sinh(w) / w));
        CHECK(evaluate_stumpff(2, -z) == near(2 * std::pow(std::sinh(w / 2) / w, 2)));
        if (w >= 0.5) CHECK(evaluate_stumpff(3, z) == Approx((w - std::sin(w)) / (w * z)).epsilon(1e-13));
    }
}

TEST_CASE("neighbouring orders meet in the recurrence at all sizes of the argument")
{
    for (const unsigned k : {0U, 1U, 5U, 30U, 62U})
        for (const long double z : {-4e3L, -7.0L, -1.0L, -0.999L, 1e-30L, 0.999L, 1.0L, 42.0L, 1e9L}) {
            const long double left = z * evaluate_stumpff(k + 2, z) + evaluate_stumpff(k, z);
            const long double size = std::fabs(z * evaluate_stumpff(k + 2, z)) + std::fabs(evaluate_stumpff(k, z));
            const long double right = 1 / std::tgamma(1.0L + static_cast<long double>(k));
            CHECK(std::fabs(left - right) <= 1e-17L * (size + 100 * right));
        }
    CHECK(evaluate_stumpff(4, 0.0) == 1.0 / 24);
    CHECK(evaluate_stumpff(3, 5e-324) == 1.0 / 6);
    CHECK(std::isinf(evaluate_stumpff(2, -1e300)));
    CHECK(std::isnan(evaluate_stumpff(2, HUGE_VAL)));
}

TEST_CASE("a Stumpff function at 0 is the constant 1/k!, its slope -1/(k+2)!")
{
    Graph g;
    const NodeId z = g.input("z");
    CHECK(g.stumpff(5, g.constant(0)) == g.constant(Rational(1, 120)));
    CHECK(evaluate_exactly(g, std::vector<NodeId>{g.stumpff(3, z)}, {{"z", 0}}) == std::vector<Rational>{{1, 6}});
    CHECK(evaluate_exactly(g, std::vector<NodeId>{g.stumpff(3, z)}, {{"z", 1}}).empty());
    for (unsigned k = 0; k < 6; ++k) {
        const NodeId slope = gradient(g, g.stumpff(k, z), std::vector<NodeId>{z})[0];
        CHECK(evaluate_exactly(g, std::vector<NodeId>{slope}, {{"z", 0}})[0] == Rational(-stumpff_at_zero(k + 2)));
    }
    CHECK(to_text(g, gradient(g, g.stumpff(2, z), std::vector<NodeId>{z})[0]) == "(2*stumpff(4, z) - stumpff(3, z))/2");
    CHECK_THROWS_AS(g.stumpff(65, z), MathematicsError);
}

TEST_CASE("the derivative of c_k satisfies the derivative of the recurrence")
{
    // (z c_{k+2} + c_k)' = c_{k+2} + z c_{k+2}' + c_k' = 0
    Graph g;
    const NodeId z = g.input("z");
    for (const unsigned k : {0U, 1U, 2U, 7U}) {
        const NodeId sum = g.add(g.multiply(z, g.stumpff(k + 2, z)), g.stumpff(k, z));
        const NodeId slope = gradient(g, sum, std::vector<NodeId>{z})[0];
        for (const double at : {-9.0, -0.3, 1e-9, 2.0, 50.0})
            CHECK(value(g, slope, at) ==
                  Approx(0).margin(tolerance::roundoff(64) * value(g, g.stumpff(k, z), at) + tolerance::roundoff(8)));
    }
}

TEST_CASE("simplification and substitution keep the order of a Stumpff function")
{
    Graph g;
    const NodeId z = g.input("z");
    const NodeId x = g.input("x");
    const NodeId argument = g.add(g.power(x, 2), z);
    const NodeId sum =
        g.add(g.multiply(x, g.stumpff(1, argument)),
              g.add(g.multiply(g.constant(2), g.stumpff(2, argument)), g.multiply(z, g.stumpff(1, argument))));
    const std::vector<NodeId> outputs{sum};
    const auto simple = simplify(g, outputs);
    const std::map<std::string, double> at{{"x", 0.7}, {"z", -0.2}};
    CHECK(evaluate<double>(g, simple, at)[0] ==
          Approx(evaluate<double>(g, outputs, at)[0]).epsilon(tolerance::roundoff(8)));
    const std::pair<NodeId, NodeId> shift[] = {{z, g.constant(0)}};
    CHECK(substitute(g, std::vector<NodeId>{g.stumpff(4, z)}, shift)[0] == g.constant(Rational(1, 24)));
    CHECK(to_text(g, substitute(g, std::vector<NodeId>{g.stumpff(4, argument)}, shift)[0]) == "stumpff(4, x^2)");
}

TEST_CASE("the Stumpff functions of one argument count as one call")
{
    Graph g;
    const NodeId z = g.input("z");
    const std::vector<NodeId> one{g.stumpff(1, z)};
    const std::vector<NodeId> two{g.stumpff(1, z), g.stumpff(2, z)};
    CHECK(count_operations(g, one).functions == 1);
    CHECK(count_operations(g, two).functions == 1);
    CHECK(count_operations(g, two).weight < 2 * count_operations(g, one).weight);
}
