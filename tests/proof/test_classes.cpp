// SPDX-License-Identifier: GPL-2.0-or-later
/// The classes of functions that the zero decision covers, one case each.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

void check_proved(const Statement& statement, const std::vector<std::string>& texts)
{
    for (const std::string& text : texts) {
        Problem problem(statement);
        const NodeId residual = problem.node(text);
        const Decision decision = problem.decider->decide(residual);
        INFO(text << ": " << decision.residual << "; " << decision.evidence);
        CHECK(to_text(decision.status) == std::string("proved"));
        CHECK(problem.decider->largest_bound(residual, 3) < 1e-60);
    }
}

void check_positive(const Statement& statement, const std::vector<std::string>& texts)
{
    for (const std::string& text : texts) {
        Problem problem(statement);
        INFO(text);
        CHECK(problem.decider->proves_positive(problem.node(text)));
        CHECK_FALSE(problem.decider->proves_positive(problem.node("-(" + text + ")")));
    }
}

} // namespace

TEST_CASE("trigonometric identities with halves, multiples and parts of pi are proved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {}, {}};
    check_proved(
        statement,
        {"sin(x)^4 - (3 - 4*cos(2*x) + cos(4*x))/8", "tan(x/2) - (1 - cos(x))/sin(x)", "tan(x/2) - sin(x)/(1 + cos(x))",
         "sin(2*x) - 2*tan(x)/(1 + tan(x)^2)", "sin(x)*sin(y) - (cos(x - y) - cos(x + y))/2",
         "tan(3*x) - (3*tan(x) - tan(x)^3)/(1 - 3*tan(x)^2)", "sin(x/6 + y/4)*cos(x/6 - y/4) - (sin(x/3) + sin(y/2))/2",
         "cos(x*y + x/y) - cos(x*y)*cos(x/y) + sin(x*y)*sin(x/y)",
         "tanh(x + y) - (tanh(x) + tanh(y))/(1 + tanh(x)*tanh(y))", "tanh(x/2) - (cosh(x) - 1)/sinh(x)",
         "cosh(3*x) - 4*cosh(x)^3 + 3*cosh(x)", "sin(x + 3*pi) + sin(x)", "cos(x - pi/3) - cos(x)/2 - sqrt(3)/2*sin(x)",
         "sin(100*x) - 2*sin(50*x)*cos(50*x)", "sin(101*x)*cos(x) - cos(101*x)*sin(x) - sin(100*x)"});
}

