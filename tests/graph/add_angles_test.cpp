// SPDX-License-Identifier: GPL-2.0-or-later
/// Sines and cosines of sums from those of the terms: where, and with what error.
#include "graph/formulas.hpp"
#include "graph/simplify/form.hpp"
#include "graph/simplify/simplify.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

struct Angles {
    Graph g;
    NodeId a = g.input("a");
    NodeId b = g.input("b");
    NodeId sine(NodeId x) { return g.apply(Op::sin, x); }
    NodeId cosine(NodeId x) { return g.apply(Op::cos, x); }
    std::string added(std::initializer_list<NodeId> outputs)
    {
        return to_text(g, add_angles(g, std::vector<NodeId>(outputs)).back());
    }
};

} // namespace

TEST_CASE("the sine and cosine of a sum come from those of its terms where both stand under one already")
{
    Angles x;
    const NodeId difference = x.g.subtract(x.a, x.b);
    const NodeId sum = x.g.add(x.a, x.b);
    CHECK(x.added({x.sine(x.a), x.cosine(x.b), x.sine(difference)}) == "sin(a)*cos(b) - cos(a)*sin(b)");
    CHECK(x.added({x.sine(x.a), x.cosine(x.b), x.cosine(difference)}) == "cos(a)*cos(b) + sin(a)*sin(b)");
    CHECK(x.added({x.sine(x.a), x.cosine(x.b), x.sine(sum)}) == "sin(a)*cos(b) + cos(a)*sin(b)");
    CHECK(x.added({x.sine(x.a), x.cosine(x.b), x.cosine(sum)}) == "cos(a)*cos(b) - sin(a)*sin(b)");
    CHECK(x.added({x.sine(x.a), x.sine(difference)}) == "sin(a - b)");
}

TEST_CASE("below a quotient, a root or a function an angle stays whole, because relative accuracy matters there")
{
    Angles x;
    const NodeId s = x.sine(x.g.subtract(x.a, x.b));
    const NodeId c = x.cosine(x.g.subtract(x.a, x.b));
    const NodeId sin_a = x.sine(x.a);
    const NodeId sin_b = x.sine(x.b);
    CHECK(x.added({sin_a, sin_b, x.g.divide(x.g.constant(1), s)}) == "1/sin(a - b)");
    CHECK(x.added({sin_a, sin_b, x.g.power(s, -3)}) == "sin(a - b)^-3");
    CHECK(x.added({sin_a, sin_b, x.g.apply(Op::sqrt, x.g.subtract(x.g.constant(1), c))}) == "sqrt(1 - cos(a - b))");
    CHECK(x.added({sin_a, sin_b, x.g.divide(s, x.g.constant(3))}) == "(sin(a)*cos(b) - cos(a)*sin(b))/3");
}

TEST_CASE("by angle addition a sine errs by less than 1.5 epsilon of one, and by less than 2 epsilon of its angles")
{
    test::Random random(5);
    double worst = 0;
    double worst_in_angles = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        const auto unit = [&] { return static_cast<double>(random.below(1U << 30U)) / (1U << 29U) - 1; };
        const double scale = 10 * std::pow(10, 4 * (unit() - 1));
        const double a = scale * unit();
        const double offsets[] = {a - scale * unit(), 1e-6 * scale * unit(), M_PI_2 + 1e-6 * unit(),
                                  M_PI + 1e-6 * unit()};
        const double b = a - offsets[k % 4];
        const auto exact = static_cast<long double>(a) - static_cast<long double>(b);
        const double s = std::sin(a) * std::cos(b) - std::cos(a) * std::sin(b);
        const double c = std::cos(a) * std::cos(b) + std::sin(a) * std::sin(b);
        const auto sine_error = static_cast<double>(std::abs(s - std::sin(exact)));
        const auto cosine_error = static_cast<double>(std::abs(c - std::cos(exact)));
        worst = std::max({worst, sine_error, cosine_error});
        worst_in_angles = std::max(worst_in_angles, sine_error / (std::abs(a) + std::abs(b)));
    }
    CHECK(worst > tolerance::roundoff(0.5));
    CHECK(worst < tolerance::roundoff(1.5));
    CHECK(worst_in_angles > tolerance::roundoff(0.5));
    CHECK(worst_in_angles < tolerance::roundoff(2));
}

TEST_CASE("the double pendulum calls the library for two angles, not three")
{
    Graph g;
    const auto simple = simplify(g, test::double_pendulum(g));
    CHECK(count_operations(g, simple).functions == 2);
}
