// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees to GiNaC and back: order and signs are ours.
#include "expression/parse.hpp"
#include "symbolic/shortest_form.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const Order order{{"m", "k", "I1", "I2", "I3"}, {"x", "y", "z", "w2", "w3", "th"}};

Tree parsed(const std::string& text)
{
    return parse_expression(whole_text("<test>", text));
}

/// Through GiNaC and back without a choice of form.
std::string returned(const std::string& text)
{
    SymbolTable symbols;
    const GiNaC::ex e = to_ginac(parsed(text), symbols);
    return to_text(from_ginac(e, symbols, order));
}

std::string shortest(const std::string& text)
{
    SymbolTable symbols;
    return to_text(shortest_form(to_ginac(parsed(text), symbols), symbols, order));
}

} // namespace

TEST_CASE("terms and factors come back as declared: parameters, then variables, higher powers first, numbers last")
{
    CHECK(returned("1 + y*k*x + x^2*m") == "m*x^2 + k*x*y + 1");
    CHECK(returned("z*y*x*k*m") == "m*k*x*y*z");
    CHECK(returned("cos(th)*x*m") == "m*x*cos(th)");
    CHECK(returned("5/3 + x^2 + x^3") == "x^3 + x^2 + 5/3");
}

TEST_CASE("signs of differences are chosen by content")
{
    CHECK(returned("(y - x)*m") == "m*(y - x)");
    CHECK(returned("(y - x)*(z - x)") == "(x - y)*(x - z)");
    CHECK(returned("(y - x)^3") == "-(x - y)^3");
    CHECK(returned("(y - x)^2") == "(x - y)^2");
    CHECK(returned("1/(y - x)") == "-1/(x - y)");
    CHECK(returned("-x - y") == "-x - y");
    CHECK(returned("-x + y") == "y - x");
}

TEST_CASE("odd and even functions lose the sign of their argument")
{
    CHECK(returned("sin(y - x)") == "-sin(x - y)");
    CHECK(returned("cos(y - x)") == "cos(x - y)");
    CHECK(returned("tanh(-x)*abs(y - x)") == "-tanh(x)*abs(x - y)");
    CHECK(returned("sin(x - y) + sin(y - x)") == "0");
    CHECK(returned("acos(-x)") == "acos(-x)");
}

TEST_CASE("Stumpff functions go through, with their value at 0 and their derivative")
{
    CHECK(returned("x*stumpff(2, y^2 + x)") == "x*stumpff(2, x + y^2)");
    CHECK(returned("stumpff(4, x - x)") == "1/24");
    SymbolTable symbols;
    const GiNaC::ex slope = to_ginac(parsed("stumpff(2, x*y)"), symbols).diff(symbols.symbol("x"));
    CHECK(to_text(shortest_form(slope, symbols, order)) == "y*stumpff(4, x*y) - y*stumpff(3, x*y)/2");
}

TEST_CASE("a linear system of up to four unknowns is solved explicitly, a larger one refused")
{
    const std::vector<Tree> matrix{name("m"), name("x"), name("y"), name("k")};
    const std::vector<Tree> right{name("z"), number(1)};
    SymbolTable symbols;
    const GiNaC::ex second = to_ginac(solve_component(matrix, right, 1), symbols);
    CHECK(to_text(shortest_form(second, symbols, order)) == "(m - y*z)/(m*k - x*y)");
    const std::vector<Tree> singular(4, name("x"));
    CHECK_THROWS_AS(to_ginac(solve_component(singular, right, 0), symbols), MathematicsError);
    try {
        (void)to_ginac(solve_component(std::vector<Tree>(25, name("x")), std::vector<Tree>(5, name("y")), 0), symbols);
        FAIL("five unknowns were written out");
    } catch (const MathematicsError& error) {
        CHECK(std::string(error.what()).find("the solution of 5 coupled linear equations is not written out") !=
              std::string::npos);
    }
}

TEST_CASE("roots keep what stands below them")
{
    CHECK(returned("k/sqrt(x^2 + y^2)") == "k/sqrt(x^2 + y^2)");
    CHECK(returned("k*x/(x^2 + y^2)^(3/2)") == "k*x/(x^2 + y^2)^(3/2)");
    CHECK(returned("sqrt(x^2)") == "sqrt(x^2)");
    CHECK(returned("sqrt(2)*x") == "sqrt(2)*x");
}

