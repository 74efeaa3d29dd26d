// SPDX-License-Identifier: GPL-2.0-or-later
/// Slices of a model, on which one variable is zero and the rest of the setting stays, and factors of determinants.
#include "verify/singular_set.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"
#include "graph/core/lower.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <array>

namespace lagen {
namespace {

constexpr std::size_t point_limit = 8;
constexpr std::size_t most_in_corner = 8; ///< variables of which each choice is looked at
constexpr std::size_t longest_factor = 80;
/// One slice a variable is looked at: none may take long.
constexpr ProofBudget slice_budget{.products = 200'000};

using SliceValues = std::vector<std::pair<NodeId, SliceValue>>; ///< inputs with what they are there

/// The point with what the slice adds, in the order of the setting, as far as the determinants are about it.
NamedPoint point_of_slice(const Graph& graph, const ProofSetting& setting, const SliceValues& slice, NamedPoint point,
                          const std::vector<NodeId>& determinants)
{
    std::set<std::string> names = input_names(graph, determinants);
    for (const auto& [input, value] : slice) {
        point.emplace_back(graph.input_name(input), value.shown);
        names.insert(graph.input_name(input));
    }
    NamedPoint ordered;
    for (const std::vector<NodeId>* inputs : {&setting.variables, &setting.parameters})
        for (const NodeId input : *inputs)
            if (const auto at = std::ranges::find(point, graph.input_name(input), &NamedPoint::value_type::first);
                at != point.end())
                ordered.push_back(*at);
    return concerned(graph, setting, std::move(names), ordered);
}

/// A point of the slice where a determinant vanishes; it does on the whole slice. None where something is not defined
/// on the slice, or the constraints are not triangular there.
std::optional<NamedPoint> singular_point(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                         const SliceValues& slice, const std::vector<NodeId>& determinants)
{
    Replacements values;
    for (const auto& [input, value] : slice) values.emplace_back(input, value.node);
    const auto there = at_values(graph, determinants, setting, smaller(budget, slice_budget), values);
    std::optional<NamedPoint> point = there ? there->decider->sample_point() : std::nullopt;
    if (!point) return {};
    for (const NodeId determinant : there->nodes)
        if (there->decider->status(determinant) == ProofStatus::proved)
            return point_of_slice(graph, setting, slice, *std::move(point), determinants);
    return {};
}

} // namespace

std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                        const std::vector<NodeId>& determinants)
{
    return singular_points(graph, setting, budget, determinants, {graph.constant(0), Rational(0)});
}

SliceValue quarter_turn(Graph& graph)
{
    const char* digits = "1.5707963267948966192313";
    const Rational lower("15707963267948966/10000000000000000"), upper("15707963267948967/10000000000000000");
    return {graph.divide(graph.pi(), graph.constant(2)), PointValue(digits, lower, upper)};
}

std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                        const std::vector<NodeId>& determinants, const SliceValue& value)
{
    std::vector<NamedPoint> points;
    if (setting.is_wider) return points;
    for (std::size_t k = 0; k < setting.variables.size() && points.size() < point_limit; ++k) {
        const SliceValues slice{{setting.variables[k], value}};
        if (auto point = singular_point(graph, setting, budget, slice, determinants))
            points.push_back(*std::move(point));
    }
    return points;
}

std::vector<NamedPoint> singular_parameters(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                            const std::vector<NodeId>& determinants)
{
    std::vector<NamedPoint> points;
    if (setting.is_wider) return points;
    for (std::size_t k = 0; k < setting.parameters.size() && points.size() < point_limit; ++k) {
        const NodeId parameter = setting.parameters[k];
        if (!depends_on_any(graph, determinants, std::array{parameter})) continue;
        const SliceValues slice{{parameter, {graph.constant(0), Rational(0)}}};
        if (auto point = singular_point(graph, setting, budget, slice, determinants))
            points.push_back(*std::move(point));
    }
    return points;
}

