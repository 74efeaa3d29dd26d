// SPDX-License-Identifier: GPL-2.0-or-later
/// The parser's loop; what may stand where a value is required: numbers, names, calls, signs, parentheses, brackets and
/// repetitions; and the infix operators with what each reads to its right and the node that it makes.
#include "expression/parser.hpp"

#include "expression/closed.hpp"

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

// The infix operators: what each reads to its right, and the node that it makes.

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

// Brackets and repetitions: [a, b], x[i], W[i,j], W[i,:], x[2..n], sum(i, from, to, body), product(..).

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