TEST_CASE("decimals are exact rationals and pi is a symbol of its own")
{
    CHECK(returned("0.1*x + 0.2*x") == "3*x/10");
    CHECK(returned("2*pi*x") == "2*pi*x");
}

TEST_CASE("a shared tree of 2^40 nodes is refused instead of being written out")
{
    Tree tree = parsed("x + y");
    for (int level = 0; level < 40; ++level)
        tree = multiply({call(Function::sin, {tree}), call(Function::cos, {tree})});
    SymbolTable symbols;
    CHECK_THROWS_WITH(to_ginac(tree, symbols),
                      "error: the expression has more than 50000 terms and factors when it is written out, too many "
                      "for a formula that a person could read");
}

TEST_CASE("functions that are not smooth are refused by name")
{
    SymbolTable symbols;
    CHECK_THROWS_WITH(to_ginac(parsed("max(x, y)"), symbols),
                      "error: the function max is not smooth, so that nothing is derived from it symbolically");
}

TEST_CASE("a divisor that GiNaC finds to be zero is named")
{
    SymbolTable symbols;
    CHECK_THROWS_WITH(to_ginac(parsed("1/(x - x)"), symbols), "error: division by x - x, which is zero everywhere");
}

TEST_CASE("the shortest form collects coefficients of parameters")
{
    CHECK(shortest("I2*w2*w3 - I3*w2*w3 - m*x") == "(I2 - I3)*w2*w3 - m*x");
    CHECK(shortest("-(I2*w2*w3 - I3*w2*w3)") == "(I3 - I2)*w2*w3");
    CHECK(shortest("I1*x*y + I2*x*y + z") == "(I1 + I2)*x*y + z");
    CHECK(shortest("m*x + k*x + y") == "m*x + k*x + y");
}

TEST_CASE("the shortest form factors, expands or keeps, whichever reads best")
{
    CHECK(shortest("x^2 + 2*x*y + y^2") == "(x + y)^2");
    CHECK(shortest("x*(y + 1) - x*y") == "x");
    CHECK(shortest("(x + y)^20") == "(x + y)^20");
    CHECK(shortest("(x^2 - y^2)/(x - y)") == "x + y");
    CHECK(shortest("I1*x^2/2 + I2*y^2/2") == "I1*x^2/2 + I2*y^2/2");
}

TEST_CASE("the shortest form knows that sin^2 + cos^2 is 1")
{
    CHECK(shortest("m*sin(th)^2 + m*cos(th)^2") == "m");
    CHECK(shortest("x*y - x*y*sin(th)^2") == "x*y*cos(th)^2");
    CHECK(shortest("x*sin(th)^4 + x*sin(th)^2*cos(th)^2 + x*cos(th)^2") == "x");
    CHECK(shortest("x*sin(th)^2 + y*cos(th)^2") == "x*sin(th)^2 + y*cos(th)^2");
}

TEST_CASE("the length of an expansion counts joined terms")
{
    SymbolTable symbols;
    CHECK(expanded_length(to_ginac(parsed("(x + y)*(x - y)"), symbols)) == 2U);
    CHECK(expanded_length(to_ginac(parsed("x*(y + 1) - x*y - x"), symbols)) == 0U);
    CHECK_FALSE(expanded_length(to_ginac(parsed("(x + y + z)^30"), symbols)).has_value());
}

TEST_CASE("many different divisors are not brought to one denominator")
{
    const auto is_short = [](const std::string& text) {
        SymbolTable symbols;
        return has_short_fraction(to_ginac(parsed(text), symbols));
    };
    CHECK(is_short("x/(y + z)"));
    CHECK(is_short("x/(y + z) + y/(x + z)^2 + 1/(y + z)"));
    CHECK(is_short("1/(1 + 1/(1 + 1/(1 + x)))"));
    std::string sum = "x";
    for (int k = 1; k <= 12; ++k) sum += " + " + std::to_string(k) + "/(x^2 + y*" + std::to_string(k) + " + z)";
    CHECK_FALSE(is_short(sum));
    CHECK_FALSE(is_short("(x + y + z)^50/(1 + x)"));
    CHECK(shortest(sum).size() <= sum.size() + 12);
}