std::optional<NamedPoint> singular_corner(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                          const std::vector<NodeId>& determinants)
{
    if (setting.is_wider) return std::nullopt;
    Places used; // places of variables
    for (std::size_t k = 0; k < setting.variables.size(); ++k)
        if (depends_on_any(graph, determinants, std::array{setting.variables[k]})) used.push_back(k);
    for (std::size_t count = used.size() <= most_in_corner ? 2 : used.size(); count <= used.size(); ++count) {
        Places chosen = first_places(count);
        do {
            SliceValues zero;
            for (const std::size_t place : chosen)
                zero.push_back({setting.variables[used[place]], {graph.constant(0), Rational(0)}});
            if (auto point = singular_point(graph, setting, budget, zero, determinants)) return point;
        } while (next_places(chosen, used.size()));
    }
    return std::nullopt;
}

std::vector<std::string> singular_factors(Graph& graph, const ProofSetting& setting, const ZeroDecider& valued,
                                          const std::vector<std::pair<NodeId, NodeId>>& defaults,
                                          const std::vector<NodeId>& determinants)
{
    const Order order = writing_order(graph, setting);
    const ZeroDecider decider(graph, setting, valued.budget());
    std::vector<std::string> texts;
    for (const NodeId determinant : determinants) {
        const auto factors = factors_of(graph, determinant, order, decider);
        if (!factors) return {};
        for (const Tree& factor : *factors) {
            const std::vector<NodeId> node = {Lowering(graph)(factor)};
            const auto there = substitute_where_defined(graph, node, defaults);
            if (there && valued.proves_nonzero((*there)[0])) continue;
            const std::string text = to_text(factor);
            if (text.size() > longest_factor) return {};
            if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
        }
    }
    return texts;
}

namespace {

/// What is longer takes its time, and has no short factors.
constexpr std::size_t longest_product = 800;

/// By GiNaC; null where it does not have a function of the tree, meets a pole, or the fraction is long.
Tree reduced_tree(const Tree& tree, const Order& order)
{
    try {
        return with_ginac("no reduced fraction", [&]() -> Tree {
            SymbolTable symbols;
            const GiNaC::ex given = to_ginac(tree, symbols);
            return has_short_fraction(given) ? shortest_form(given.normal(), symbols, order) : nullptr;
        });
    } catch (const MathematicsError&) {
        return nullptr;
    }
}

bool is_negative(const TreeNode& exponent)
{
    const bool minus = exponent.kind == TreeKind::negate && exponent.arguments[0]->kind == TreeKind::number;
    return minus || (exponent.kind == TreeKind::number && exponent.number < 0);
}

/// The factors of the numerator, without their exponents; numbers are none.
void append_factors(std::vector<Tree>& factors, const Tree& tree)
{
    switch (tree->kind) {
    case TreeKind::number:
    case TreeKind::pi: return;
    case TreeKind::negate:
    case TreeKind::divide: return append_factors(factors, tree->arguments[0]);
    case TreeKind::multiply:
        for (const Tree& factor : tree->arguments) append_factors(factors, factor);
        return;
    case TreeKind::power: {
        const Tree& exponent = tree->arguments[1];
        if (is_negative(*exponent)) return; // of a denominator
        if (exponent->kind == TreeKind::number) return append_factors(factors, tree->arguments[0]);
        break;
    }
    default: break;
    }
    factors.push_back(tree);
}

} // namespace

Order writing_order(const Graph& graph, const ProofSetting& setting)
{
    Order order;
    for (const NodeId input : setting.parameters) order.parameters.push_back(graph.input_name(input));
    for (const NodeId input : setting.variables) order.variables.push_back(graph.input_name(input));
    return order;
}

std::optional<Tree> reduced_fraction(Graph& graph, NodeId node, const Tree& tree, const Order& order,
                                     const ZeroDecider& decider)
{
    const Tree reduced = reduced_tree(tree, order);
    if (reduced == nullptr) return std::nullopt;
    const NodeId difference = graph.subtract(Lowering(graph)(reduced), node);
    if (decider.status(difference) != ProofStatus::proved) return std::nullopt;
    return reduced;
}

std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order, const ZeroDecider& decider)
{
    if (to_text(graph, node, longest_product).size() > longest_product) return std::nullopt;
    std::vector<Tree> factors;
    const Tree tree = to_tree(graph, node);
    append_factors(factors, reduced_fraction(graph, node, tree, order, decider).value_or(tree));
    return factors;
}

} // namespace lagen
