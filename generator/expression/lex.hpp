// SPDX-License-Identifier: GPL-2.0-or-later
/// Text to tokens, one at a time, with exact numbers.
#pragma once

#include "expression/parse.hpp"

namespace lagen {

enum class TokenKind {
    number,
    name,
    plus,
    minus,
    star,
    slash,
    caret,
    left_parenthesis,
    right_parenthesis,
    left_bracket,
    right_bracket,
    comma,
    colon,
    range, ///< ..
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    end,
};

struct Token {
    TokenKind kind = TokenKind::end;
    std::size_t begin = 0; ///< bytes of the excerpt
    std::size_t end = 0;
    Rational value; ///< of a number
};

/// Reads the tokens of an excerpt from left to right. The excerpt must outlive the lexer.
class Lexer {
  public:
    /// Throws ModelError: text too long, not UTF-8.
    Lexer(const Excerpt& excerpt, const ParseLimits& limits);

    /// The next token; `end` again and again after the last. Throws ModelError: unexpected character, a number with
    /// too many digits or too large an exponent.
    [[nodiscard]] Token next();

    [[nodiscard]] std::string_view text(const Token& token) const;
    [[noreturn]] void fail(const std::string& message, std::size_t begin, std::size_t end,
                           const std::string& hint) const;

  private:
    [[nodiscard]] Token lex_number();
    [[nodiscard]] Token lex_operator();
    [[noreturn]] void unexpected_character() const;
    [[nodiscard]] char at(std::size_t byte) const { return byte < excerpt_.text.size() ? excerpt_.text[byte] : '\0'; }

    const Excerpt& excerpt_;
    const ParseLimits& limits_;
    std::size_t position_ = 0;
};

} // namespace lagen
