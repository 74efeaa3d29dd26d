// SPDX-License-Identifier: GPL-2.0-or-later
/// Bytes as a question to the zero decision, in x, y, z, on all of space, where all are positive, or on the sphere:
///   an expression by itself; the difference of two that are equal (never refuted); that plus a rational number that is
///   not 0 (never proved, where it is defined at all).
/// Every answer is examined by enclosures at other precisions and other points than those that gave it; a derivative of
/// what is proved to vanish on an open set is never refuted.
#include "fuzz/grow_tree.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/small_budget.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "proof/decide.hpp"
#include "proof/enclosure.hpp"
#include "proof/partial_parts.hpp"

#include <algorithm>
#include <array>

using namespace lagen;
using fuzz::accepted;
using fuzz::Choices;
using fuzz::require;
using fuzz::small_budget;
using proof::Ball;

namespace {

constexpr std::size_t largest_graph = 200;

enum class Place { everywhere, positive, sphere };

using Point = std::array<Rational, 3>;

struct Question {
    Graph graph;
    std::array<NodeId, 3> variables{};
    ProofSetting setting;
    Place place = Place::everywhere;
    Tree tree;
    NodeId residual = 0;
    bool known_zero = false;
    bool has_kinks = false;
};

void set_place(Question& question)
{
    Graph& g = question.graph;
    const char* const names[] = {"x", "y", "z"};
    NodeId equation = g.constant(-1);
    for (std::size_t k = 0; k < 3; ++k) {
        question.variables[k] = g.input(names[k]);
        question.setting.variables.push_back(question.variables[k]);
        equation = g.add(equation, g.power(question.variables[k], 2));
        if (question.place == Place::positive)
            question.setting.domain.push_back(g.apply(Op::greater, question.variables[k], g.constant(0L)));
    }
    if (question.place == Place::sphere) question.setting.constraints = {equation};
}

/// False where the expression is refused or too large to be asked about.
bool ask(Choices& choices, Question& question)
{
    question.place = std::array{Place::everywhere, Place::everywhere, Place::positive, Place::sphere}[choices.below(4)];
    const std::size_t mode = choices.below(8);
    question.tree = fuzz::grow(choices, mode == 0 ? 4 : 3);
    if (mode > 0) {
        Tree other = question.tree;
        for (std::size_t k = choices.below(3) + 1; k > 0; --k) other = fuzz::rewritten(choices, other);
        question.tree = add({question.tree, negate(other)});
        question.known_zero = mode < 6;
        if (mode >= 6) question.tree = add({question.tree, number(Rational(1, mode == 6 ? 2 : 1'000'000'007))});
    }
    question.has_kinks = fuzz::has_kinks(question.tree);
    set_place(question);
    return accepted([&] {
               Lowering lower(question.graph);
               question.residual = lower(question.tree);
               // What is folded away (0 * log(x)) says where the expression is defined all the same.
               for (const NodeId part : partial_parts(question.graph, lower, question.tree))
                   question.setting.defined.push_back(part);
           }) &&
           question.graph.size() <= largest_graph;
}

Ball enclosure(const Question& question, NodeId node, const Point& point, slong precision)
{
    proof::BallInputs inputs;
    for (std::size_t k = 0; k < 3; ++k) inputs.emplace(question.variables[k], Ball(point[k], precision));
    return proof::Evaluation(question.graph, {node}).enclose(inputs, precision)[0];
}

/// Rational points of the place; on the sphere by the stereographic projection of (s, t).
std::vector<Point> points_of(Place place)
{
    std::vector<Point> points;
    for (const auto& [s, t, u] :
         {std::array{3L, 5L, 11L}, {-4L, 9L, 2L}, {17L, -8L, -5L}, {-1L, -3L, 7L}, {29L, 12L, -31L}}) {
        Point point{Rational(s, 7), Rational(t, 6), Rational(u, 13)};
        for (Rational& value : point) value.canonicalize();
        if (place == Place::positive)
            for (Rational& value : point) value = abs(value);
        if (place == Place::sphere) {
            const Rational size = point[0] * point[0] + point[1] * point[1] + 1;
            point = {2 * point[0] / size, 2 * point[1] / size, (size - 2) / size};
        }
        points.push_back(point);
    }
    return points;
}

/// Everything that the expression names has a value at the point.
bool is_defined(const Question& question, const Point& point)
{
    return std::all_of(question.setting.defined.begin(), question.setting.defined.end(),
                       [&](NodeId part) { return enclosure(question, part, point, 400).is_finite(); });
}

/// The point of a witness where all its values are exact.
std::optional<Point> exact_point(const Witness& witness)
{
    Point point;
    require(witness.point.size() == 3, "a witness does not name every variable");
    for (std::size_t k = 0; k < 3; ++k) {
        if (!witness.point[k].second.exact) return std::nullopt;
        point[k] = *witness.point[k].second.exact;
    }
    return point;
}

/// By rational arithmetic, which decides x < min(x, 2) too: of numbers that are equal no enclosure says so.
bool is_exactly_not_zero(const Question& question, const Point& point)
{
    std::map<std::string, Rational> inputs;
    for (std::size_t k = 0; k < 3; ++k) inputs.emplace(question.graph.input_name(question.variables[k]), point[k]);
    const NodeId outputs[] = {question.residual};
    const std::vector<Rational> values = evaluate_exactly(question.graph, outputs, inputs);
    return !values.empty() && values[0] != 0;
}

void examine_refuted(const Question& question, const Decision& decision, const std::string& text)
{
    require(!question.known_zero, "refuted, but zero by an identity: " + text);
    require(decision.witness.has_value(), "refuted without a witness: " + text);
    const std::optional<Point> point = exact_point(*decision.witness);
    if (!point) return;
    if (question.place == Place::positive)
        for (const Rational& value : *point) require(value > 0, "a witness outside the domain: " + text);
    if (question.place == Place::sphere) {
        Rational left = -1;
        for (const Rational& value : *point) left += value * value;
        require(left == 0, "a witness off the sphere: " + text);
    }
    bool certain = is_exactly_not_zero(question, *point);
    for (slong precision = 777; precision < 30'000 && !certain; precision *= 3)
        certain = enclosure(question, question.residual, *point, precision).excludes_zero();
    require(certain, "a witness where zero is not excluded: " + text);
}

void examine_proved(const Question& question, const ZeroDecider& decider, const std::string& text)
{
    for (const Point& point : points_of(question.place))
        require(!is_defined(question, point) || !enclosure(question, question.residual, point, 400).excludes_zero(),
                "proved to be zero, but is not at a point: " + text);
    require(!decider.reevaluate(question.residual, 5).zero_excluded,
            "proved, and its re-evaluation excludes zero: " + text);
}

void examine_slopes(Question& question, const std::string& text)
{
    if (question.has_kinks || question.place == Place::sphere) return;
    const std::vector<NodeId> slopes = gradient(question.graph, question.residual, question.variables);
    if (question.graph.size() > 3 * largest_graph) return;
    const ZeroDecider decider(question.graph, question.setting, small_budget);
    for (const NodeId slope : slopes)
        require(decider.decide(slope).status != ProofStatus::refuted, "a derivative of zero was refuted: " + text);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices({data, size});
    Question question;
    if (!ask(choices, question)) return 0;
    const std::string text = to_text(question.tree);
    const ZeroDecider decider(question.graph, question.setting, small_budget);
    const Decision decision = decider.decide(question.residual);
    if (decision.status == ProofStatus::refuted) examine_refuted(question, decision, text);
    if (decision.status != ProofStatus::proved) return 0;
    ProofBudget other = small_budget;
    other.seed = 1;
    examine_proved(question, ZeroDecider(question.graph, question.setting, other), text);
    accepted([&] { examine_slopes(question, text); });
    return 0;
}
