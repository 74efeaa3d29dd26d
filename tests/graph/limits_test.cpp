// SPDX-License-Identifier: GPL-2.0-or-later
/// Derivatives at points where the chain rule says 0/0 or 0 inf. Expected values by hand.
#include "graph/calculus/limits.hpp"

#include "expression/parse.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/simplify/simplify.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

struct Slopes {
    double by_x, by_y;
};

std::vector<NodeId> slope_nodes(Graph& graph, const std::string& text)
{
    const NodeId f = Lowering(graph)(parse_expression(whole_text("f", text)));
    const std::vector<NodeId> z{graph.input("x"), graph.input("y")};
    (void)graph.input("p");
    return jacobian_with_limits(graph, std::vector<NodeId>{f}, z)[0];
}

Slopes slopes_at(const std::string& text, double x, double y, bool simplified, double p = 1.5)
{
    Graph graph;
    std::vector<NodeId> slopes = slope_nodes(graph, text);
    if (simplified) slopes = simplify(graph, slopes);
    const std::vector<double> values =
        evaluate<double>(graph, slopes, std::map<std::string, double>{{"x", x}, {"y", y}, {"p", p}});
    return {values[0], values[1]};
}

} // namespace

TEST_CASE("products that vanish with a root or a modulus have their derivative there")
{
    struct Case {
        const char* text;
        double x, y, by_x, by_y;
    };
    const Case cases[] = {
        {"x*abs(x)", 0, 0, 0, 0},
        {"x*abs(x)", -2, 0, 4, 0},
        {"x*sqrt(x^2)", 0, 0, 0, 0},
        {"x*sqrt(x^2 + y^2)", 0, 0, 0, 0},
        {"x*sqrt(x^2 + y^2)", 0, 2, 2, 0},
        {"x*sqrt(x^2 + y^2)", 3, 4, 6.8, 2.4},
        {"y - 3*p*x*sqrt(x^2 + y^2)", 0, 0, 0, 1},
        {"(x^2 + y^2)^(3/2)", 0, 0, 0, 0},
        {"(x^2 + y^2)^(5/4)", 0, 0, 0, 0},
        {"abs(x)^p", 0, 1, 0, 0},
        {"abs(x)^1.2*y", 0, 1, 0, 0},
        {"y*abs(y)^(1/2)", 0, 0, 0, 0},
        {"y*abs(y)^0.3", 1, 0, 0, 0},
        {"x^(3/2)", 0, 0, 0, 0},
        {"x*sqrt(x)", 0, 0, 0, 0},
        {"sqrt(x^4)", 0, 0, 0, 0},
        {"sqrt(x^4)", -2, 0, -4, 0},
        {"(x^2)^(3/4)", 0, 0, 0, 0},
        {"(x^2)^0.7", 0, 0, 0, 0},
        {"(x^2)^p", 0, 0, 0, 0},
        {"(x^2)^0.7", -1, 0, -1.4, 0},
        {"abs(x^3)", 0, 0, 0, 0},
        {"abs(x^3)", -2, 0, -12, 0},
        {"abs(x^4)", -2, 0, -32, 0},
        {"sqrt(x^6)", -2, 0, -12, 0},
        {"sqrt(x^4 + y^4)", 0, 0, 0, 0},
        {"sqrt(x^4 + y^4)", 1, 0, 2, 0},
        {"(x^4 + 2*p*y^4)^0.3", 0, 0, 0, 0},
        {"sqrt(x^4*(1 + y^2))", 0, 1, 0, 0},
        {"y*sqrt(x^4 + y^4)", 0, 0, 0, 0},
        {"max(0, x)^2", 0, 0, 0, 0},
        {"max(0, x)^1.5", -1, 0, 0, 0},
        {"abs(x)*abs(y)", 0, 0, 0, 0},
        {"abs(x*y)*x", 0, 0, 0, 0},
        {"sqrt(max(0, x^2 - y^2))", 1, 2, 0, 0},
        {"sqrt(max(x^2 - y^2, 0))", 1, 2, 0, 0},
        {"sqrt(2*p*max(0, x)*y^2)", -1, 2, 0, 0},
        {"sqrt(max(0, x))", 0, 0, 0, 0},
        {"sqrt(max(0, x)^2 + max(0, y)^2)", -1, -1, 0, 0},
        {"max(0, x)^0.6", -1, 0, 0, 0},
        {"sqrt(if(x > 0, x, 0))", -1, 0, 0, 0},
        {"if(x > 0, x^2*log(x), 0)", 0, 0, 0, 0},
        {"cos(sqrt(x^2 + y^2))", 0, 0, 0, 0},
        {"cosh(abs(x))", 0, 0, 0, 0},
        {"x/(1 + abs(x))", 0, 0, 1, 0},
        {"sign(x)*x^2", 0, 0, 0, 0},
        {"x*sqrt(1 + x^2)", 0, 0, 1, 0},
    };
    for (const Case& each : cases)
        for (const bool simplified : {false, true}) {
            INFO(each.text << " at " << each.x << ", " << each.y << (simplified ? ", simplified" : ""));
            const Slopes found = slopes_at(each.text, each.x, each.y, simplified);
            CHECK(found.by_x == Approx(each.by_x).margin(1e-15));
            CHECK(found.by_y == Approx(each.by_y).margin(1e-15));
        }
}

TEST_CASE("where there is no derivative none is made up")
{
    for (const char* text : {"sqrt(x^2 + y^2)", "abs(x)", "sqrt(x)", "(x^2 + y^2)^(1/3)", "abs(x)^0.5",
                             "sqrt(x)*x^(1/3)", "(abs(x)^0.3)^3", "abs(x)*(1 + y)", "1 + x + abs(x)"}) {
        INFO(text);
        CHECK_FALSE(std::isfinite(slopes_at(text, 0, 0, false).by_x));
    }
    for (const char* text : {"abs(x)*y", "sqrt(x^2*y^4)", "sqrt(x^2*(1 + y^2))"}) {
        INFO(text);
        CHECK_FALSE(std::isfinite(slopes_at(text, 0, 1, false).by_x));
    }
}

TEST_CASE("functions without such products keep their nodes")
{
    for (const char* text : {"x/sqrt(x^2 + y^2)^3", "x*sqrt(1 + x^2)", "p*sqrt(1 - x^2)*y", "max(x, y)*sin(x)",
                             "log(x)*x*sqrt(x^2 + y^2)/(x^2 + y^2)", "x*exp(sqrt(x^2 + p^2))"}) {
        INFO(text);
        Graph graph;
        const std::vector<NodeId> limits = slope_nodes(graph, text);
        const NodeId f = Lowering(graph)(parse_expression(whole_text("f", text)));
        CHECK(limits ==
              jacobian(graph, std::vector<NodeId>{f}, std::vector<NodeId>{graph.input("x"), graph.input("y")})[0]);
    }
}
