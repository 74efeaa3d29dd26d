// SPDX-License-Identifier: GPL-2.0-or-later
/// What bad text gets: one sentence, the place, a hint.
#include "parsing.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

std::string repeated(const std::string& part, int times)
{
    std::string text;
    for (int k = 0; k < times; ++k) text += part;
    return text;
}

} // namespace

TEST_CASE("there is no implicit product")
{
    CHECK(error_of("2 x") == "e:1:3: error: missing operator between '2' and 'x'\n"
                             "  2 x\n"
                             "    ^\n"
                             "hint: a product is written with '*', for instance 2*x");
    CHECK(sentence_of("2x") == "missing operator between '2' and 'x'");
    CHECK(sentence_of("(a)(b)") == "missing operator between ')' and '('");
    CHECK(sentence_of("2(b)") == "missing operator between '2' and '('");
    CHECK(sentence_of("x 2") == "missing operator between 'x' and '2'");
    CHECK(sentence_of("sin(x)cos(x)") == "missing operator between ')' and 'cos'");
    CHECK(sentence_of("0x10") == "missing operator between '0' and 'x10'");
    CHECK(sentence_of("2e") == "missing operator between '2' and 'e'");
}

TEST_CASE("parentheses must balance")
{
    CHECK(error_of("2*(a + (b)") == "e:1:3: error: '(' is never closed\n"
                                    "  2*(a + (b)\n"
                                    "    ^\n"
                                    "hint: every '(' needs a ')' after it");
    CHECK(error_of("a + b)*c") == "e:1:6: error: ')' closes no parenthesis\n"
                                  "  a + b)*c\n"
                                  "       ^\n"
                                  "hint: every ')' needs a '(' before it");
    CHECK(error_of("sin(x") == "e:1:4: error: '(' is never closed\n"
                               "  sin(x\n"
                               "     ^\n"
                               "hint: every '(' needs a ')' after it");
    CHECK(sentence_of("()") == "the parentheses are empty");
    CHECK(sentence_of("(a, b)") == "',' stands where ')' is required");
    CHECK(sentence_of("a, b") == "unexpected ','");
}

TEST_CASE("something must stand where a value is required")
{
    CHECK(error_of("") == "e:1:1: error: the expression is empty\n  \n  ^");
    CHECK(sentence_of("  \n ") == "the expression is empty");
    CHECK(error_of("x +") == "e:1:4: error: the expression ends after '+' where a number, a name or '(' is required\n"
                             "  x +\n"
                             "     ^");
    CHECK(error_of("x * / y") == "e:1:5: error: '/' stands where a number, a name or '(' is required\n"
                                 "  x * / y\n"
                                 "      ^");
    CHECK(sentence_of("atan2(x,)") == "')' stands where a number, a name or '(' is required");
    CHECK(sentence_of("a = b") == "unexpected character '='");
}

TEST_CASE("a built-in function has its number of arguments")
{
    CHECK(error_of("1 + sin(x, y)") == "e:1:5: error: sin takes 1 argument, and 2 are given\n"
                                       "  1 + sin(x, y)\n"
                                       "      ^~~~~~~~~");
    CHECK(sentence_of("sin()") == "sin takes 1 argument, and 0 are given");
    CHECK(sentence_of("atan2(x)") == "atan2 takes 2 arguments, and 1 is given");
    CHECK(error_of("if(x > 0, 1)") == "e:1:1: error: if takes 3 arguments, and 2 are given\n"
                                      "  if(x > 0, 1)\n"
                                      "  ^~~~~~~~~~~~\n"
                                      "hint: if(c, a, b) is a where c holds, else b");
    CHECK(error_of("sin x") == "e:1:1: error: the function 'sin' stands without arguments\n"
                               "  sin x\n"
                               "  ^~~\n"
                               "hint: arguments stand in parentheses: sin(x)");
    CHECK(sentence_of("V()") == "'V' is called without arguments");
}

TEST_CASE("comparisons stand in domains and conditions only")
{
    CHECK(error_of("1 + (a < b)") == "e:1:5: error: a comparison stands where a value is required\n"
                                     "  1 + (a < b)\n"
                                     "      ^~~~~~~\n"
                                     "hint: comparisons stand in domains and as the first argument of if(c, a, b)");
    for (const char* text : {"a < b", "(a < b)*2", "2^(a < b)", "-(a < b)", "sin(a < b)", "V(a < b)", "a*(b<c)",
                             "a-(b<c)", "(a<b)^2", "(a<b)+1", "if(a<b, c<d, 1)"}) {
        INFO(text);
        CHECK(sentence_of(text) == "a comparison stands where a value is required");
    }
    CHECK(error_of("if(x, 1, 2)") == "e:1:4: error: the first argument of if is not a comparison\n"
                                     "  if(x, 1, 2)\n"
                                     "     ^\n"
                                     "hint: a condition compares two values, for instance x > 0");
    CHECK(error_of_comparison("x + 1") == "e:1:1: error: this is not a comparison\n"
                                          "  x + 1\n"
                                          "  ^~~~~\n"
                                          "hint: a domain is made of strict inequalities: a < b, a > b or a != b");
    CHECK(error_of_comparison("0 < x < 1") ==
          "e:1:7: error: '<' follows a comparison\n"
          "  0 < x < 1\n"
          "        ^\n"
          "hint: a chain a < b < c is two comparisons that stand alone, as in domain = [\"a < b\", \"b < c\"]");
}

