// SPDX-License-Identifier: GPL-2.0-or-later
/// Constant parts of expressions that have no real value, and those that have one or are not decided.
#include "expression/parse.hpp"
#include "proof/constant_values.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// The message of the refusal, or "".
std::string refusal(const std::string& text)
{
    ConstantValues values;
    try {
        values.require(parse_expression(whole_text("<test>", text)));
    } catch (const ModelError& error) {
        return error.diagnostic().message;
    }
    return "";
}

} // namespace

TEST_CASE("a constant without a real value is refused with what is wrong")
{
    CHECK(refusal("x + log(0)") == "log has no real value: its argument '0' is 0, a positive number is required");
    CHECK(refusal("log(-1)") == "log has no real value: its argument '-1' is negative, a positive number is required");
    CHECK(refusal("2*sqrt(-2)") ==
          "sqrt has no real value: its argument '-2' is negative, 0 or a positive number is required");
    CHECK(refusal("asin(2)") ==
          "asin has no real value: its argument '2' is outside -1..1, a number from -1 to 1 is required");
    CHECK(refusal("acos(-pi/3)") ==
          "acos has no real value: its argument '-pi/3' is outside -1..1, a number from -1 to 1 is required");
    CHECK(refusal("tan(3*pi/2)") == "tan has no real value: its argument '3*pi/2' is an odd multiple of pi/2, an angle "
                                    "whose cosine is not 0 is required");
    CHECK(refusal("atan2(sin(pi), 0)") ==
          "atan2 has no real value: both arguments are 0, one other than 0 is required");
    CHECK(refusal("(1 - sqrt(2))^(1/2)") == "the power has no real value: its base '1 - sqrt(2)' is negative, with an "
                                            "exponent that is not an integer a positive base is required");
    // Where the graph folds the divisor it is refused as division by zero.
    CHECK_FALSE(refusal("sin(pi)^(-2)").empty());
    CHECK_FALSE(refusal("x/(sqrt(2)^2 - 2)").empty());
    CHECK(refusal("1/(sin(1)^2 + cos(1)^2 - 1)") ==
          "the quotient has no real value: its divisor 'sin(1)^2 + cos(1)^2 - "
          "1' is 0, a divisor other than 0 is required");
}

TEST_CASE("names that fold away leave a constant")
{
    CHECK(refusal("log(x - x)") == "log has no real value: its argument 'x - x' is 0, a positive number is required");
    CHECK(refusal("sqrt(x - x - 1)") ==
          "sqrt has no real value: its argument 'x - x - 1' is negative, 0 or a positive number is required");
    CHECK_FALSE(refusal("(x - x)/(x - x)").empty()); // division by zero
}

TEST_CASE("zeros are exact: a constant within rounding of a border is decided by algebra")
{
    CHECK_FALSE(refusal("log(sqrt(3 + 2*sqrt(2)) - sqrt(2) - 1)").empty());
    CHECK(refusal("log(sqrt(3 + 2*sqrt(2)) - sqrt(2) - 1 + 10^(-60))").empty());
    CHECK_FALSE(refusal("sqrt(sqrt(3 + 2*sqrt(2)) - sqrt(2) - 1 - 10^(-60))").empty());
    CHECK(refusal("sqrt(sqrt(3 + 2*sqrt(2)) - sqrt(2) - 1)").empty());
    CHECK(refusal("asin(sin(1)^2 + cos(1)^2)").empty());
    CHECK_FALSE(refusal("asin(sin(1)^2 + cos(1)^2 + 10^(-60))").empty());
}

TEST_CASE("what has a value, what depends on a name and what is not decided stay")
{
    for (const char* text : {"log(2)",
                             "sqrt(0)",
                             "asin(1)",
                             "acos(-1)",
                             "tan(pi/4)",
                             "tan(1)",
                             "atan2(0, -1)",
                             "(-2)^3",
                             "(-2)^(-3)",
                             "0^2",
                             "2^(1/2)",
                             "log(x)",
                             "sqrt(x - 5)",
                             "asin(a)",
                             "x^(-1)",
                             "atan2(x, 0)",
                             "1/sin(1)",
                             "(x - 3)^(1/2)",
                             "log(exp(exp(exp(7))) - exp(exp(exp(7))) + 1)",
                             "sqrt(exp(-x^2) - 1)"}) {
        INFO(text);
        CHECK(refusal(text).empty());
    }
}

TEST_CASE("a branch that is not taken may have no value")
{
    CHECK(refusal("if(1 < 2, x, log(0))").empty());
    CHECK(refusal("if(2 < 1, log(0), x)").empty());
    CHECK_FALSE(refusal("if(2 < 1, x, log(0))").empty());
    CHECK_FALSE(refusal("if(x < 1, x, log(0))").empty());
    CHECK_FALSE(refusal("if(log(0) < 1, x, 0)").empty());
}
