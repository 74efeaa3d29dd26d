// SPDX-License-Identifier: GPL-2.0-or-later
/// Values and derivatives of trees: Stumpff functions and linear systems.
#include "expression/evaluate_stumpff.hpp"
#include "model/evaluate_tree.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

Dual at(const Tree& tree, long double x)
{
    return evaluate(tree, {{"x", {x, 1}}});
}

/// The derivative against a difference quotient.
void check_slope(const Tree& tree, long double x)
{
    const long double h = 1e-6L;
    const long double difference = (at(tree, x + h).value - at(tree, x - h).value) / (2 * h);
    CHECK(static_cast<double>(at(tree, x).derivative) ==
          Approx(static_cast<double>(difference)).epsilon(tolerance::difference));
}

} // namespace

TEST_CASE("a tree's Stumpff function has the value and the slope of the function")
{
    const Tree tree = call(Function::stumpff, {number(3), multiply({number(2), name("x")})});
    for (const long double x : {-20.0L, -0.1L, 0.0L, 0.3L, 60.0L}) {
        CHECK(at(tree, x).value == evaluate_stumpff(3, 2 * x));
        check_slope(tree, x);
    }
}

TEST_CASE("a component of a linear system has the value and the slope of Cramer's rule")
{
    const Tree x = name("x");
    // A zero on the diagonal: rows must be exchanged.
    const std::vector<Tree> matrix{number(0), x, add({x, number(2)}), call(Function::sin, {x})};
    const std::vector<Tree> right{call(Function::exp, {x}), number(3)};
    for (const long double point : {0.5L, -1.25L}) {
        const long double determinant = -point * (point + 2);
        const long double first = (std::exp(point) * std::sin(point) - 3 * point) / determinant;
        const long double second = -(point + 2) * std::exp(point) / determinant;
        CHECK(static_cast<double>(at(solve_component(matrix, right, 0), point).value) ==
              Approx(static_cast<double>(first)).epsilon(tolerance::roundoff(8)));
        CHECK(static_cast<double>(at(solve_component(matrix, right, 1), point).value) ==
              Approx(static_cast<double>(second)).epsilon(tolerance::roundoff(8)));
        check_slope(solve_component(matrix, right, 0), point);
        check_slope(solve_component(matrix, right, 1), point);
    }
    CHECK_FALSE(std::isfinite(at(solve_component(matrix, right, 0), 0).value));
}
