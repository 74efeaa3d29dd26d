// SPDX-License-Identifier: GPL-2.0-or-later
/// Brackets and repetitions: [a, b], x[i], W[i,j], W[i,:], x[2..n], sum(i, from, to, body), product(..).
#include "expression/closed.hpp"
#include "expression/parser.hpp"

namespace lagen {

/// The entries after '[', at least one, and the ']'.
std::vector<Operand> Parser::parse_entries(const Token& open, Entries kind)
{
    const Level level(*this, open);
    if (token_.kind == TokenKind::right_bracket)
        lexer_.fail("the brackets are empty", open.begin, token_.end,
                    kind == Entries::indices ? "an index, counted from 1, stands in them"
                                             : "at least one entry stands in them");
    std::vector<Operand> entries;
    do {
        if (!entries.empty()) take();
        entries.push_back(kind == Entries::indices ? parse_range() : parse(Binding::comparison));
        require_value(entries.back());
    } while (token_.kind == TokenKind::comma);
    if (token_.kind == TokenKind::end)
        lexer_.fail("'[' is never closed", open.begin, open.end, "every '[' needs a ']' after it");
    if (token_.kind != TokenKind::right_bracket)
        fail_here(fmt::format("{} stands where ',' or ']' is required", here()),
                  token_.kind == TokenKind::colon && kind == Entries::indices ? "a range is written 1..2" : "");
    take();
    return entries;
}

/// An index, a range of them, 2..n, or ':', all of them.
Operand Parser::parse_range()
{
    TreeNode range;
    range.kind = TreeKind::apply;
    range.name = range_name;
    if (token_.kind == TokenKind::colon) return leaf(std::move(range), take());
    Operand first = parse(Binding::comparison);
    if (token_.kind != TokenKind::range) return first;
    require_value(first);
    take();
    Operand last = parse(Binding::sum);
    const std::size_t begin = first.begin, end = last.end;
    std::vector<Operand> ends;
    ends.push_back(std::move(first));
    ends.push_back(std::move(last));
    return make(std::move(range), std::move(ends), begin, end);
}

Operand Parser::parse_array()
{
    const Token open = take();
    std::vector<Operand> entries = parse_entries(open, Entries::of_array);
    TreeNode node;
    node.kind = TreeKind::array;
    return make(std::move(node), std::move(entries), open.begin, previous_.end);
}

/// `base`, or its entry where '[' follows.
Operand Parser::parse_index(Operand base)
{
    if (token_.kind != TokenKind::left_bracket) return base;
    const Token open = take();
    std::vector<Operand> indices = parse_entries(open, Entries::indices);
    const std::size_t begin = base.begin;
    const std::size_t end = previous_.end;
    const std::string array = text_of(base);
    if (indices.size() > 2)
        lexer_.fail(fmt::format("an entry has one or two indices, and {} are given", indices.size()), begin, end,
                    "a vector's entry is written x[1], a matrix's W[1,2], its second row W[2,:]");
    if (token_.kind == TokenKind::left_bracket)
        fail_here("an index follows an index",
                  fmt::format("the entry of a matrix is written {}[{},..]", array, text_of(indices[0])));
    TreeNode node;
    node.kind = TreeKind::index;
    std::vector<Operand> arguments;
    arguments.push_back(std::move(base));
    for (Operand& index : indices) arguments.push_back(std::move(index));
    return make(std::move(node), std::move(arguments), begin, end);
}

/// sum or product with the arguments that stood in its parentheses: the index's name, from, to, body.
Operand Parser::parse_repetition(const Token& word, std::vector<Operand> arguments)
{
    const std::string text(lexer_.text(word));
    const bool is_sum = text == "sum";
    const std::string hint =
        is_sum ? "sum(i, 1, n, x[i]) is x[1] + x[2] + ... + x[n]" : "product(i, 1, n, x[i]) is x[1]*x[2]*...*x[n]";
    const std::size_t end = previous_.end;
    if (arguments.size() != 4)
        lexer_.fail(fmt::format("{} takes 4 arguments, and {} {} given", text, arguments.size(),
                                arguments.size() == 1 ? "is" : "are"),
                    word.begin, end, hint);
    for (const Operand& argument : arguments) require_value(argument);
    if (arguments[0].tree->kind != TreeKind::name)
        lexer_.fail(fmt::format("the first argument of {} is not the name of an index", text), arguments[0].begin,
                    arguments[0].end, hint);
    TreeNode node;
    node.kind = is_sum ? TreeKind::sum_over : TreeKind::product_over;
    node.name = arguments[0].tree->name;
    arguments.erase(arguments.begin());
    return make(std::move(node), std::move(arguments), word.begin, end);
}

} // namespace lagen
