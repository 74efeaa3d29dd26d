// SPDX-License-Identifier: GPL-2.0-or-later
/// The Pratt parser. Every operator has a binding power; `parse(least)` reads as far as operators bind at least that
/// much.
#pragma once

#include "expression/lex.hpp"
#include "expression/measure.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace lagen {

/// Binding powers, loosest first. `sign` is what a prefix sign and an exponent read: 2^-x^2 = 2^(-(x^2)), 2^-1*x =
/// (2^-1)*x.
enum class Binding { comparison, sum, product, sign, power };

/// The binding power of an infix operator; nothing for any other token.
[[nodiscard]] std::optional<Binding> binding_of(TokenKind kind);

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
        if (token_.kind == TokenKind::right_bracket)
            fail_here("']' closes no bracket", "every ']' needs a '[' before it");
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
    Operand parse_repetition(const Token& word, std::vector<Operand> arguments);
    Operand parse_array();
    Operand parse_index(Operand base);
    enum class Entries { of_array, indices };
    std::vector<Operand> parse_entries(const Token& open, Entries entries);
    Operand parse_range();
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
    [[nodiscard]] std::string text_of(const Operand& operand) const
    {
        return excerpt_.text.substr(operand.begin, operand.end - operand.begin);
    }

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

} // namespace lagen
