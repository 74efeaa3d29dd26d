// SPDX-License-Identifier: GPL-2.0-or-later
/// Both sides in balls at one point.
#include "compare.hpp"

#include "elaborate/build_algebroid.hpp"
#include "proof/enclosure.hpp"

namespace lagen::laws {
namespace {

/// Entry names, nodes that lagen built, formulas.
struct Pairs {
    std::vector<std::string> names;
    std::vector<NodeId> nodes;
    std::vector<Formula> formulas;

    void add(std::string name, NodeId node, const Formula& formula)
    {
        names.push_back(std::move(name));
        nodes.push_back(node);
        formulas.push_back(formula);
    }
};

Pairs pairs_of(Graph& graph, const WrittenAlgebroid& built, const LocalAlgebroid& expected)
{
    Lowering lower(graph);
    const Algebroid lowered = lower_algebroid(graph, lower, built);
    Pairs pairs;
    for (std::size_t a = 0; a < expected.r(); ++a) {
        for (std::size_t i = 0; i < expected.n(); ++i)
            pairs.add("rho(" + expected.base[i] + ", " + expected.fibre[a] + ")",
                      Algebroid::entry(graph, lowered.anchor[a], i), expected.anchor(i, a));
        for (std::size_t b = a + 1; b < expected.r(); ++b)
            for (std::size_t c = 0; c < expected.r(); ++c)
                pairs.add("C(" + expected.fibre[c] + ", " + expected.fibre[a] + ", " + expected.fibre[b] + ")",
                          Algebroid::entry(graph, lowered.C(a, b), c), expected.bracket(c, a, b));
    }
    return pairs;
}

} // namespace

std::string difference_from(const WrittenAlgebroid& built, const LocalAlgebroid& expected, Dice& dice)
{
    if (built.r() != expected.r() || built.n() != expected.n()) return "rank or dimension differ";
    const std::optional<Point> point = random_point(expected, dice);
    if (!point || !residuals_at(expected, *point)) return "";
    Graph graph;
    const Pairs pairs = pairs_of(graph, built, expected);
    proof::BallInputs inputs;
    for (const auto& [name, value] : *point) {
        proof::Ball ball;
        arb_set(ball.get(), value.get());
        inputs.emplace(graph.input(name), ball);
    }
    const proof::Evaluation evaluation(graph, pairs.nodes);
    const std::vector<proof::Ball> found = evaluation.enclose(inputs, ball_precision);
    JetEvaluation evaluate(*point, {});
    for (std::size_t k = 0; k < pairs.names.size(); ++k) {
        Ball value;
        arb_set(value.get(), found[k].get());
        if (!((value - evaluate(pairs.formulas[k]).value).bound() < 1e-60))
            return pairs.names[k] + " is " + std::to_string(value.middle()) + ", not " + pairs.formulas[k].text();
    }
    return "";
}

} // namespace lagen::laws