TEST_CASE("a character outside of the language is named, with what is written instead")
{
    CHECK(error_of("x{1}") == "e:1:2: error: unexpected character '{'\n"
                              "  x{1}\n"
                              "   ^\n"
                              "hint: terms are grouped with '(' and ')', and vectors are written [a, b]");
    CHECK(error_of("x²") == "e:1:2: error: unexpected character '²' (U+00B2)\n"
                            "  x²\n"
                            "   ^\n"
                            "hint: a square is written '^2'");
    CHECK(error_of("a − b") == "e:1:3: error: unexpected character '−' (U+2212)\n"
                               "  a − b\n"
                               "    ^\n"
                               "hint: the minus sign is written '-'");
    CHECK(error_of("x**2") == "e:1:2: error: unexpected '**'\n"
                              "  x**2\n"
                              "   ^~\n"
                              "hint: a power is written '^'");
    CHECK(sentence_of("x $ y") == "unexpected character '$'");
    CHECK(sentence_of(std::string("x\0y", 3)) == "unexpected character '?' (U+0000)");
}

TEST_CASE("text that is not UTF-8 is refused at its first bad byte")
{
    CHECK(error_of("θ + \xff") == "e:1:5: error: the byte 0xff is not valid UTF-8\n"
                                  "  θ + ?\n"
                                  "      ^\n"
                                  "hint: save the file in the encoding UTF-8");
}

TEST_CASE("division by a constant zero is refused")
{
    CHECK(error_of("x/0") == "e:1:1: error: division by zero\n"
                             "  x/0\n"
                             "  ^~~");
    CHECK(sentence_of("1/(0.5 - 1/2)") == "division by zero");
    CHECK(sentence_of("0^-1") == "division by zero");
    CHECK(sentence_of("0^(1-1)") == "0^0 is not defined");
}

TEST_CASE("literals are bounded")
{
    CHECK(error_of("1e999999999") == "e:1:1: error: the decimal exponent of '1e999999999' is outside -400 to 400\n"
                                     "  1e999999999\n"
                                     "  ^~~~~~~~~~~");
    CHECK(sentence_of("1e-401") == "the decimal exponent of '1e-401' is outside -400 to 400");
    CHECK(sentence_of("1e-400") == "accepted");
    CHECK(sentence_of(repeated("7", 401)) == "a number has 401 digits, and at most 400 are accepted");
    CHECK(sentence_of(repeated("7", 400)) == "accepted");
    CHECK(sentence_of("1.2.3") == "malformed number '1.2.'");
}

TEST_CASE("exponents and constants are bounded")
{
    CHECK(error_of("x^(10^10)") == "e:1:4: error: the exponent 10000000000 is too large\n"
                                   "  x^(10^10)\n"
                                   "     ^~~~~\n"
                                   "hint: the exponent of a base that is not a constant is at most 64 in size");
    CHECK(error_of("10^10^10") == "e:1:1: error: a constant needs more than 4096 bits\n"
                                  "  10^10^10\n"
                                  "  ^~~~~~~~\n"
                                  "hint: constants are kept as exact fractions, whose numerators and denominators are "
                                  "bounded by 4096 bits");
    for (const char* text : {"2^(2^64)", "2^-(2^64)", "10^1000000000", "(1/3)^99999", "2^(10^10 + 1/2)",
                             "2^4000*2^4000", "x*2^4000*2^4000", "(2^100*x)^60", "x + 2^-4000/3^2000"}) {
        INFO(text);
        CHECK(sentence_of(text) == "a constant needs more than 4096 bits");
    }
    CHECK(sentence_of("x^65") == "the exponent 65 is too large");
    CHECK(sentence_of("x^-65") == "the exponent -65 is too large");
    CHECK(sentence_of("x^64.5") == "the exponent 129/2 is too large");
    CHECK(sentence_of("x^64 + x^-64") == "accepted");
    CHECK(sentence_of("2^2^11 + 2^y") == "accepted");
}

TEST_CASE("nested powers are bounded by their total degree")
{
    CHECK(error_of("((x^64)^64)^64") == "e:1:1: error: nested powers reach the total degree 262144\n"
                                        "  ((x^64)^64)^64\n"
                                        "  ^~~~~~~~~~~~~~\n"
                                        "hint: the total degree of a power or a product is at most 4096");
    CHECK(sentence_of("(x^64)^64") == "accepted");
    CHECK(sentence_of("(x*(1 + y^64)^64)^2") == "nested powers reach the total degree 8194");
    CHECK(sentence_of(repeated("(", 200) + "x" + repeated("^2)", 200)) == "nested powers reach the total degree 8192");
}

TEST_CASE("nesting is bounded, however it is written")
{
    const std::string nested = "parentheses, calls, signs and exponents are nested more than 256 deep";
    CHECK(sentence_of(repeated("(", 999'990)) == nested);
    CHECK(sentence_of(repeated("(", 499'990) + "x" + repeated(")", 499'990)) == nested);
    CHECK(sentence_of(repeated("-", 999'990) + "x") == nested);
    CHECK(sentence_of("x" + repeated("^x", 499'990)) == nested);
    CHECK(sentence_of(repeated("sin(", 249'990)) == nested);
    CHECK(sentence_of(repeated("f(", 257) + "x" + repeated(")", 257)) == nested);
    CHECK(sentence_of(repeated("f(", 256) + "x" + repeated(")", 256)) == "accepted");
    CHECK(sentence_of("a" + repeated("/a", 499'990)) == "more than 1024 operations stand inside one another");
    CHECK(sentence_of("a" + repeated("/a*a", 249'990)) == "more than 1024 operations stand inside one another");
    CHECK(sentence_of("a" + repeated("/a", 1000)) == "accepted");
}

TEST_CASE("the length of a text is bounded")
{
    CHECK(sentence_of(repeated(" ", 1'000'001)) ==
          "the expression has 1000001 bytes, and at most 1000000 are accepted");
    CHECK_THAT(error_of(repeated(" ", 1'000'001)), Catch::EndsWith("hint: split it with [definitions]"));
}
