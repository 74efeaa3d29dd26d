// SPDX-License-Identifier: GPL-2.0-or-later
/// Tokens of the expression language, exact numbers, and the hints for characters that look like an operator.
#include "expression/lex.hpp"

#include "text/alphabet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lagen {

namespace {

bool is_ascii_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// A name as it is declared, or as equations print it: q̇₁ as well.
enum class Spelling { declared, printed };

/// The end of the name that starts at `begin`; `begin` itself where none does.
std::size_t end_of_name(std::string_view text, std::size_t begin, Spelling spelling)
{
    std::size_t end = begin;
    while (end < text.size()) {
        const CodePoint c = decode_utf8(text, end);
        const bool printed = spelling == Spelling::printed && (is_lowered_digit(c.value) || is_dot_above(c.value));
        const bool accepted = is_letter(c.value) || c.value == U'_' || (end > begin && (is_digit(c.value) || printed));
        if (c.length == 0 || !accepted) break;
        end += c.length;
    }
    return end;
}

struct LookAlike {
    std::string_view text;
    const char* hint;
};

/// Signs that people write instead of the language's own.
constexpr std::array look_alikes{
    LookAlike{"−", "the minus sign is written '-'"},
    LookAlike{"–", "the minus sign is written '-'"},
    LookAlike{"×", "a product is written '*'"},
    LookAlike{"·", "a product is written '*'"},
    LookAlike{"⋅", "a product is written '*'"},
    LookAlike{"÷", "a quotient is written '/'"},
    LookAlike{"²", "a square is written '^2'"},
    LookAlike{"³", "a cube is written '^3'"},
    LookAlike{"√", "a square root is written 'sqrt(x)'"},
    LookAlike{"≤", "'less or equal' is written '<='"},
    LookAlike{"≥", "'greater or equal' is written '>='"},
    LookAlike{"≠", "'not equal' is written '!='"},
    LookAlike{"=", "equality is written '=='"},
    LookAlike{"!", "'not equal' is written '!='"},
    LookAlike{"{", "terms are grouped with '(' and ')', and vectors are written [a, b]"},
    LookAlike{"}", "terms are grouped with '(' and ')', and vectors are written [a, b]"},
    LookAlike{"|", "an absolute value is written 'abs(x)'"},
    LookAlike{"'", "a derivative has no sign of its own: give it a name"},
    LookAlike{"′", "a derivative has no sign of its own: give it a name"},
    LookAlike{"\\", "commands of LaTeX are not read: names are letters, digits and '_'"},
};

const char* hint_for(std::string_view character)
{
    const char32_t c = decode_utf8(character, 0).value;
    if (is_accent(c)) return "of accents the dot of a rate alone is read: give it a name";
    for (const LookAlike& entry : look_alikes)
        if (entry.text == character) return entry.hint;
    return "an expression is made of numbers, names (letters, digits and '_'), + - * / ^, parentheses and brackets";
}

} // namespace

Lexer::Lexer(const Excerpt& excerpt, const ParseLimits& limits) : excerpt_(excerpt), limits_(limits)
{
    const std::size_t size = excerpt.text.size();
    if (size > limits.length)
        fail(fmt::format("the expression has {} bytes, and at most {} are accepted", size, limits.length), 0, 0,
             "split it with [definitions]");
    const std::size_t invalid = find_invalid_utf8(excerpt.text);
    if (invalid != std::string_view::npos)
        fail(fmt::format("the byte 0x{:02x} is not valid UTF-8", static_cast<unsigned char>(excerpt.text[invalid])),
             invalid, invalid + 1, "save the file in the encoding UTF-8");
}

void Lexer::fail(const std::string& message, std::size_t begin, std::size_t end, const std::string& hint) const
{
    throw ModelError(message, excerpt_.range(begin, end), hint);
}

std::string_view Lexer::text(const Token& token) const
{
    return std::string_view(excerpt_.text).substr(token.begin, token.end - token.begin);
}

Token Lexer::next()
{
    while (at(position_) == ' ' || at(position_) == '\t' || at(position_) == '\n' || at(position_) == '\r') ++position_;
    if (position_ >= excerpt_.text.size()) return {TokenKind::end, position_, position_, {}};
    if (is_ascii_digit(at(position_)) || (at(position_) == '.' && is_ascii_digit(at(position_ + 1))))
        return lex_number();
    const std::size_t end = end_of_name(excerpt_.text, position_, Spelling::printed);
    if (end > position_) {
        const Token token{TokenKind::name, position_, end, {}};
        position_ = end;
        return token;
    }
    return lex_operator();
}

