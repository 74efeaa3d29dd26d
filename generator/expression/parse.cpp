// SPDX-License-Identifier: GPL-2.0-or-later
/// The parser's loop, and what may stand where a value is required: numbers, names, calls, signs, parentheses.
#include "expression/parser.hpp"

namespace lagen {

Operand Parser::make(TreeNode node, std::vector<Operand> arguments, std::size_t begin, std::size_t end) const
{
    auto tree = std::make_shared<TreeNode>(std::move(node));
    tree->where = excerpt_.range(begin, end);
    std::vector<Measure> measures;
    measures.reserve(arguments.size());
    tree->arguments.reserve(arguments.size());
    for (Operand& argument : arguments) {
        tree->arguments.push_back(std::move(argument.tree));
        measures.push_back(std::move(argument.measure));
    }
    Measure size = measure(*tree, measures, limits_);
    return {std::move(tree), std::move(size), begin, end};
}

Operand Parser::parse(Binding least)
{
    Operand left = parse_prefix();
    for (;;) {
        refuse_missing_operator();
        const std::optional<Binding> binding = binding_of(token_.kind);
        if (!binding || *binding < least) return left;
        if (*binding != Binding::comparison) require_value(left);
        switch (*binding) {
        case Binding::comparison: left = parse_comparison(std::move(left)); break;
        case Binding::sum: left = parse_sum(std::move(left)); break;
        case Binding::product: left = parse_product(std::move(left)); break;
        case Binding::sign:
        case Binding::power: left = parse_power(std::move(left)); break;
        }
    }
}

Operand Parser::parse_prefix()
{
    switch (token_.kind) {
    case TokenKind::number: {
        const Token number = take();
        TreeNode node;
        node.number = number.value;
        return leaf(std::move(node), number);
    }
    case TokenKind::name: return parse_index(parse_name());
    case TokenKind::minus:
    case TokenKind::plus: return parse_sign();
    case TokenKind::left_parenthesis: return parse_index(parse_parenthesis());
    case TokenKind::left_bracket: return parse_index(parse_array());
    case TokenKind::end:
        lexer_.fail(fmt::format("the expression ends after {} where a number, a name or '(' is required",
                                quote(lexer_.text(previous_))),
                    token_.begin, token_.end, "");
    default: fail_here(fmt::format("{} stands where a number, a name or '(' is required", here()), "");
    }
}

Operand Parser::parse_sign()
{
    const Token sign = take();
    const Level level(*this, sign);
    Operand operand = parse(Binding::sign);
    require_value(operand);
    const std::size_t end = operand.end;
    if (sign.kind == TokenKind::plus) {
        operand.begin = sign.begin;
        return operand;
    }
    TreeNode node;
    node.kind = TreeKind::negate;
    std::vector<Operand> arguments;
    arguments.push_back(std::move(operand));
    return make(std::move(node), std::move(arguments), sign.begin, end);
}

Operand Parser::parse_parenthesis()
{
    const Token open = take();
    const Level level(*this, open);
    if (token_.kind == TokenKind::right_parenthesis)
        lexer_.fail("the parentheses are empty", open.begin, token_.end, "");
    Operand inner = parse(Binding::comparison);
    close_parenthesis(open);
    inner.begin = open.begin;
    inner.end = previous_.end;
    return inner;
}

void Parser::close_parenthesis(const Token& open)
{
    if (token_.kind == TokenKind::end)
        lexer_.fail("'(' is never closed", open.begin, open.end, "every '(' needs a ')' after it");
    if (token_.kind != TokenKind::right_parenthesis)
        fail_here(fmt::format("{} stands where ')' is required", here()),
                  token_.kind == TokenKind::comma ? "a scalar product is written dot(a, b), a vector [a, b]" : "");
    take();
}

Operand Parser::parse_name()
{
    const Token name = take();
    const std::string text(lexer_.text(name));
    const FunctionEntry* function = find_function(text);
    TreeNode node;
    if (token_.kind != TokenKind::left_parenthesis) {
        if (function && !function->array) // norm, det, ... are free for a model's own quantities
            lexer_.fail(fmt::format("the function '{}' stands without arguments", text), name.begin, name.end,
                        fmt::format("arguments stand in parentheses: {}(x{})", text,
                                    function->arity == 1   ? ""
                                    : function->arity == 2 ? ", y"
                                                           : " > 0, y, z"));
        node.kind = text == "pi" ? TreeKind::pi : TreeKind::name;
        node.name = text;
        return leaf(std::move(node), name);
    }
    const Token open = take();
    const Level level(*this, open);
    std::vector<Operand> arguments = parse_arguments(name, open);
    if (text == "sum" || text == "product") return parse_repetition(name, std::move(arguments));
    if (function) {
        check_call(*function, arguments, name.begin, previous_.end);
        node.kind = TreeKind::call;
        node.function = function->function;
    } else {
        for (const Operand& argument : arguments) require_value(argument);
        node.kind = TreeKind::apply;
        node.name = text;
    }
    return make(std::move(node), std::move(arguments), name.begin, previous_.end);
}

std::vector<Operand> Parser::parse_arguments(const Token& function, const Token& open)
{
    std::vector<Operand> arguments;
    if (token_.kind == TokenKind::right_parenthesis) {
        take();
        if (!is_function_name(lexer_.text(function)))
            lexer_.fail(fmt::format("{} is called without arguments", quote(lexer_.text(function))), function.begin,
                        previous_.end, "a function has one argument at least");
        return arguments;
    }
    arguments.push_back(parse(Binding::comparison));
    while (token_.kind == TokenKind::comma) {
        take();
        arguments.push_back(parse(Binding::comparison));
    }
    close_parenthesis(open);
    return arguments;
}

void Parser::check_call(const FunctionEntry& function, const std::vector<Operand>& arguments, std::size_t begin,
                        std::size_t end) const
{
    const bool any_number = function.function == Function::diag && !arguments.empty(); // diag(a, b, c)
    if (arguments.size() != function.arity && !any_number)
        lexer_.fail(fmt::format("{} takes {} argument{}, and {} {} given", function.name, function.arity,
                                function.arity == 1 ? "" : "s", arguments.size(), arguments.size() == 1 ? "is" : "are"),
                    begin, end, function.function == Function::select ? "if(c, a, b) is a where c holds, else b" : "");
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const bool condition = function.function == Function::select && k == 0;
        if (!condition) require_value(arguments[k]);
        if (condition && arguments[k].tree->kind != TreeKind::compare)
            lexer_.fail("the first argument of if is not a comparison", arguments[k].begin, arguments[k].end,
                        "a condition compares two values, for instance x > 0");
    }
}

