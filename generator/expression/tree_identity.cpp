// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/tree_identity.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

std::size_t TreeIdentity::operator()(const Tree& tree)
{
    return by_address_(tree, [this](const Tree& part, const std::vector<std::size_t>& arguments) {
        return number_of(*part, arguments);
    });
}

/// The number of a node whose arguments have theirs: looked up by kind, content and the arguments' numbers.
std::size_t TreeIdentity::number_of(const TreeNode& node, const std::vector<std::size_t>& arguments)
{
    std::string content = std::to_string(static_cast<int>(node.kind));
    content += ':';
    if (node.kind == TreeKind::number || node.kind == TreeKind::solve) content += node.number.get_str();
    if (node.kind == TreeKind::call) content += std::to_string(static_cast<int>(node.function));
    if (node.kind == TreeKind::compare) content += std::to_string(static_cast<int>(node.comparison));
    if (node.kind == TreeKind::name || node.kind == TreeKind::apply || node.kind == TreeKind::sum_over ||
        node.kind == TreeKind::product_over)
        content += node.name;
    for (const std::size_t argument : arguments) content += ',' + std::to_string(argument);
    return by_content_.emplace(std::move(content), by_content_.size()).first->second;
}

// Numbering up to sign.

SignedNumber SignedIdentity::operator()(const Tree& tree)
{
    if (const auto known = done_.find(tree.get()); known != done_.end()) return known->second;
    const SignedNumber result = number_of(tree);
    done_.emplace(tree.get(), result);
    alive_.push_back(tree);
    return result;
}

SignedNumber SignedIdentity::number_of(const Tree& tree)
{
    switch (tree->kind) {
    case TreeKind::number: {
        const Rational size = abs(tree->number);
        return {sgn(tree->number), number_for("n" + size.get_str())};
    }
    case TreeKind::negate: {
        const SignedNumber inner = (*this)(tree->arguments[0]);
        return {-inner.sign, inner.number};
    }
    case TreeKind::add: return sum(*tree);
    case TreeKind::multiply: return product(*tree);
    case TreeKind::divide: return quotient(*tree);
    case TreeKind::power: return power(*tree);
    default: return {1, number_for(fmt::format("t{}", identity_(tree)))};
    }
}

/// The terms by number, with how often each stands; the first one's count is made positive.
SignedNumber SignedIdentity::sum(const TreeNode& node)
{
    std::map<std::size_t, long> counts;
    for (const Tree& term : node.arguments) {
        const SignedNumber part = (*this)(term);
        if (part.sign != 0) counts[part.number] += part.sign;
    }
    std::erase_if(counts, [](const auto& entry) { return entry.second == 0; });
    if (counts.empty()) return {0, number_for("n0")};
    const int sign = counts.begin()->second > 0 ? 1 : -1;
    if (counts.size() == 1 && counts.begin()->second == sign) return {sign, counts.begin()->first};
    std::string content = "a";
    for (const auto& [number, count] : counts) content += fmt::format("{}*{},", number, sign * count);
    return {sign, number_for(std::move(content))};
}

SignedNumber SignedIdentity::product(const TreeNode& node)
{
    SignedNumber result;
    std::vector<std::size_t> factors;
    for (const Tree& factor : node.arguments) {
        const SignedNumber part = (*this)(factor);
        result.sign *= part.sign;
        factors.push_back(part.number);
    }
    std::sort(factors.begin(), factors.end());
    result.number = factors.size() == 1 ? factors[0] : number_for(fmt::format("m{}", fmt::join(factors, ",")));
    return result;
}

SignedNumber SignedIdentity::quotient(const TreeNode& node)
{
    const SignedNumber above = (*this)(node.arguments[0]);
    const SignedNumber below = (*this)(node.arguments[1]);
    const int sign = below.sign == 0 ? 1 : above.sign * below.sign;
    return {sign, number_for(fmt::format("d{},{}", above.number, below.number))};
}

SignedNumber SignedIdentity::power(const TreeNode& node)
{
    const SignedNumber base = (*this)(node.arguments[0]);
    const Tree& exponent = node.arguments[1];
    const Rational& n = exponent->number;
    const bool even = exponent->kind == TreeKind::number && n.get_den() == 1 && mpz_even_p(n.get_num_mpz_t());
    return {1, number_for(fmt::format("p{}{},{}", even ? 1 : base.sign, base.number, identity_(exponent)))};
}

} // namespace lagen