TEST_CASE("nested roots, powers of roots and roots of squares are proved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {}, {}};
    check_proved(statement, {"sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3)",
                             "sqrt(7 - 4*sqrt(3)) - 2 + sqrt(3)",
                             "sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2)",
                             "sqrt(9 + 4*sqrt(5)) - 2 - sqrt(5)",
                             "(7 + 5*sqrt(2))^(1/3) - 1 - sqrt(2)",
                             "(2 + sqrt(5))^(1/3) - (1 + sqrt(5))/2",
                             "sqrt(10 + 2*sqrt(6) + 2*sqrt(10) + 2*sqrt(15)) - sqrt(2) - sqrt(3) - sqrt(5)",
                             "sqrt(1 + sqrt(1 - x^2/4))*sqrt(1 - sqrt(1 - x^2/4)) - abs(x)/2",
                             "1/(sqrt(x) + sqrt(y)) - (sqrt(x) - sqrt(y))/(x - y)",
                             "1/(sqrt(2) + sqrt(3)) - sqrt(3) + sqrt(2)",
                             "sqrt(x^2 + y^2)^3 - (x^2 + y^2)*sqrt(x^2 + y^2)",
                             "(x^2 + y^2)^(3/2)/(x^2 + y^2) - sqrt(x^2 + y^2)",
                             "(8*x)^(1/3) - 2*x^(1/3)",
                             "x^(1/3)*x^(1/6) - sqrt(x)",
                             "sqrt(1/sqrt(x^2 + y^2)^2) - 1/sqrt(x^2 + y^2)",
                             "(sqrt(x^2 + y^2)^4)^(1/6) - (x^2 + y^2)^(1/3)",
                             "(x^3)^(1/3) - x",
                             "(x^6)^(1/3) - x^2",
                             "(x^2)^(1/4) - sqrt(abs(x))",
                             "sqrt(sqrt(x)) - x^(1/4)",
                             "sqrt(x^4 + 2*x^2 + 1) - x^2 - 1",
                             "sqrt(x + 1 + 2*sqrt(x)) - sqrt(x) - 1",
                             "sqrt(x + y + 2*sqrt(x*y)) - sqrt(x) - sqrt(y)",
                             "sqrt(x + sqrt(x^2 - y^2)) - sqrt((x + y)/2) - sqrt((x - y)/2)",
                             "sqrt(4*x^2 + 4*x*y + y^2) - abs(2*x + y)",
                             "sqrt(x^2*(1 + y)) - abs(x)*sqrt(1 + y)",
                             "sqrt(1 - cos(x)) - sqrt(2)*abs(sin(x/2))",
                             "sqrt(1 + cos(x)) - sqrt(2)*abs(cos(x/2))",
                             "sqrt(1 + sin(2*x)) - abs(sin(x) + cos(x))",
                             "sqrt(cosh(x)^2 - 1) - abs(sinh(x))",
                             "sqrt(1 + sinh(x)^2) - cosh(x)",
                             "sqrt((1 - x)/(1 + x)) - sqrt(1 - x^2)/(1 + x)",
                             "sqrt(x/y)*sqrt(y/x) - 1",
                             "2^(1/2)*2^(1/3) - 2^(5/6)",
                             "6^(1/3) - 2^(1/3)*3^(1/3)",
                             "1/2^(1/3) - 4^(1/3)/2",
                             "sqrt(8) - 2*sqrt(2)",
                             "sqrt(x^2 - 2*x*sin(y) + 1 - cos(y)^2) - abs(x - sin(y))"});
}

TEST_CASE("roots, powers and logarithms of positive numbers are proved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {"x > 0", "y > 0"}, {}};
    check_proved(statement, {"sqrt(x^2 + 2*x*y + y^2) - x - y",
                             "sqrt(x^2/y^2) - x/y",
                             "sqrt(x^3) - x*sqrt(x)",
                             "sqrt(2*x^2 + 2*x*sqrt(x^2 + 1) + 1) - x - sqrt(x^2 + 1)",
                             "sqrt(x + sqrt(x^2 - 1)) - sqrt((x + 1)/2) - sqrt((x - 1)/2)",
                             "(x*y)^(1/3) - x^(1/3)*y^(1/3)",
                             "x^y*x^(2*y) - x^(3*y)",
                             "(x*y)^z - x^z*y^z",
                             "(x^y)^z - x^(y*z)",
                             "x^y - exp(y*log(x))",
                             "log(x/y) - log(x) + log(y)",
                             "log(x^y) - y*log(x)",
                             "log(sqrt(x*y)) - log(x)/2 - log(y)/2",
                             "log(x^2 + 2*x*y + y^2) - 2*log(x + y)",
                             "log(x^2) - 2*log(x)",
                             "log(1/x) + log(x)",
                             "exp(-log(x)/3) - 1/x^(1/3)",
                             "log(exp(x)*y) - x - log(y)",
                             "log(12) - 2*log(2) - log(3)",
                             "log(x^2 - y^2) - log(x - y) - log(x + y)",
                             "log(sqrt(x) + sqrt(y)) + log(sqrt(x + y - 2*sqrt(x*y))) - log(abs(x - y))",
                             "log(exp(x) + exp(-x)) - log(2*cosh(x))",
                             "log(cosh(x)) + log(2) + x - log(1 + exp(2*x))",
                             "log(1 + x) - log(x) - log(1 + 1/x)",
                             "atan(x) + atan(1/x) - pi/2",
                             "atan2(y, x) - atan(y/x)",
                             "asin(x/sqrt(x^2 + y^2)) - atan2(x, y)"});
}

