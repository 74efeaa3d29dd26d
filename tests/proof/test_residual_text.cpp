// SPDX-License-Identifier: GPL-2.0-or-later
/// The texts of long residuals.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// Names of 40 letters: 12 of them fill more than a residual's text.
std::string long_name(int k)
{
    return std::string(38, 'a') + std::to_string(10 + k);
}

std::string residual_of(const std::string& text)
{
    std::vector<std::string> names;
    for (int k = 0; k < 12; ++k) names.push_back(long_name(k));
    return Problem({names, {}, {}, {}, {}}).decide(text).residual;
}

std::string product_of_all()
{
    std::string text = long_name(0);
    for (int k = 1; k < 12; ++k) text += "*" + long_name(k);
    return text;
}

} // namespace

TEST_CASE("a residual of one long term is cut in the term")
{
    const std::string text = residual_of(product_of_all());
    CHECK(text == product_of_all().substr(0, 397) + "...");
}

TEST_CASE("a residual of long terms shows the beginning of the first and the number of terms")
{
    const std::string text = residual_of(product_of_all() + " + 1");
    CHECK(text == product_of_all().substr(0, 383) + "... ... (2 terms)");
    CHECK(text.size() <= 400);
}

TEST_CASE("a residual of many terms shows whole terms and their number")
{
    std::string sum;
    std::string shown;
    for (int k = 0; k < 12; ++k) sum += (k == 0 ? "" : " + ") + long_name(k);
    for (int k = 0; k < 9; ++k) shown += (k == 0 ? "" : " + ") + long_name(k);
    CHECK(residual_of(sum) == shown + " ... (12 terms)");
}

TEST_CASE("the normal form is a tree whose text is the residual's")
{
    test::Problem problem({{"x", "y", "z"}, {"a"}, {}, {"a > 0"}, {}});
    for (const char* text :
         {"x + 1", "-3*x^2*y/4 + z/7", "sin(x + y)*exp(-a*x)/(x + y^2)", "sqrt(x^2 + 1) + log(a*(x^2 + 2))",
          "abs(x*y - 1)*pi", "(x^2 + 1)^(1/3)/(2*a)", "stumpff(2, x) + stumpff(1, x*y)", "atan2(y, x) - asin(x/9)"}) {
        const Decision decision = problem.decide(text);
        INFO(text << " is " << decision.residual);
        REQUIRE(decision.normal_form);
        const NodeId difference =
            problem.graph.subtract(Lowering(problem.graph)(decision.normal_form), problem.node(text));
        CHECK(to_text(problem.decider->decide(difference).status) == std::string("proved"));
        CHECK(to_text(decision.normal_form) == to_text(parse_expression(whole_text("<residual>", decision.residual))));
    }
    CHECK_FALSE(problem.decide("(x + y + 2*a)^40").normal_form); // too long to be shown
    CHECK(to_text(problem.decide("x - x").normal_form) == "0");
}
