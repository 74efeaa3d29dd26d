// SPDX-License-Identifier: GPL-2.0-or-later
/// The infix operators: what each reads to its right, and the node that it makes.
#include "expression/parser.hpp"

namespace lagen {

std::optional<Binding> binding_of(TokenKind kind)
{
    switch (kind) {
    case TokenKind::less:
    case TokenKind::less_equal:
    case TokenKind::greater:
    case TokenKind::greater_equal:
    case TokenKind::equal:
    case TokenKind::not_equal: return Binding::comparison;
    case TokenKind::plus:
    case TokenKind::minus: return Binding::sum;
    case TokenKind::star:
    case TokenKind::slash: return Binding::product;
    case TokenKind::caret: return Binding::power;
    default: return std::nullopt;
    }
}

namespace {

Comparison comparison_of(TokenKind kind)
{
    switch (kind) {
    case TokenKind::less: return Comparison::less;
    case TokenKind::less_equal: return Comparison::less_equal;
    case TokenKind::greater: return Comparison::greater;
    case TokenKind::greater_equal: return Comparison::greater_equal;
    case TokenKind::equal: return Comparison::equal;
    default: return Comparison::not_equal;
    }
}

} // namespace

/// left + right - right ...: one flat node, so that a sum of 1e5 terms is no deeper than one of two.
Operand Parser::parse_sum(Operand left)
{
    const std::size_t begin = left.begin;
    std::vector<Operand> terms;
    terms.push_back(std::move(left));
    while (token_.kind == TokenKind::plus || token_.kind == TokenKind::minus) {
        const Token sign = take();
        Operand term = parse(Binding::product);
        require_value(term);
        if (sign.kind == TokenKind::minus) {
            TreeNode node;
            node.kind = TreeKind::negate;
            const std::size_t end = term.end;
            std::vector<Operand> arguments;
            arguments.push_back(std::move(term));
            term = make(std::move(node), std::move(arguments), sign.begin, end);
        }
        terms.push_back(std::move(term));
    }
    const std::size_t end = terms.back().end;
    TreeNode node;
    node.kind = TreeKind::add;
    return make(std::move(node), std::move(terms), begin, end);
}

/// One run of '*' (flat) or one '/'; the caller's loop folds a*b/c*d from the left.
Operand Parser::parse_product(Operand left)
{
    const std::size_t begin = left.begin;
    const TokenKind kind = token_.kind;
    std::vector<Operand> factors;
    factors.push_back(std::move(left));
    do {
        take();
        factors.push_back(parse(Binding::sign));
        require_value(factors.back());
    } while (kind == TokenKind::star && token_.kind == TokenKind::star);
    const std::size_t end = factors.back().end;
    TreeNode node;
    node.kind = kind == TokenKind::star ? TreeKind::multiply : TreeKind::divide;
    return make(std::move(node), std::move(factors), begin, end);
}

Operand Parser::parse_power(Operand base)
{
    const Token caret = take();
    const Level level(*this, caret);
    Operand exponent = parse(Binding::sign);
    require_value(exponent);
    const std::size_t begin = base.begin;
    const std::size_t end = exponent.end;
    TreeNode node;
    node.kind = TreeKind::power;
    std::vector<Operand> arguments;
    arguments.push_back(std::move(base));
    arguments.push_back(std::move(exponent));
    return make(std::move(node), std::move(arguments), begin, end);
}

Operand Parser::parse_comparison(Operand left)
{
    const Token sign = take();
    require_value(left);
    Operand right = parse(Binding::sum);
    require_value(right);
    if (binding_of(token_.kind) == Binding::comparison)
        fail_here(fmt::format("{} follows a comparison", here()),
                  "a chain a < b < c is two comparisons that stand alone, as in domain = [\"a < b\", \"b < c\"]");
    const std::size_t begin = left.begin;
    const std::size_t end = right.end;
    TreeNode node;
    node.kind = TreeKind::compare;
    node.comparison = comparison_of(sign.kind);
    std::vector<Operand> arguments;
    arguments.push_back(std::move(left));
    arguments.push_back(std::move(right));
    return make(std::move(node), std::move(arguments), begin, end);
}

} // namespace lagen