TEST_CASE("inverse trigonometric functions are undone and added")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {}, {}};
    check_proved(statement, {"sin(asin(x)) - x",
                             "cos(acos(x)) - x",
                             "tan(atan(x)) - x",
                             "cos(asin(x)) - sqrt(1 - x^2)",
                             "sin(acos(x)) - sqrt(1 - x^2)",
                             "tan(asin(x)) - x/sqrt(1 - x^2)",
                             "cos(atan(x)) - 1/sqrt(1 + x^2)",
                             "sin(atan(x)) - x/sqrt(1 + x^2)",
                             "sin(2*atan(x)) - 2*x/(1 + x^2)",
                             "cos(2*atan(x)) - (1 - x^2)/(1 + x^2)",
                             "cos(3*acos(x)) - 4*x^3 + 3*x",
                             "asin(x) + acos(x) - pi/2",
                             "asin(-x) + asin(x)",
                             "acos(-x) + acos(x) - pi",
                             "atan(-x) + atan(x)",
                             "sin(atan2(y, x)) - y/sqrt(x^2 + y^2)",
                             "cos(atan2(y, x)) - x/sqrt(x^2 + y^2)",
                             "tan(atan2(y, x)) - y/x",
                             "cos(2*atan2(y, x)) - (x^2 - y^2)/(x^2 + y^2)",
                             "sin(atan2(y, x) - z)*sqrt(x^2 + y^2) - y*cos(z) + x*sin(z)",
                             "sin(asin(x) + asin(y)) - x*sqrt(1 - y^2) - y*sqrt(1 - x^2)",
                             "asin(1/2) - pi/6",
                             "atan(1) - pi/4",
                             "acos(0) - pi/2",
                             "acos(-1/2) - 2*pi/3",
                             "atan(sqrt(3)) - pi/3",
                             "asin(sqrt(2)/2) - pi/4",
                             "atan2(1, 1) - pi/4",
                             "atan2(0, -1) - pi",
                             "atan2(-x, -y)*0 + atan2(2*x, 2*y) - atan2(x, y)",
                             "tan(acos(x)) - sqrt(1 - x^2)/x",
                             "atan(x/sqrt(1 - x^2)) - asin(x)",
                             "tan(atan(x) + atan(y)) - (x + y)/(1 - x*y)",
                             "sin(asin(x)/2)^2 - (1 - sqrt(1 - x^2))/2",
                             "atan(tan(x)/1) - atan(sin(x)/cos(x))"});
}

TEST_CASE("inverse functions of trigonometric functions are undone within one turn")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {"x > -1", "x < 1", "y > 0", "y < 1"}, {}};
    check_proved(statement, {"asin(sin(x)) - x", "atan(tan(x)) - x", "acos(cos(y)) - y", "atan2(sin(x), cos(x)) - x",
                             "asin(x) - atan(x/sqrt(1 - x^2))", "asin(y) - atan2(y, sqrt(1 - y^2))",
                             "atan(x) + atan(y) - atan((x + y)/(1 - x*y))"});
}

