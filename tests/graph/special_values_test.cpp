// SPDX-License-Identifier: GPL-2.0-or-later
/// Constants that come from calls: the exact value where there is one.
#include "expression/parse.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

NodeId lowered(Graph& graph, const std::string& text)
{
    return Lowering(graph)(parse_expression(whole_text("constant", text)));
}

std::string folded(const std::string& text)
{
    Graph graph;
    return to_text(graph, lowered(graph, text));
}

} // namespace

TEST_CASE("functions at multiples of pi/6 and pi/4 have their exact values")
{
    CHECK(folded("sin(pi/2)") == "1");
    CHECK(folded("cos(pi/2)") == "0");
    CHECK(folded("sin(-pi/2)") == "-1");
    CHECK(folded("cos(-pi)") == "-1");
    CHECK(folded("sin(1e6*pi)") == "0");
    CHECK(folded("cos(pi/3)") == "1/2");
    CHECK(folded("cos(0.5*pi + pi/6)") == "-1/2");
    CHECK(folded("sin(pi/4)") == "sqrt(2)/2");
    CHECK(folded("sin(5*pi/3)") == "-sqrt(3)/2");
    CHECK(folded("tan(pi/4)") == "1");
    CHECK(folded("tan(-pi/6)") == "-sqrt(3)/3");
    CHECK(folded("cos(pi/4)^2 + sin(pi/4)^2") == "1");
    CHECK(folded("x*sin(pi) + y*cos(2*pi)") == "y");
}

TEST_CASE("inverse functions at the sines of these angles are multiples of pi")
{
    CHECK(folded("asin(1)") == "pi/2");
    CHECK(folded("asin(-1/2)") == "-pi/6");
    CHECK(folded("acos(-1)") == "pi");
    CHECK(folded("acos(sqrt(3)/2)") == "pi/6");
    CHECK(folded("atan(1)") == "pi/4");
    CHECK(folded("atan(-sqrt(3))") == "-pi/3");
    CHECK(folded("atan2(1, 0)") == "pi/2");
    CHECK(folded("atan2(-2, 0)") == "-pi/2");
    CHECK(folded("atan2(0, -3)") == "pi");
    CHECK(folded("atan2(1, -1)") == "3*pi/4");
    CHECK(folded("atan2(-1/2, -sqrt(3)/2)") == "-5*pi/6");
    CHECK(folded("log(exp(2))") == "2");
    CHECK(folded("exp(log(3))") == "3");
    CHECK(folded("8^(1/3)") == "2");
    CHECK(folded("(4/9)^(3/2)") == "8/27");
    CHECK(folded("27^(-2/3)") == "1/9");
}

TEST_CASE("constants without a simpler exact value stay calls, with all digits of the scalar")
{
    for (const char* text : {"cos(0.3)", "sqrt(2)", "sin(pi/5)", "atan2(3, -4)", "2^(1/3)", "exp(1)", "tan(1)"}) {
        Graph graph;
        const NodeId node = lowered(graph, text);
        CHECK_FALSE(graph.is_constant(node));
    }
}

TEST_CASE("the values of constants that fold agree with the functions of the library")
{
    const double pi = std::acos(-1.0);
    for (int k = -30; k <= 30; ++k) {
        Graph graph;
        const std::string angle = "(" + std::to_string(k) + "*pi/12)";
        const auto value = [&](const std::string& f) {
            return evaluate<double>(graph, std::vector<NodeId>{lowered(graph, f + angle)}, {})[0];
        };
        CHECK(value("sin") == Approx(std::sin(k * pi / 12)).margin(1e-14));
        CHECK(value("cos") == Approx(std::cos(k * pi / 12)).margin(1e-14));
        if (k % 6 != 0 || k % 12 == 0) CHECK(value("tan") == Approx(std::tan(k * pi / 12)).margin(1e-14));
        const double x = std::cos(k * pi / 4), y = std::sin(k * pi / 4);
        const auto whole = [](double a) { return std::to_string(std::lround(1.5 * a)); };
        const std::string text = "atan2(" + whole(y) + "*sqrt(3), " + whole(x) + ")";
        CHECK(evaluate<double>(graph, std::vector<NodeId>{lowered(graph, text)}, {})[0] ==
              Approx(std::atan2(std::round(1.5 * y) * std::sqrt(3.0) + 0.0, std::round(1.5 * x))).margin(1e-14));
    }
}
