// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Legendre transforms, discrete Euler-Lagrange equations and Newton's matrix along the reference
/// trajectories, which were computed from the differenced action sum.
#include "elaborate/elaborate.hpp"
#include "geometry/reference_models.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/discrete.hpp"
#include "model/read_model.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

/// The values of the case's parameters that the model has, and its step.
std::map<std::string, long double> parameters_of(const System& system, const json::Value& file)
{
    std::map<std::string, long double> values;
    Graph graph = system.graph;
    for (const auto& [parameter, value] : system.parameter_values) {
        const NodeId node[] = {value};
        values[graph.input_name(parameter)] = evaluate<long double>(graph, node, {})[0];
    }
    values["h"] = std::stold(file["parameters"]["h"].text);
    return values;
}

std::vector<long double> at_arrow(const Graph& graph, const std::vector<NodeId>& nodes,
                                  std::map<std::string, long double> values, const ReferenceArrow& arrow)
{
    for (const auto& [name, value] : arrow.coordinates) values[name] = value;
    values["t"] = 0;
    return evaluate<long double>(graph, nodes, values);
}

long double largest(const std::vector<long double>& values)
{
    long double size = 0;
    for (const long double value : values) size = std::max(size, std::abs(value));
    return size;
}

} // namespace

TEST_CASE("discrete momenta and equations hold along the reference trajectories of all kinds of groupoid")
{
    for (const DiscreteCase& each : discrete_cases()) {
        INFO(each.name);
        const json::Value file = read_discrete_case(each.name);
        System system = elaborate(read_model_text(each.name + ".toml", each.model));
        REQUIRE((system.groupoid && system.discrete && system.discrete->lagrangian));
        Graph& graph = system.graph;
        const Groupoid& groupoid = *system.groupoid;
        const DiscreteLegendre legendre = discrete_legendre(graph, groupoid, *system.discrete->lagrangian);
        const auto values = parameters_of(system, file);
        long double worst_momentum = 0, worst_equation = 0, size = 0;
        std::vector<long double> plus;
        const std::vector<json::Value>& steps = file["steps"].entries;
        REQUIRE(steps.size() >= 50);
        for (const json::Value& step : steps) {
            const ReferenceArrow arrow = each.arrow(step, file["parameters"]);
            const std::vector<long double> minus = at_arrow(graph, legendre.minus, values, arrow);
            size = std::max(size, largest(minus));
            const std::size_t first = minus.size() - arrow.momenta.size();
            for (std::size_t a = 0; a < arrow.momenta.size(); ++a)
                worst_momentum = std::max(worst_momentum, std::abs(minus[first + a] - arrow.momenta[a]));
            for (std::size_t a = 0; a < plus.size(); ++a)
                worst_equation = std::max(worst_equation, std::abs(plus[a] - minus[a]));
            plus = at_arrow(graph, legendre.plus, values, arrow);
        }
        CHECK(size > 0.1L);
        CHECK(worst_momentum <= tolerance::roundoff(1) * size);
        CHECK(worst_equation <= tolerance::roundoff(1) * size);
    }
}

TEST_CASE("the residual of two arrows is F+L of the first less F-L of the second")
{
    const DiscreteCase& each = discrete_cases()[3];
    System system = elaborate(read_model_text("top.toml", each.model));
    Graph& graph = system.graph;
    const Groupoid& groupoid = *system.groupoid;
    const DiscreteLegendre legendre = discrete_legendre(graph, groupoid, *system.discrete->lagrangian);
    const Arrow& g = groupoid.arrow;
    std::vector<NodeId> W;
    for (const NodeId entry : g.W) W.push_back(graph.input("next " + graph.input_name(entry)));
    const Arrow h{target(graph, groupoid, g), {}, W};
    const std::vector<NodeId> residual = discrete_euler_lagrange(graph, groupoid, legendre, g, h);
    const json::Value file = read_discrete_case(each.name);
    auto values = parameters_of(system, file);
    const ReferenceArrow before = each.arrow(file["steps"][6], file["parameters"]);
    for (const auto& [name, value] : each.arrow(file["steps"][7], file["parameters"]).coordinates)
        values["next " + name] = value;
    CHECK(largest(at_arrow(graph, residual, values, before)) <= tolerance::roundoff(10));
    values["next W[1,2]"] += 1e-3L;
    CHECK(largest(at_arrow(graph, residual, values, before)) > 1e-4L);
}