TEST_CASE("absolute values, signs, extremes and branches are proved by cases")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {}, {}};
    check_proved(statement, {"abs(x)^2 - x^2",
                             "abs(x - y) - abs(y - x)",
                             "abs(x)*abs(y) - abs(x*y)",
                             "abs(abs(x)) - abs(x)",
                             "abs(x/y) - abs(x)/abs(y)",
                             "abs(-3*x) - 3*abs(x)",
                             "sign(x)*abs(x) - x",
                             "min(x, y) + max(x, y) - x - y",
                             "max(x, y) - (x + y + abs(x - y))/2",
                             "min(x, y)*max(x, y) - x*y",
                             "if(x > 0, x, -x) - abs(x)",
                             "if(x > y, x, y) - max(x, y)",
                             "abs(x)^3 - x^2*abs(x)",
                             "sign(x*y) - sign(x)*sign(y)",
                             "abs(exp(x) - exp(y))*exp(-y) - abs(exp(x - y) - 1)",
                             "abs(x + abs(x)) - x - abs(x)",
                             "abs(x + y)*abs(x - y) - abs(x^2 - y^2)",
                             "abs(1 + x^2) - 1 - x^2",
                             "abs(sin(2*x)) - 2*abs(sin(x))*abs(cos(x))",
                             "abs(x)^(1/2)*abs(x)^(3/2) - x^2",
                             "sqrt(x^2)/x - sign(x)",
                             "sqrt((abs(x) + 1)^2) - abs(x) - 1"});
}

TEST_CASE("signs follow from chains of inequalities")
{
    const Statement statement{
        {"x", "y", "z", "w"}, {"a", "b"}, {}, {"x > 1", "y > x", "z > 2*y", "a > b", "b > 3"}, {}};
    check_proved(statement, {"sqrt((y - x)^2) - y + x", "sqrt((z - x)^2) - z + x", "abs(z - x - 1) - z + x + 1",
                             "abs(a - 3) - a + 3", "sqrt((x^2 - 1)^2) - x^2 + 1", "abs(x*y - 1) - x*y + 1",
                             "sqrt(x^4*(a - b)^2) - x^2*(a - b)", "abs(log(x)) - log(x)", "sqrt(log(y)^2) - log(y)",
                             "sqrt((sqrt(x) - 1)^2) - sqrt(x) + 1", "abs(sqrt(y) - sqrt(x)) - sqrt(y) + sqrt(x)",
                             "log(x^2 - 1) - log(x - 1) - log(x + 1)", "abs(x*y - x) - x*y + x"});
}

TEST_CASE("signs follow from a disk")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {"x^2 + y^2 < 1"}, {}};
    check_proved(statement,
                 {"abs(x) - sqrt(1 - (1 - x^2))", "sqrt((1 - x^2 - y^2)^2) - 1 + x^2 + y^2", "abs(1 - x) - 1 + x",
                  "abs(2 - x - y) - 2 + x + y", "sqrt((1 - y)^2) - 1 + y", "log(1 - x^2) - log(1 - x) - log(1 + x)"});
}

TEST_CASE("signs of sines and cosines follow from the range of the angle")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {"x > 0", "x < pi"}, {}};
    check_proved(statement, {"abs(sin(x)) - sin(x)", "sqrt(1 - cos(x)^2) - sin(x)", "abs(sin(x/2)) - sin(x/2)",
                             "abs(cos(x/2)) - cos(x/2)", "sqrt((1 - cos(x))/2) - sin(x/2)",
                             "sqrt((1 + cos(x))/2) - cos(x/2)", "log(sin(x)^2) - 2*log(sin(x))"});
}

TEST_CASE("signs and identities on a sphere are proved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {"x^2 + y^2 + z^2 - 1"}, {}, {}};
    check_proved(statement, {"sqrt(1 - z^2)^2 - x^2 - y^2", "abs(x)^2 + abs(y)^2 - 1 + z^2", "x*(x^2 + y^2 + z^2) - x",
                             "1/(x^2 + y^2) - 1/(1 - z^2)", "abs(2 - x) - 2 + x"});
}

TEST_CASE("a constraint with a coefficient that is not constant is solved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {"x*w - y*z"}, {}, {}};
    check_proved(statement, {"x*w/y - z", "x^2*w - x*y*z"});
}

TEST_CASE("a constraint whose coefficient is positive is solved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {"x*w - y*z - 1"}, {"x > 0"}, {}};
    check_proved(statement, {"w - (y*z + 1)/x", "sqrt(x^2*w^2) - abs(y*z + 1)"});
}

