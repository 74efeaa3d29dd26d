// SPDX-License-Identifier: GPL-2.0-or-later
/// The walk over a tree, and functions that are linear as they are written. Closed trees are at most 2000 levels deep,
/// so plain recursion is safe.
#include "expression/derivative.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace lagen {

namespace {

constexpr std::array derivative_rows{
    DerivativeEntry{Derivative::diff, "diff", 2, "diff(f, q) is the derivative of f by the symbol q"},
    DerivativeEntry{Derivative::grad, "grad", 2, "grad(f, q) is the vector of derivatives of f by the symbols of q"},
    DerivativeEntry{Derivative::jacobian, "jacobian", 2,
                    "jacobian(f, q) has a row for each entry of f and a column for each symbol of q"},
    DerivativeEntry{Derivative::rate, "Dt", 1, "Dt(X) is the rate of X along the motion"},
};

/// Degrees in some symbols of trees that are sums of terms of one degree: 0, 1, or `other`; 0 itself has any.
class HomogeneousDegrees {
  public:
    enum Degree { any = -1, constant = 0, linear = 1, other = 2 };

    explicit HomogeneousDegrees(const std::set<std::string>& symbols) : symbols_(symbols) {}

    Degree of(const Tree& tree)
    {
        return Fold<Degree>()(
            tree, [this](const Tree& part, const std::vector<Degree>& parts) { return of_node(*part, parts); });
    }

  private:
    Degree of_node(const TreeNode& node, const std::vector<Degree>& parts) const
    {
        switch (node.kind) {
        case TreeKind::number: return node.number == 0 ? any : constant;
        case TreeKind::name: return symbols_.contains(node.name) ? linear : constant;
        case TreeKind::negate: return parts[0];
        case TreeKind::divide: return parts[1] == constant ? parts[0] : other;
        case TreeKind::multiply: {
            int degree = 0;
            for (const Degree part : parts) {
                if (part == any) return any;
                degree += part;
            }
            return degree > linear ? other : static_cast<Degree>(degree);
        }
        case TreeKind::add: {
            Degree degree = any;
            for (const Degree part : parts) {
                if (part == any) continue;
                if (degree != any && degree != part) return other;
                degree = part;
            }
            return degree;
        }
        default:
            return std::ranges::all_of(parts, [](Degree part) { return part == any || part == constant; }) ? constant
                                                                                                           : other;
        }
    }

    const std::set<std::string>& symbols_;
};

} // namespace

std::span<const DerivativeEntry> derivative_table()
{
    return derivative_rows;
}

const DerivativeEntry* find_derivative(std::string_view name)
{
    const auto found = std::ranges::find(derivative_rows, name, &DerivativeEntry::name);
    return found == derivative_rows.end() ? nullptr : &*found;
}

std::string rate_name(const std::string& symbol)
{
    return symbol + '\'';
}

bool is_rate_name(std::string_view name)
{
    return name.ends_with('\'');
}

ClosedTree Gradients::measured(const Tree& tree)
{
    return {tree, measures_(tree, [this](const Tree& part, const std::vector<Measure>& sizes) {
                maker_.count();
                return measure(*part, sizes, closing_limits());
            })};
}

const Gradients::Partials& Gradients::of(const Tree& tree)
{
    if (const auto known = partials_.find(tree.get()); known != partials_.end()) return known->second;
    for (const Tree& argument : tree->arguments) (void)of(argument);
    return partials_.emplace(tree.get(), partials_of_node(*tree, measured(tree))).first->second;
}

Gradients::Partials Gradients::partials_of_node(const TreeNode& node, const ClosedTree& value)
{
    Partials result;
    if (node.kind == TreeKind::name && is_wanted_(node)) {
        const auto place = std::ranges::find(symbols_, node.name);
        result.emplace(static_cast<std::size_t>(place - symbols_.begin()), maker_.number(1));
        if (place == symbols_.end()) symbols_.push_back(node.name);
    }
    if (node.kind == TreeKind::compare) return result; // what happens at a jump is not looked at
    std::map<std::size_t, std::vector<ClosedTree>> terms;
    for (const Tree& argument : node.arguments)
        for (const auto& [symbol, partial] : of(argument)) terms[symbol].push_back(partial);
    if (node.kind == TreeKind::add) {
        for (auto& [symbol, parts] : terms) result.emplace(symbol, maker_.add(std::move(parts)));
        return result;
    }
    if (terms.empty()) return result;
    std::vector<ClosedTree> arguments;
    for (const Tree& argument : node.arguments) arguments.push_back(measured(argument));
    for (const auto& term : terms) {
        const std::size_t symbol = term.first;
        std::vector<const ClosedTree*> derivatives;
        for (const Tree& argument : node.arguments) {
            const Partials& partials = of(argument);
            const auto found = partials.find(symbol);
            derivatives.push_back(found == partials.end() ? nullptr : &found->second);
        }
        ClosedTree partial = chain_rule(maker_, value, arguments, derivatives);
        if (!is_number(partial, 0)) result.emplace(symbol, std::move(partial));
    }
    return result;
}

std::optional<std::vector<Tree>> linear_coefficients(const Tree& tree, const std::vector<std::string>& symbols)
{
    const std::set<std::string> wanted(symbols.begin(), symbols.end());
    const HomogeneousDegrees::Degree degree = HomogeneousDegrees(wanted).of(tree);
    if (degree != HomogeneousDegrees::linear && degree != HomogeneousDegrees::any) return std::nullopt;
    Budget budget{0, "the expression is longer than {} operations when its sums and arrays are written out", ""};
    TreeIdentity identity;
    SignedIdentity signed_identity(identity);
    const Maker maker(budget, signed_identity, tree->where);
    Gradients gradients(maker, [&](const TreeNode& name) { return wanted.contains(name.name); });
    const Gradients::Partials& partials = gradients.of(tree);
    std::vector<Tree> out(symbols.size());
    for (std::size_t k = 0; k < symbols.size(); ++k) {
        const auto place = std::ranges::find(gradients.symbols(), symbols[k]);
        const auto partial = partials.find(static_cast<std::size_t>(place - gradients.symbols().begin()));
        if (partial != partials.end()) out[k] = partial->second.tree;
    }
    return out;
}

} // namespace lagen
