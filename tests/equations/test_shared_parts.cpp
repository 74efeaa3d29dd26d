// SPDX-License-Identifier: GPL-2.0-or-later
/// Long equations with names for the parts that they share.
#include "equations/derive.hpp"
#include "equations/shared_parts.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/lagrange.hpp"
#include "model/read_model.hpp"
#include "support/dice.hpp"
#include "support/golden.hpp"
#include "support/stages.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace lagen;
using lagen::testing::Dice;
using lagen::testing::read_text;

namespace {

/// The trees of equations as nodes, each name of `where` in the place of what it stands for.
class Nodes {
  public:
    explicit Nodes(const EquationSet& set)
    {
        for (const WhereEntry& entry : set.where) bind(entry.symbol, (*this)(entry.value));
        for (const NodeId input : graph.inputs()) CHECK_FALSE(binding_.contains(graph.input_name(input)));
    }

    NodeId operator()(const Tree& tree) { return Lowering(graph, binding_)(tree); }

    NodeId operator()(const std::vector<TermGroup>& groups)
    {
        NodeId sum = graph.constant(0);
        for (const TermGroup& group : groups) sum = graph.add(sum, (*this)(group.value));
        return sum;
    }

    void bind(const std::string& name, NodeId node) { binding_[name] = node; }

    Graph graph;

  private:
    Binding binding_;
};

struct Arm {
    Model model;
    System system;
    EquationSet equations;
};

Arm read_arm(const std::string& name, const std::vector<std::pair<std::string, std::string>>& renamed = {})
{
    std::string text = lagen::testing::read_text(LAGEN_SOURCE_DIR "/tests/data/models/" + name + ".toml");
    for (const auto& [old, fresh] : renamed)
        for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + fresh.size()))
            text.replace(at, old.size(), fresh);
    Model model = read_model_text(name + ".toml", text);
    System system = elaborate(model);
    EquationSet equations = derive("lagrange", model, system, {}, {}, Definitions::kept);
    return {std::move(model), std::move(system), std::move(equations)};
}

/// Every function that the printed equations have, and the same of the graph.
struct Compared {
    std::vector<NodeId> printed, wanted;
};

Compared compared(const Arm& arm, Nodes& nodes, Graph& graph)
{
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, arm.system);
    const MomentumBalance balance = lagrange_balance(graph, arm.system, lagrangian);
    const LagrangeRates rates = lagrange_rates(graph, arm.system, lagrangian, balance);
    const auto& blocks = arm.equations.blocks;
    Compared result;
    const auto compare = [&](NodeId printed, NodeId wanted) {
        result.printed.push_back(printed);
        result.wanted.push_back(wanted);
    };
    const Equation& L = arm.equations.given.at(0).equations.at(0);
    compare(nodes(L.groups), *arm.system.lagrangian);
    nodes.bind(L.symbol, result.printed.back());
    for (std::size_t a = 0; a < arm.system.r(); ++a) {
        compare(nodes(blocks.at(0).equations.at(a).groups), rates.xdot[a]);
        const Equation& momentum = blocks.at(1).equations.at(a);
        compare(nodes(momentum.groups), balance.p[a]);
        nodes.bind(momentum.symbol, result.printed.back());
        compare(nodes(blocks.at(2).equations.at(a).groups), rates.pdot[a]);
        const Equation& acceleration = blocks.at(3).equations.at(a);
        compare(nodes(acceleration.groups), rates.force[a]);
        std::map<std::string, NodeId> mass;
        for (const TermGroup& entry : acceleration.mass) mass[entry.label] = nodes(entry.value);
        for (std::size_t b = 0; b < arm.system.r(); ++b) {
            const auto found = mass.find(arm.model.fibre.coordinates[b].name);
            compare(found == mass.end() ? nodes.graph.constant(0) : found->second, lagrangian.fibre.W(a, b));
        }
    }
    compare(nodes(blocks.at(4).equations.at(0).groups), lagrangian.energy);
    if (const auto power = lagrange_power(graph, arm.system, lagrangian, balance); blocks.size() > 5)
        compare(nodes(blocks.at(5).equations.at(0).groups), *power);
    return result;
}

