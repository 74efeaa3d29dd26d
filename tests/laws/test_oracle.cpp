// SPDX-License-Identifier: GPL-2.0-or-later
/// The oracle itself, on algebroids whose residuals are known by hand, and the identities against it.
#include "disguise.hpp"
#include "judge.hpp"
#include "lie_algebras.hpp"
#include "model_text.hpp"

#include <catch2/catch.hpp>

using namespace lagen::laws;

namespace {

/// T R^2 with [e1, e2] = change e2: valid where `change` vanishes and nowhere else.
LocalAlgebroid plane_with(const Formula& change)
{
    LocalAlgebroid result({"x1", "x2"}, {"e1", "e2"});
    result.anchor(0, 0) = 1;
    result.anchor(1, 1) = 1;
    result.set_bracket(1, 0, 1, change);
    return result;
}

} // namespace

TEST_CASE("the residual of rho_1 = d/dx, rho_2 = x d/dy with C = 0 is 1 in d/dy, though its Jacobi identity holds")
{
    LocalAlgebroid E({"x", "y"}, {"a", "b"});
    E.anchor(0, 0) = 1;
    E.anchor(1, 1) = Formula::variable("x");
    const auto residuals = residuals_at(E, {{"x", Ball(mpq_class(2, 3))}, {"y", Ball(mpq_class(5))}});
    REQUIRE(residuals);
    REQUIRE(residuals->size() == 2);
    CHECK(residuals->at(0).value.middle() == 0);
    CHECK(residuals->at(1).name == "anchor");
    CHECK(residuals->at(1).indices == std::vector<std::string>{"a", "b", "y"});
    CHECK(residuals->at(1).value.middle() == 1);
}

TEST_CASE("one more term in [e2,e3] of sl(2)-like brackets leaves the Jacobi residual -e1")
{
    LocalAlgebroid E({}, numbered("e", 3));
    E.set_bracket(2, 0, 1, 1);
    E.set_bracket(0, 2, 0, 1);
    E.set_bracket(1, 1, 2, 1);
    // [e1,[e2,e3]] + [e2,[e3,e1]] + [e3,[e1,e2]] = [e1,e2] + [e2,e1] + 0 = 0
    Dice dice(1);
    CHECK(truth_of(E, dice, 1) == Truth::holds);
    E.set_bracket(2, 1, 2, 1);
    // [e1, e2 + e3] + [e2, e1] + 0 = e3 - e1 - e3
    const auto residuals = residuals_at(E, {});
    REQUIRE(residuals);
    CHECK(residuals->at(0).indices == std::vector<std::string>{"e1", "e2", "e3", "e1"});
    CHECK(residuals->at(0).value.middle() == -1);
    CHECK(residuals->at(2).value.middle() == 0);
}

TEST_CASE("all Bianchi types and all matrix algebras with their actions satisfy the structure equations")
{
    Dice dice(7);
    for (std::size_t number = 0; number < matrix_algebra_count(); ++number) {
        const MatrixAlgebra algebra = matrix_algebra(number);
        for (const LocalAlgebroid& E :
             {algebra.algebroid, linear_action(algebra), right_action(algebra), projective_action(algebra)})
            CHECK(truth_of(E, dice, 2) == Truth::holds);
    }
    for (const int n : {-1, 0, 1})
        for (const int m : {-1, 0, 1}) {
            CHECK(truth_of(bianchi(1, n, m, 0), dice, 1) == Truth::holds);
            CHECK(truth_of(bianchi(0, n, m, 2), dice, 1) == Truth::holds);
        }
    CHECK(truth_of(bianchi(1, 0, 0, 2), dice, 1) == Truth::violated);
}

TEST_CASE("a derivative of a formula agrees with the slope of its jet, for every function")
{
    const Formula x = Formula::variable("x");
    const Point point{{"x", Ball(mpq_class(7, 11))}};
    for (const char* f : {"sin", "cos", "tan", "exp", "log", "sqrt", "abs", "sinh", "cosh", "tanh", "atan"}) {
        const Formula formula = power(call(f, x * x + Formula(mpq_class(1, 3)) * x), 3) / (Formula(2) + x);
        JetEvaluation evaluate(point, {"x"});
        const Ball slope = evaluate(formula).slope[0], symbolic = evaluate(derivative(formula, "x")).value;
        INFO(f);
        CHECK((slope - symbolic).bound() < 1e-100);
        CHECK(slope.excludes_zero());
    }
}

TEST_CASE("an identity in the bracket of the plane is proved, its near miss is refuted, both as the oracle has it")
{
    const Formula x = Formula::variable("x1"), y = Formula::variable("x2");
    Dice dice(3);
    for (const Formula& zero : hidden_zeros(x, y)) {
        INFO(zero.text());
        CHECK(truth_of(plane_with(zero), dice, 12) == Truth::holds);
        CHECK(answer_of(model_text(plane_with(zero))).verdict == "valid");
    }
    for (const Formula& zero : hidden_zeros_of_positive(x, y)) {
        LocalAlgebroid E = plane_with(zero);
        E.positive = {x, y};
        INFO(zero.text());
        CHECK(truth_of(E, dice, 12) == Truth::holds);
        CHECK(answer_of(model_text(E)).verdict == "valid");
    }
    std::size_t violated = 0;
    for (const Formula& change : half_zeros(x, y)) {
        if (truth_of(plane_with(change), dice, 24) != Truth::violated) continue;
        INFO(change.text());
        CHECK(answer_of(model_text(plane_with(change))).verdict == "invalid");
        ++violated;
    }
    CHECK(violated + 1 == half_zeros(x, y).size());
}

TEST_CASE("the root that a square hides still says where a model is defined")
{
    // sqrt(x)^2 is defined where x >= 0, and there sqrt(x^2) = x.
    const Formula x = Formula::variable("x1");
    LocalAlgebroid E = plane_with(call("sqrt", power(x, 2)) - x);
    E.anchor(0, 0) = Formula(1) + power(call("sqrt", x), 2);
    CHECK(answer_of(model_text(E)).verdict == "valid");
}
