// SPDX-License-Identifier: GPL-2.0-or-later
/// The Pratt parser. Every operator has a binding power; `parse(least)` reads as far as operators bind at least that
/// much.
#include "expression/parse.hpp"

#include "expression/lex.hpp"
#include "expression/measure.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace lagen {

namespace {

/// Binding powers, loosest first. `sign` is what a prefix sign and an exponent read: 2^-x^2 = 2^(-(x^2)), 2^-1*x =
/// (2^-1)*x.
enum class Binding { comparison, sum, product, sign, power };

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

/// A parsed piece: its tree, its size, and the bytes it takes up with its parentheses (the tree's own range has none).
struct Operand {
    Tree tree;
    Measure measure;
    std::size_t begin = 0;
    std::size_t end = 0;
};

class Parser {
  public:
    Parser(const Excerpt& excerpt, const ParseLimits& limits)
        : excerpt_(excerpt), limits_(limits), lexer_(excerpt, limits), token_(lexer_.next())
    {
    }

    /// The whole text as one expression or comparison.
    Operand parse_all()
    {
        if (token_.kind == TokenKind::end) lexer_.fail("the expression is empty", token_.begin, token_.end, "");
        Operand result = parse(Binding::comparison);
        if (token_.kind == TokenKind::right_parenthesis)
            fail_here("')' closes no parenthesis", "every ')' needs a '(' before it");
        if (token_.kind != TokenKind::end) fail_here(fmt::format("unexpected {}", here()), "");
        return result;
    }

    void require_value(const Operand& operand) const
    {
        if (operand.tree->kind == TreeKind::compare)
            lexer_.fail("a comparison stands where a value is required", operand.begin, operand.end,
                        "comparisons stand in domains and as the first argument of if(c, a, b)");
    }

  private:
    Operand parse(Binding least);
    Operand parse_prefix();
    Operand parse_sign();
    Operand parse_parenthesis();
    Operand parse_name();
    std::vector<Operand> parse_arguments(const Token& function, const Token& open);
    Operand parse_sum(Operand left);
    Operand parse_product(Operand left);
    Operand parse_power(Operand base);
    Operand parse_comparison(Operand left);

    void check_call(const FunctionEntry& function, const std::vector<Operand>& arguments, std::size_t begin,
                    std::size_t end) const;
    Operand make(TreeNode node, std::vector<Operand> arguments, std::size_t begin, std::size_t end) const;
    Operand leaf(TreeNode node, const Token& token) const { return make(std::move(node), {}, token.begin, token.end); }

    Token take()
    {
        previous_ = std::exchange(token_, lexer_.next());
        return previous_;
    }
    [[nodiscard]] std::string here() const
    {
        return token_.kind == TokenKind::end ? "end of the expression" : quote(lexer_.text(token_));
    }
    [[noreturn]] void fail_here(const std::string& message, const std::string& hint) const
    {
        lexer_.fail(message, token_.begin, token_.end, hint);
    }
    void refuse_missing_operator() const;
    void close_parenthesis(const Token& open);

    /// Counts one level of nesting for as long as it lives.
    class Level {
      public:
        Level(Parser& parser, const Token& at) : parser_(parser)
        {
            if (++parser_.depth_ > parser_.limits_.depth)
                parser_.lexer_.fail(fmt::format("parentheses, calls, signs and exponents are nested more than {} deep",
                                                parser_.limits_.depth),
                                    at.begin, at.end, "split the expression with [definitions]");
        }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

      private:
        Parser& parser_;
    };

    const Excerpt& excerpt_;
    const ParseLimits& limits_;
    Lexer lexer_;
    Token token_;
    Token previous_;
    std::size_t depth_ = 0;
};

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
    case TokenKind::name: return parse_name();
    case TokenKind::minus:
    case TokenKind::plus: return parse_sign();
    case TokenKind::left_parenthesis: return parse_parenthesis();
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
        fail_here(fmt::format("{} stands where ')' is required", here()), "");
    take();
}

Operand Parser::parse_name()
{
    const Token name = take();
    const std::string text(lexer_.text(name));
    const FunctionEntry* function = find_function(text);
    TreeNode node;
    if (token_.kind != TokenKind::left_parenthesis) {
        if (function)
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
        if (!find_function(lexer_.text(function)))
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
    if (arguments.size() != function.arity)
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
    const auto chained = [this] {
        fail_here(fmt::format("{} follows a comparison", here()),
                  "a chain a < b < c is written as two comparisons, a < b and b < c");
    };
    if (left.tree->kind == TreeKind::compare) require_value(left);
    Operand right = parse(Binding::sum);
    require_value(right);
    if (binding_of(token_.kind) == Binding::comparison) chained();
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

/// A value that follows a value: "2 x", "2x", ")(".
void Parser::refuse_missing_operator() const
{
    const bool starts_value = token_.kind == TokenKind::number || token_.kind == TokenKind::name ||
                              token_.kind == TokenKind::left_parenthesis;
    if (starts_value)
        fail_here(fmt::format("missing operator between {} and {}", quote(lexer_.text(previous_)), here()),
                  "a product is written with '*', for instance 2*x");
}

} // namespace

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
                         "two values are compared with one of < <= > >= == !=");
    return std::move(result.tree);
}

} // namespace lagen
