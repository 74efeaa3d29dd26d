// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/shared_parts.hpp"

#include "equations/kept_symbols.hpp"
#include "graph/core/lower.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t short_part = 4; ///< nodes of a tree that is not worth a name

/// A product as one fraction: signs and numbers in front, equal factors as powers, what is divided by below.
struct Fraction {
    Rational coefficient = 1;
    std::vector<std::pair<Tree, long>> factors = {}; ///< with their exponents

    void take(const Tree& tree, long exponent)
    {
        switch (tree->kind) {
        case TreeKind::number: coefficient *= exponent < 0 ? Rational(1 / tree->number) : tree->number; return;
        case TreeKind::negate:
            coefficient = -coefficient;
            take(tree->arguments[0], exponent);
            return;
        case TreeKind::multiply:
            for (const Tree& factor : tree->arguments) take(factor, exponent);
            return;
        case TreeKind::divide:
            take(tree->arguments[0], exponent);
            take(tree->arguments[1], -exponent);
            return;
        default: break;
        }
        const bool whole = tree->kind == TreeKind::power && tree->arguments[1]->kind == TreeKind::number &&
                           tree->arguments[1]->number.get_num().fits_sint_p() &&
                           tree->arguments[1]->number.get_den() == 1;
        const Tree& base = whole ? tree->arguments[0] : tree;
        if (whole) exponent *= tree->arguments[1]->number.get_num().get_si();
        const auto known = std::ranges::find_if(factors, [&](const auto& each) { return same_tree(each.first, base); });
        if (known == factors.end())
            factors.emplace_back(base, exponent);
        else
            known->second += exponent;
    }

    [[nodiscard]] Tree product(const Rational& in_front, long sign) const
    {
        std::vector<Tree> trees;
        for (const auto& [base, exponent] : factors)
            if (const long power_here = sign * exponent; power_here > 0)
                trees.push_back(power_here == 1 ? base : power(base, number(Rational(power_here))));
        if (in_front != 1 || trees.empty()) trees.insert(trees.begin(), number(in_front));
        return trees.size() == 1 ? trees[0] : multiply(std::move(trees));
    }

    [[nodiscard]] Tree tree() const
    {
        Tree result = product(abs(coefficient.get_num()), 1);
        const Tree divisor = product(coefficient.get_den(), -1);
        if (divisor->kind != TreeKind::number || divisor->number != 1) result = divide(std::move(result), divisor);
        return coefficient < 0 ? negate(std::move(result)) : result;
    }
};

void take_terms(const Tree& tree, bool negative, std::vector<Tree>& terms)
{
    if (tree->kind == TreeKind::negate)
        take_terms(tree->arguments[0], !negative, terms);
    else if (tree->kind == TreeKind::add)
        for (const Tree& term : tree->arguments) take_terms(term, negative, terms);
    else
        terms.push_back(negative ? negate(tree) : tree);
}

/// One sum for sums of sums, one fraction for products of products.
Tree flat(const Tree& tree)
{
    if (tree->kind == TreeKind::add) {
        std::vector<Tree> terms;
        take_terms(tree, false, terms);
        return add(std::move(terms));
    }
    if (tree->kind != TreeKind::multiply && tree->kind != TreeKind::divide && tree->kind != TreeKind::power)
        return tree;
    Fraction fraction;
    fraction.take(tree, 1);
    return fraction.tree();
}

/// s, with as many underscores as the names ask for.
std::string free_stem(std::size_t most, const std::function<bool(const std::string&)>& is_taken)
{
    std::string stem = "s";
    for (std::size_t k = 1; k <= most;)
        if (is_taken(stem + std::to_string(k++))) {
            stem += "_";
            k = 1;
        }
    return stem;
}

} // namespace

PartCount count_parts(const Graph& graph, std::span<const NodeId> roots)
{
    std::vector<double> written(graph.size(), 1);
    PartCount count;
    for (const NodeId node : reachable(graph, roots)) {
        ++count.nodes;
        for (const NodeId operand : graph.operands(node)) written[node] += written[operand];
    }
    for (const NodeId root : roots) count.written += written[root];
    return count;
}

SharedParts shared_parts(const Graph& graph, std::span<const NodeId> roots, const std::map<NodeId, std::string>& known,
                         const std::function<bool(const std::string&)>& is_taken)
{
    std::vector<std::size_t> uses(graph.size(), 0);
    const std::vector<NodeId> nodes = reachable(graph, roots);
    for (const NodeId node : nodes)
        for (const NodeId operand : graph.operands(node)) ++uses[operand];
    for (const NodeId root : roots) ++uses[root];
    const std::string stem = free_stem(nodes.size(), is_taken);
    SharedParts parts;
    std::size_t count = 0;
    parts.values = to_trees(graph, roots, [&](NodeId node, const Tree& operation) {
        const auto own = known.find(node);
        const Tree tree = flat(operation);
        if (written_nodes(tree) <= short_part || (own == known.end() && uses[node] < 2)) return tree;
        const std::string symbol = own != known.end() ? own->second : stem + std::to_string(++count);
        parts.where.push_back({symbol, tree});
        return name(symbol);
    });
    return parts;
}

} // namespace lagen
