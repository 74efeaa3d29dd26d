// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of discrete Lagrangians: what is printed has the values of the graph, what is said of them is
/// proved on all kinds of groupoids, and a wrong side, sign or bracket is refuted.
#include "equations/derive.hpp"
#include "equations/printed_value.hpp"
#include "geometry/reference_models.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/cartan.hpp"
#include "model/read_model.hpp"
#include "support/model_equations.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

const std::string body =
    "[parameters]\nJ = 1.3\nm1 = 1\nm2 = 2\n[groupoid]\nkind = \"group\"\ngroup = \"SE(2)\"\n[fibre]\n"
    "coordinates = [\"w\", \"u\", \"v\"]\n[discrete]\nstep = \"h\"\nL = \"J*(1 - (W[1,1] + "
    "W[2,2])/2)/h + (m1*W[1,3]^2 + m2*W[2,3]^2)/(2*h)\"\n";

/// The statuses of the statements where `change` was made to the system.
template <class Change>
Lines statuses(const std::string& text, Change change, std::string* printed = nullptr)
{
    const Model model = read_model_text("test.toml", text);
    System system = elaborate(model);
    change(system);
    const EquationSet equations = derive("cartan", model, system, Report{});
    if (printed != nullptr) *printed = print_text(equations) + print_json(equations);
    Lines lines;
    for (const DecidedStatement& statement : equations.statements) lines.push_back(statement.status);
    return lines;
}

void negate(Graph& graph, std::vector<Column>& columns)
{
    for (Column& column : columns)
        for (ColumnEntry& entry : column) entry.value = graph.negate(entry.value);
}

} // namespace

TEST_CASE("the Cartan sections that are printed have the values of the graph at arrows of all kinds, and are proved")
{
    for (const DiscreteCase& each : discrete_cases()) {
        INFO(each.name);
        const Model model = read_model_text("test.toml", each.model);
        const System system = elaborate(model);
        const EquationSet equations = derive("cartan", model, system, Report{});
        for (const DecidedStatement& statement : equations.statements) {
            INFO(statement.formula);
            CHECK(statement.status == "proved");
        }
        CHECK(equations.statements.size() == 4);
        const json::Value file = read_discrete_case(each.name);
        Graph graph = system.graph;
        std::map<std::string, long double> values;
        for (const auto& [parameter, value] : system.parameter_values)
            values[graph.input_name(parameter)] = evaluate<long double>(graph, {&value, 1}, {})[0];
        values["h"] = std::stold(file["parameters"]["h"].text);
        values["t"] = 0;
        for (const auto& [name, value] : each.arrow(file["steps"][3], file["parameters"]).coordinates)
            values[name] = value;
        const CartanSections cartan = cartan_sections(graph, system);
        const std::vector<const ExteriorForm*> forms{&cartan.minus, &cartan.plus, &cartan.omega};
        REQUIRE(equations.blocks.size() == forms.size());
        for (std::size_t k = 0; k < forms.size(); ++k) {
            std::map<Lines, long double> printed;
            for (const Equation& equation : equations.blocks[k].equations)
                printed[equation.arguments] = value_of(equation, values);
            CHECK(!printed.empty());
            for (const auto& [index, node] : forms[k]->components) {
                Lines names;
                for (const std::size_t a : index) names.push_back(system.written.algebroid.fibre[a % system.r()].name);
                CHECK(std::abs(printed[names] - evaluate<long double>(graph, {&node, 1}, values)[0]) <= 1e-13L);
            }
        }
    }
}

TEST_CASE("the pendulum's Cartan sections on pairs of points")
{
    const Model model = read_model_text("test.toml", discrete_cases()[0].model);
    const std::string text = print_text(derive("cartan", model, elaborate(model), Report{}));
    INFO(text);
    for (const char* part : {"  Θ⁻(v_q) = h sin(q)/2 - q/h + q_next/h\n",
                             "  Θ⁺(v_q) = q_next/h - h sin(q_next)/2 - q/h\n", "  Ω_L(v_q, v_q) = 1/h\n",
                             "ρ(E⁻_a) = -→e_a\n", "ρ(E⁺_a) = ←e_a\n", "\nstatements:\n  proved     dL = Θ⁺ - Θ⁻, "})
        CHECK(text.find(part) != std::string::npos);
}

TEST_CASE("a wrong sign, side or bracket is refuted")
{
    const std::string yes = "proved", no = "refuted";
    std::string printed;
    CHECK(statuses(
              body, [](System&) {}, &printed) == Lines{yes, yes, yes, yes});
    CHECK(printed.find("residual") == std::string::npos);
    // ->e_a with the other sign: its momenta are not those of the product, and -[->e_a, ->e_b] not ->[e_a, e_b].
    CHECK(statuses(body, [](System& system) { negate(system.graph, system.groupoid->right); }) ==
          Lines{no, yes, no, yes});
    CHECK(statuses(body, [](System& system) { system.groupoid->left = system.groupoid->right; }) ==
          Lines{no, no, yes, no});
    CHECK(statuses(
              body, [](System& system) { negate(system.graph, system.algebroid.bracket); }, &printed) ==
          Lines{yes, yes, no, no});
    for (const char* part :
         {"\n  refuted    -dΘ⁻ = Ω_L\n             residual(E⁻_w, E⁻_u) ", "\n             at ",
          R"("status": "refuted", "component": ["E⁻_w", "E⁻_u"], "residual": ")", R"("witness": {)"}) {
        INFO(printed);
        CHECK(printed.find(part) != std::string::npos);
    }
}

TEST_CASE("an algebroid that is not that of the groupoid beside it is refuted by the Cartan sections")
{
    const auto beside = [](const char* sign) {
        return statuses(body + "[algebroid]\nkind = \"lie_algebra\"\n[algebroid.bracket]\n\"w,u\" = { v = \"" + sign +
                            "1\" }\n\"w,v\" = { u = \"-1\" }\n",
                        [](System&) {});
    };
    CHECK(beside("") == Lines{"proved", "proved", "proved", "proved"});
    CHECK(beside("-") == Lines{"proved", "proved", "refuted", "refuted"});
}