TEST_CASE("Newton's matrix is the derivative of F-L along the source fibre")
{
    for (const DiscreteCase& each : discrete_cases()) {
        INFO(each.name);
        const json::Value file = read_discrete_case(each.name);
        System system = elaborate(read_model_text(each.name + ".toml", each.model));
        Graph& graph = system.graph;
        const Groupoid& groupoid = *system.groupoid;
        const DiscreteLegendre legendre = discrete_legendre(graph, groupoid, *system.discrete->lagrangian);
        const std::vector<NodeId> N = newton_matrix(graph, groupoid, legendre.minus);
        const auto values = parameters_of(system, file);
        const ReferenceArrow arrow = each.arrow(file["steps"][5], file["parameters"]);
        const std::vector<NodeId> coordinates = groupoid.coordinates();
        const std::vector<long double> exact = at_arrow(graph, N, values, arrow);
        REQUIRE(largest(exact) > 0.1L);
        for (std::size_t b = 0; b < groupoid.r(); ++b) {
            std::vector<NodeId> direction;
            for (const ColumnEntry& entry : groupoid.left[b]) direction.push_back(entry.value);
            const std::vector<long double> field = at_arrow(graph, direction, values, arrow);
            const long double step = 1e-6L;
            std::vector<std::vector<long double>> ends;
            for (const long double side : {-step, step}) {
                ReferenceArrow moved = arrow;
                for (std::size_t k = 0; k < field.size(); ++k)
                    moved.coordinates[graph.input_name(coordinates[groupoid.left[b][k].index])] += side * field[k];
                ends.push_back(at_arrow(graph, legendre.minus, values, moved));
            }
            for (std::size_t a = 0; a < groupoid.r(); ++a)
                CHECK(std::abs((ends[1][a] - ends[0][a]) / (2 * step) - exact[a * groupoid.r() + b]) <=
                      tolerance::difference * largest(exact));
        }
    }
}

TEST_CASE("forces of a scheme do the work of the quadrature on the variations of both ends")
{
    const auto q = [](long double t, long double x, long double v) { return -0.3L * v * x + std::sin(2 * t) / 5; };
    const long double t = 0.4L, h = 0.2L, x = 1.1L, y = 1.25L, v = (y - x) / h;
    const std::string model = R"toml(
[base]
coordinates = ["q"]
[groupoid]
kind = "pair"
[lagrangian]
L = "v_q^2/2 + cos(q)"
[forces]
v_q = "-3/10*v_q*q + sin(2*t)/5"
[discrete]
step = "h"
scheme = )toml";
    const std::map<std::string, std::pair<long double, long double>> expected{
        {"midpoint", {h / 2 * q(t + h / 2, (x + y) / 2, v), h / 2 * q(t + h / 2, (x + y) / 2, v)}},
        {"trapezoidal", {h / 2 * q(t, x, v), h / 2 * q(t + h, y, v)}},
        {"left", {h * q(t, x, v), 0}}};
    for (const auto& [scheme, forces] : expected) {
        INFO(scheme);
        const System system = elaborate(read_model_text("driven.toml", model + '"' + scheme + "\"\n"));
        const DiscreteWork& work = system.discrete->work;
        REQUIRE((work.source.size() == 1 && work.target.size() == 1 && work.inner.empty()));
        const std::vector<long double> found =
            evaluate<long double>(system.graph, std::vector<NodeId>{work.source[0], work.target[0]},
                                  std::map<std::string, long double>{{"t", t}, {"h", h}, {"q", x}, {"q_next", y}});
        CHECK(std::abs(found[0] - forces.first) <= tolerance::roundoff(1));
        CHECK(std::abs(found[1] - forces.second) <= tolerance::roundoff(1));
    }
}