TEST_CASE("constraints with polynomial coefficients are solved")
{
    const Statement statement{
        {"x", "y", "z", "w"}, {"a", "b"}, {"(x^2 + y^2 + 1)*z - 2*x", "(x^2 + y^2 + 1)*w - 2*y"}, {}, {}};
    check_proved(statement, {"z/w - x/y", "z^2 + w^2 - 4*(x^2 + y^2)/(x^2 + y^2 + 1)^2"});
}

TEST_CASE("exponentials and hyperbolic functions of sums are proved")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {}, {}};
    check_proved(statement,
                 {"exp(x)^3 - exp(3*x)", "exp(x*(y + 1)) - exp(x*y)*exp(x)", "exp(x + log(2)) - 2*exp(x)",
                  "exp(3*log(abs(x))) - abs(x)^3", "sqrt(exp(x)) - exp(x/2)", "exp(x)^(1/3) - exp(x/3)",
                  "2^x*3^x - 6^x", "4^x - 2^(2*x)", "2^x - exp(x*log(2))", "exp(exp(x) + 1) - exp(1)*exp(exp(x))",
                  "exp(x)^y - exp(x*y)", "cosh(log(abs(x))) - (abs(x) + 1/abs(x))/2",
                  "log(exp(2*x) + 2*exp(x)*exp(y) + exp(2*y)) - 2*log(exp(x) + exp(y))",
                  "tanh(log(sqrt(1 + x^2))) - x^2/(2 + x^2)"});
}

TEST_CASE("polynomials and functions are proved positive")
{
    const Statement statement{{"x", "y", "z", "w"}, {"a", "b"}, {}, {"x > 0", "y > 0", "a > b", "b > 0"}, {}};
    check_positive(statement, {"a",
                               "a - b",
                               "a*x^2 + b*y^2",
                               "x^2 - x*y + y^2",
                               "a*x^2 + 2*b*x*y + a*y^2",
                               "(x + y)^2 - 4*x*y + 1",
                               "a^2 - b^2*cos(z)^2",
                               "a + b*cos(z)",
                               "a - b*sin(z)*cos(w)",
                               "2*x^2 - 2*x*z + z^2",
                               "x^2 + y^2 + z^2 - x*y",
                               "exp(x) - 1",
                               "log(1 + x)",
                               "sqrt(x + y)- sqrt(x)",
                               "cosh(x) - 1",
                               "a*b*x/(x + y)",
                               "a^3 - b^3",
                               "x + 1/x - 1",
                               "a*(1 - cos(z)^2) + b*cos(z)^2",
                               "1 + z^2 - z"});
}

TEST_CASE("regular points are found in thin and distant parts of the space")
{
    const std::vector<std::vector<std::string>> domains{{"x > 1000"},
                                                        {"x > 0", "x < 1/10^6"},
                                                        {"x^2 + y^2 > 1", "x^2 + y^2 < 10001/10000"},
                                                        {"x > 1", "y > 2*x", "z > y^2", "w < -z"},
                                                        {"x*y > 100", "x + y < 21", "a > x^3"},
                                                        {"exp(x) > 10^5", "sin(x) > 99/100"}};
    for (const auto& domain : domains) {
        Problem problem({{"x", "y", "z", "w"}, {"a", "b"}, {}, domain, {}});
        INFO(domain[0]);
        CHECK(problem.decider->sample_point());
        CHECK(to_text(problem.decide("(x + y)^2 - x^2 - 2*x*y - y^2").status) == std::string("proved"));
        CHECK(to_text(problem.decide("b + x/10^15").status) == std::string("refuted"));
    }
    // Defined where the points of the model are not.
    Problem far({{"x"}, {}, {}, {}, {}});
    CHECK(to_text(far.decide("sqrt(x - 10^6)^2*x - x^2 + 10^6*x").status) == std::string("proved"));
    CHECK(to_text(far.decide("sqrt(x - 10^6) - 1").status) == std::string("refuted"));
}