void check_values(const Arm& arm)
{
    Nodes nodes(arm.equations);
    Graph graph = arm.system.graph;
    const Compared functions = compared(arm, nodes, graph);
    Dice dice(11);
    for (int point = 0; point < 3; ++point) {
        std::map<std::string, long double> values;
        for (const Graph* each : {&nodes.graph, &graph})
            for (const NodeId input : each->inputs())
                values.try_emplace(each->input_name(input), 0.25L + static_cast<long double>(dice.below(1000)) / 500);
        const auto printed = evaluate<long double>(nodes.graph, functions.printed, values);
        const auto wanted = evaluate<long double>(graph, functions.wanted, values);
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            INFO("function " << k << ": " << printed[k] << " for " << wanted[k]);
            CHECK(std::abs(printed[k] - wanted[k]) <= 1e-14L * (1 + std::abs(wanted[k])));
        }
    }
}

/// The names in `where` that are no definitions are stem1, stem2, .. in their order.
std::size_t check_names(const Arm& arm, const std::string& stem)
{
    std::size_t parts = 0;
    std::set<std::string> names;
    for (const WhereEntry& entry : arm.equations.where) {
        INFO(entry.symbol);
        CHECK(names.insert(entry.symbol).second);
        if (arm.model.columns.has_definition(entry.symbol.substr(0, entry.symbol.find('[')))) continue;
        CHECK(entry.symbol == stem + std::to_string(++parts));
    }
    CHECK(parts < arm.equations.where.size());
    return parts;
}

} // namespace

TEST_CASE("the equations of an arm with seven joints are short, and have the values of those on the graph")
{
    const Arm arm = read_arm("arm7");
    CHECK(check_names(arm, "s") > 100);
    check_values(arm);
    CHECK(print_text(arm.equations).size() < 100'000);
    CHECK(print_latex(arm.equations).find("  s_{1} &= ") != std::string::npos);
    CHECK(print_json(arm.equations).find(R"({"symbol": "s1", "value": ")") != std::string::npos);
    const EquationBlock& motion = arm.equations.blocks.at(3);
    CHECK(motion.formula ==
          "W_ab ẏ^b = ρ_a(L) - (∂²L/∂y^a∂x^i) ρ^i_b y^b + Q_a,  W_ab = ∂²L/∂y^a∂y^b"); // neither t nor a bracket
}

TEST_CASE("names of shared parts are none of the model")
{
    const Arm arm = read_arm("arm6", {{"shoulder", "s2"}});
    check_names(arm, "s_");
    check_values(arm);
    CHECK(print_text(arm.equations).find("\n  L = kinetic - potential\n") != std::string::npos);
}

TEST_CASE("parts that are used twice have names, products and sums are flat")
{
    Graph graph;
    const NodeId a = graph.input("a"), b = graph.input("b"), c = graph.input("c");
    const NodeId sum = graph.add(graph.add(a, graph.multiply(graph.constant(Rational(1, 2)), b)), c);
    const NodeId square = graph.multiply(graph.multiply(b, c), b);
    const NodeId roots[] = {graph.subtract(graph.apply(Op::sin, sum), graph.divide(a, sum)),
                            graph.negate(graph.multiply(square, graph.constant(Rational(3, 4))))};
    const SharedParts parts = shared_parts(graph, roots, {{square, "D"}}, [](const std::string&) { return false; });
    REQUIRE(parts.where.size() == 2);
    CHECK(parts.where[0].symbol + " = " + to_text(parts.where[0].value) == "s1 = a + b/2 + c");
    CHECK(parts.where[1].symbol + " = " + to_text(parts.where[1].value) == "D = b^2*c");
    CHECK(to_text(parts.values[0]) == "sin(s1) - a/s1");
    CHECK(to_text(parts.values[1]) == "-3*D/4");
    const PartCount count = count_parts(graph, std::span(roots).first(1));
    CHECK(count.written == 18);
    CHECK(count.nodes == 10);
}