/// digits [. digits] [e [sign] digits], or . digits [..]: the value is significand * 10^(exponent - decimals), exactly.
Token Lexer::lex_number()
{
    const std::size_t begin = position_;
    std::string digits;
    long decimals = 0;
    std::size_t end = begin;
    for (; is_ascii_digit(at(end)); ++end) digits += at(end);
    const bool range = at(end) == '.' && at(end + 1) == '.'; // 1..n
    if (at(end) == '.' && !range)
        for (++end; is_ascii_digit(at(end)); ++end, ++decimals) digits += at(end);
    if (digits.size() > limits_.digits)
        fail(fmt::format("a number has {} digits, and at most {} are accepted", digits.size(), limits_.digits), begin,
             end, "");

    long exponent = 0;
    const bool is_signed = at(end + 1) == '+' || at(end + 1) == '-';
    const std::size_t first = end + (is_signed ? 2 : 1);
    if ((at(end) == 'e' || at(end) == 'E') && is_ascii_digit(at(first))) {
        const bool negative = at(end + 1) == '-';
        end = first;
        for (; is_ascii_digit(at(end)); ++end)
            exponent = std::min(10 * exponent + (at(end) - '0'), limits_.decimal_exponent + 1);
        position_ = end;
        if (exponent > limits_.decimal_exponent)
            fail(fmt::format("the decimal exponent of {} is outside {} to {}",
                             quote(std::string_view(excerpt_.text).substr(begin, end - begin)),
                             -limits_.decimal_exponent, limits_.decimal_exponent),
                 begin, end, "");
        if (negative) exponent = -exponent;
    }
    if (at(end) == '.' && !range)
        fail(fmt::format("malformed number {}", quote(std::string_view(excerpt_.text).substr(begin, end + 1 - begin))),
             begin, end + 1, "a number has one decimal point");

    position_ = end;
    const long shift = exponent - decimals;
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(shift)));
    const mpz_class significand(digits, 10);
    Rational value = shift >= 0 ? Rational(significand * scale) : Rational(significand, scale);
    value.canonicalize();
    return {TokenKind::number, begin, end, std::move(value)};
}

Token Lexer::lex_operator()
{
    struct Operator {
        std::string_view text;
        TokenKind kind;
    };
    static constexpr std::array operators{
        // the longer ones first
        Operator{"<=", TokenKind::less_equal},
        Operator{">=", TokenKind::greater_equal},
        Operator{"==", TokenKind::equal},
        Operator{"!=", TokenKind::not_equal},
        Operator{"..", TokenKind::range},
        Operator{"<", TokenKind::less},
        Operator{">", TokenKind::greater},
        Operator{"+", TokenKind::plus},
        Operator{"-", TokenKind::minus},
        Operator{"*", TokenKind::star},
        Operator{"/", TokenKind::slash},
        Operator{"^", TokenKind::caret},
        Operator{"(", TokenKind::left_parenthesis},
        Operator{")", TokenKind::right_parenthesis},
        Operator{"[", TokenKind::left_bracket},
        Operator{"]", TokenKind::right_bracket},
        Operator{",", TokenKind::comma},
        Operator{":", TokenKind::colon},
    };
    const std::string_view rest = std::string_view(excerpt_.text).substr(position_);
    if (rest.starts_with("**")) fail("unexpected '**'", position_, position_ + 2, "a power is written '^'");
    for (const Operator& candidate : operators) {
        if (!rest.starts_with(candidate.text)) continue;
        const Token token{candidate.kind, position_, position_ + candidate.text.size(), {}};
        position_ = token.end;
        return token;
    }
    unexpected_character();
}

void Lexer::unexpected_character() const
{
    const CodePoint c = decode_utf8(excerpt_.text, position_);
    const std::string_view text = std::string_view(excerpt_.text).substr(position_, c.length);
    const std::string code =
        c.value > 0x7E || c.value < 0x20 ? fmt::format(" (U+{:04X})", static_cast<unsigned>(c.value)) : "";
    fail(fmt::format("unexpected character {}{}", quote(text), code), position_, position_ + c.length, hint_for(text));
}

bool is_identifier(std::string_view text)
{
    return !text.empty() && end_of_name(text, 0, Spelling::declared) == text.size();
}

} // namespace lagen
