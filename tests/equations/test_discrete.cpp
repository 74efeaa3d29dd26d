// SPDX-License-Identifier: GPL-2.0-or-later
/// The discrete equations that a person reads have the values of those on the graph, and the form of the textbooks.
#include "equations/derive.hpp"
#include "equations/printed_value.hpp"
#include "geometry/reference_models.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/discrete.hpp"
#include "model/families.hpp"
#include "support/model_equations.hpp"
#include "support/tolerances.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

struct Derived {
    Model model;
    System system;
    EquationSet equations;

    explicit Derived(const std::string& text)
        : model(read_model_text("test.toml", text)), system(elaborate(model)),
          equations(derive("discrete", model, system, Report{}))
    {
    }
};

} // namespace

TEST_CASE("momenta and equations that are printed have the values of the graph at arrows of all kinds")
{
    for (const DiscreteCase& each : discrete_cases()) {
        INFO(each.name);
        const Derived derived(each.model);
        const json::Value file = read_discrete_case(each.name);
        const ReferenceArrow first = each.arrow(file["steps"][3], file["parameters"]);
        const ReferenceArrow second = each.arrow(file["steps"][4], file["parameters"]);
        std::map<std::string, long double> values;
        Graph graph = derived.system.graph;
        for (const auto& [parameter, value] : derived.system.parameter_values)
            values[graph.input_name(parameter)] = evaluate<long double>(graph, {&value, 1}, {})[0];
        values["h"] = std::stold(file["parameters"]["h"].text);
        for (const auto& [name, value] : second.coordinates) values[next_name(name)] = value;
        for (const auto& [name, value] : first.coordinates) values[name] = value;
        values["t"] = 0;
        const DiscreteLegendre legendre =
            discrete_legendre(graph, *derived.system.groupoid, *derived.system.discrete->lagrangian);
        const std::vector<EquationBlock>& blocks = derived.equations.blocks;
        const std::size_t momenta = blocks.size() - 3;
        for (const auto& [block, nodes] : {std::pair{momenta, &legendre.minus}, {momenta + 1, &legendre.plus}}) {
            REQUIRE(blocks[block].equations.size() == nodes->size());
            const std::vector<long double> numbers = evaluate<long double>(graph, *nodes, values);
            for (std::size_t a = 0; a < numbers.size(); ++a)
                CHECK(std::abs(value_of(blocks[block].equations[a], values) - numbers[a]) <= 1e-14L);
        }
        for (const Equation& equation : blocks.back().equations) {
            CHECK(std::abs(value_of(equation, values)) <= 1e-13L);
            auto moved = values;
            long double shift = 0;
            for (const auto& [name, value] : second.coordinates) moved[next_name(name)] = value + (shift += 0.01L);
            CHECK(std::abs(value_of(equation, moved)) > 1e-5L);
        }
    }
}

TEST_CASE("the pendulum's discrete equation is Verlet's, in the text of the pair groupoid")
{
    const Derived derived(discrete_cases()[0].model);
    const std::string text = print_text(derived.equations);
    for (const char* part :
         {"momenta at the source:  F⁻L_a = →e_a(L)\n  p_v_q = h sin(q)/2 - q/h + q_next/h\n",
          "momenta at the target:  F⁺L_a = ←e_a(L)\n  p_v_q_next = q_next/h - h sin(q_next)/2 - q/h\n",
          "F⁺L(g) - F⁻L(h) = 0,  t(g) = s(h);  D₂L(x, y) + D₁L(y, z) = 0\n  0 = 2 q_next/h - h "
          "sin(q_next) - q/h - q_next_next/h\n"}) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    }
}

TEST_CASE("a model without a discrete Lagrangian that is written out has no discrete equations")
{
    const Model model =
        read_model_text("test.toml", "[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n");
    CHECK_THROWS_WITH(derive("discrete", model, elaborate(model), Report{}),
                      Catch::Contains("the model has no [discrete]"));
}

TEST_CASE("entries of a matrix that are the same on the whole group are not printed")
{
    const Derived rover(R"toml(
[parameters]
m = 1
J = 2
[base]
coordinates = ["p[1..2]"]
[fibre]
coordinates = ["w", "u", "v"]
[groupoid]
kind = "action"
group = "SE(2)"
action = { p = "[W[1,1]*(p[1]-W[1,3]) + W[2,1]*(p[2]-W[2,3]), W[1,2]*(p[1]-W[1,3]) + W[2,2]*(p[2]-W[2,3])]" }
[discrete]
step = "h"
L = "m*(W[1,3]^2+W[2,3]^2)/(2*h) + J*(1-W[1,1])/h - h*(p[1]^2+p[2]^2)/2"
)toml");
    const std::string text = print_text(rover.equations);
    INFO(text);
    for (const char* constant : {"W[3,1]", "W[3,2]", "W[3,3]", "W_next[3,1]", "W_next[3,2]", "W_next[3,3]"})
        CHECK(text.find(constant) == std::string::npos);
    for (const char* moving : {"W[1,3]", "W[2,1]", "W_next[1,3]"}) CHECK(text.find(moving) != std::string::npos);
}
