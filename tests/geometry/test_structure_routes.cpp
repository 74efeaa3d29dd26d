// SPDX-License-Identifier: GPL-2.0-or-later
/// Two routes to the structure equations, d d = 0 and the brackets of basis sections, on random algebroids and on near
/// misses, with exact values at rational points; and pull-back against d on morphisms.
#include "random_sections.hpp"

#include "geometry/structure_equations.hpp"
#include "graph/core/evaluate.hpp"
#include "model/read_model.hpp"
#include "support/sanitized.hpp"
#include "verify/random_algebroids.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::oracle;

namespace {

constexpr std::size_t trials = LAGEN_SANITIZED ? 60 : 500;

/// Values at a random rational point; nothing where a divisor vanishes there.
std::vector<Rational> values_at(const Graph& graph, const std::vector<NodeId>& nodes, Dice& dice)
{
    std::map<std::string, Rational> point;
    for (const NodeId input : graph.inputs())
        point[graph.input_name(input)] = Rational(static_cast<long>(dice.below(200)) - 100, 17L);
    for (auto& [name, value] : point) value.canonicalize();
    return evaluate_exactly(graph, nodes, point);
}

NodeId by_brackets(BaseGradient& partial, const Algebroid& algebroid, const Residual& residual)
{
    const std::vector<std::size_t>& k = residual.indices;
    const Column column = residual.name == "anchor" ? anchor_defect(partial, algebroid, k[0], k[1])
                                                    : jacobiator(partial, algebroid, k[0], k[1], k[2]);
    return Algebroid::entry(partial.graph(), column, k.back());
}

/// The equations that do not hold, by both routes: at a rational point where all entries are rational functions and
/// nothing constrains it, else by the zero decision.
std::size_t compare_routes(const RandomAlgebroid& random, Dice& dice)
{
    System system = elaborate(read_model_text("test.toml", "name = \"test\"\n" + model_text(random)));
    BaseGradient partial(system.graph, system.algebroid.x);
    const ResidualList list = structure_equations(partial, system.algebroid);
    std::vector<NodeId> nodes;
    for (const Residual& residual : list.residuals) {
        nodes.push_back(residual.value);
        nodes.push_back(by_brackets(partial, system.algebroid, residual));
    }
    std::vector<Rational> values = values_at(system.graph, nodes, dice);
    // What is violated may vanish at one point.
    const auto is_zero = [](const Rational& value) { return sgn(value) == 0; };
    for (int more = 0; more < 3 && std::ranges::all_of(values, is_zero); ++more)
        values = values_at(system.graph, nodes, dice);
    const ZeroDecider decider(system.graph, proof_setting(system.graph, system));
    const bool rational = !values.empty() && !random.on_sphere;
    std::size_t violated = 0;
    for (std::size_t k = 0; k + 1 < nodes.size(); k += 2) {
        if (rational) {
            CHECK(values[k] == values[k + 1]);
            violated += sgn(values[k]) != 0 ? 1 : 0;
            continue;
        }
        const ProofStatus status = decider.decide(nodes[k]).status;
        CHECK(status != ProofStatus::undecided);
        CHECK(status == decider.decide(nodes[k + 1]).status);
        violated += status == ProofStatus::refuted ? 1 : 0;
    }
    return violated;
}

} // namespace

TEST_CASE("d d = 0 exactly where the brackets of five hundred random algebroids and of their mutants say so")
{
    std::size_t violated = 0;
    for (std::size_t number = 0; number < trials; ++number) {
        Dice dice(number), mutant_dice(1000 + number);
        const RandomAlgebroid algebroid = random_algebroid(number, dice);
        INFO(model_text(algebroid));
        CHECK(compare_routes(algebroid, dice) == 0);
        const RandomAlgebroid near_miss = mutated(random_algebroid(number, mutant_dice), mutant_dice);
        const std::size_t equations = compare_routes(near_miss, mutant_dice);
        if (!holds_at_points(near_miss, mutant_dice)) {
            CHECK(equations > 0);
            ++violated;
        }
    }
    CHECK(violated > trials / 2);
}

TEST_CASE(
    "pull-back by a morphism commutes with d and with the wedge product; by another map it does not commute with d")
{
    // T(S^1 x R) -> so(3): a curve of rotations by th about e3 and ph about the new e1: w = (ph', sin(ph) th', cos(ph)
    // th')
    System source = elaborate(read_model_text("torus.toml", "[base]\ncoordinates = ['th', 'ph']\n[algebroid]\nkind = "
                                                            "'tangent'\n[fibre]\ncoordinates = ['u', 'v']\n"));
    Graph& graph = source.graph;
    const System target = elaborate(read_model_text(
        "so3.toml", "[fibre]\ncoordinates = ['a', 'b', 'c']\n[algebroid]\nkind = 'lie_algebra'\nalgebra = 'so(3)'\n"));
    Algebroid so3 = target.algebroid;
    for (Column& column : so3.bracket)
        for (ColumnEntry& entry : column) entry.value = graph.constant(target.graph.value(entry.value));
    const NodeId phi = source.algebroid.x[1];
    const NodeId sine = graph.apply(Op::sin, phi), cosine = graph.apply(Op::cos, phi);
    BundleMap map{{}, {{{1, sine}, {2, cosine}}, {{0, graph.constant(1)}}}};
    BaseGradient on_source(graph, source.algebroid.x), on_target(graph, {});
    Dice dice(9);
    const auto commutes = [&](const ExteriorForm& w) {
        const ExteriorForm left = differential(on_source, source.algebroid, pull_back(graph, map, w));
        const ExteriorForm right = pull_back(graph, map, differential(on_target, so3, w));
        return vanishes(graph, source, difference(graph, left, right));
    };
    const ExteriorForm v{1, {{{0}, graph.constant(2)}, {{1}, graph.constant(-3)}, {{2}, graph.constant(5)}}};
    const ExteriorForm w{1, {{{0}, graph.constant(1)}, {{2}, graph.constant(7)}}};
    CHECK(commutes(v));
    CHECK(commutes(w));
    CHECK(vanishes(graph, source,
                   difference(graph, pull_back(graph, map, wedge(graph, v, w)),
                              wedge(graph, pull_back(graph, map, v), pull_back(graph, map, w)))));
    map.fibre[0][0].value = graph.negate(sine);
    CHECK_FALSE(commutes(v));
}