/// A value that follows a value: "2 x", "2x", ")(".
void Parser::refuse_missing_operator() const
{
    const bool starts_value = token_.kind == TokenKind::number || token_.kind == TokenKind::name ||
                              token_.kind == TokenKind::left_parenthesis || token_.kind == TokenKind::left_bracket;
    if (!starts_value) return;
    const std::string_view word = lexer_.text(token_);
    const bool logical = word == "and" || word == "or" || word == "not";
    fail_here(fmt::format("missing operator between {} and {}", quote(lexer_.text(previous_)), here()),
              logical
                  ? fmt::format(
                        "there is no {}: each condition is an entry of its own, as in domain = [\"a < b\", \"b < c\"]",
                        quote(word))
                  : "a product is written with '*', for instance 2*x");
}

Tree parse_expression(const Excerpt& text, const ParseLimits& limits)
{
    Parser parser(text, limits);
    Operand result = parser.parse_all();
    parser.require_value(result);
    return std::move(result.tree);
}

Tree parse_comparison(const Excerpt& text, const ParseLimits& limits)
{
    Parser parser(text, limits);
    Operand result = parser.parse_all();
    if (result.tree->kind != TreeKind::compare)
        throw ModelError("this is not a comparison", text.range(result.begin, result.end),
                         "a domain is made of strict inequalities: a < b, a > b or a != b");
    return std::move(result.tree);
}

} // namespace lagen
