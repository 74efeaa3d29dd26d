// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure of what is parsed: precedence, exact numbers, names, positions.
#include "parsing.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

TEST_CASE("unary minus stands between product and power")
{
    CHECK(structure(parse("-x^2")) == "(negate (power x 2))");
    CHECK(structure(parse("(-x)^2")) == "(power (negate x) 2)");
    CHECK(structure(parse("2^-1*x")) == "(multiply (power 2 (negate 1)) x)");
    CHECK(structure(parse("x*-y+z")) == "(add (multiply x (negate y)) z)");
    CHECK(structure(parse("x/-2+y")) == "(add (divide x (negate 2)) y)");
    CHECK(structure(parse("x^-y*z")) == "(multiply (power x (negate y)) z)");
    CHECK(structure(parse("2*-3+1")) == "(add (multiply 2 (negate 3)) 1)");
    CHECK(structure(parse("2^-x^2")) == "(power 2 (negate (power x 2)))");
    CHECK(structure(parse("--x")) == "(negate (negate x))");
    CHECK(structure(parse("-a*b")) == "(multiply (negate a) b)");
    CHECK(structure(parse("+x - +2")) == "(add x (negate 2))");
}

TEST_CASE("a power is right associative, a quotient and a difference are left associative")
{
    CHECK(structure(parse("x^y^z")) == "(power x (power y z))");
    CHECK(structure(parse("a/b/c")) == "(divide (divide a b) c)");
    CHECK(structure(parse("a*b/c*d")) == "(multiply (divide (multiply a b) c) d)");
    CHECK(structure(parse("a-b+c-d")) == "(add a (negate b) c (negate d))");
    CHECK(structure(parse("a-(b-c)")) == "(add a (negate (add b (negate c))))");
}

TEST_CASE("sums and products are flat, and brackets are kept")
{
    CHECK(structure(parse("a+b+c*d*e")) == "(add a b (multiply c d e))");
    CHECK(structure(parse("a+(b+c)")) == "(add a (add b c))");
    CHECK(structure(parse("((a))")) == "a");
}

TEST_CASE("decimals are exact rationals")
{
    CHECK(parse("0.1")->number == Rational(1, 10));
    CHECK(parse("1.5e-3")->number == Rational(3, 2000));
    CHECK(parse(".5")->number == Rational(1, 2));
    CHECK(parse("1e3")->number == Rational(1000));
    CHECK(parse("2E+2")->number == Rational(200));
    CHECK(parse("3.")->number == Rational(3));
    CHECK(parse("007")->number == Rational(7));
    CHECK(parse("6.67430e-11")->number == Rational("66743/1000000000000000"));
    CHECK(structure(parse("0.1 + 0.2 - 0.3")) == "(add 1/10 1/5 (negate 3/10))");
}

TEST_CASE("letters that other systems reserve are free names, and pi is the constant")
{
    CHECK(structure(parse("I*e + E - D + Pi")) == "(add (multiply I e) E (negate D) Pi)");
    CHECK(structure(parse("2*pi")) == "(multiply 2 PI)");
    CHECK(structure(parse("e1 + 2*e")) == "(add e1 (multiply 2 e))");
}

TEST_CASE("names are made of ASCII and Unicode letters, digits and '_'")
{
    CHECK(structure(parse("θ_1 + Δx*ψ")) == "(add θ_1 (multiply Δx ψ))");
    for (const char* good : {"x", "_x", "x_1", "θ", "ẋ", "é", "Ж", "質量", "ℓ", "ħ", "𝜌"}) {
        INFO(good);
        CHECK(is_identifier(good));
    }
    for (const char* bad : {"", "1x", "x y", "x-y", "x²", "x'", "∂x", "\xCE", "x\xFF", "½", "a.b", "×", "x[1]", "€"}) {
        INFO(bad);
        CHECK_FALSE(is_identifier(bad));
    }
}

TEST_CASE("functions are calls, unknown ones are left for the scope")
{
    CHECK(structure(parse("atan2(y, x)*sin(-x)")) == "(multiply (atan2 y x) (sin (negate x)))");
    CHECK(structure(parse("V(q1, 2)")) == "(apply V q1 2)");
    CHECK(structure(parse("if(x > 0, min(x, 1), sign(y))")) == "(if (> x 0) (min x 1) (sign y))");
    CHECK(structure(parse("if((x > 0), 1, 2)")) == "(if (> x 0) 1 2)");
}

TEST_CASE("every comparison is parsed")
{
    const auto compared = [](const std::string& text) { return structure(parse_comparison(whole_text("e", text))); };
    CHECK(compared("a<b") == "(< a b)");
    CHECK(compared("a <= b") == "(<= a b)");
    CHECK(compared("a > -2") == "(> a (negate 2))");
    CHECK(compared("a>=b+1") == "(>= a (add b 1))");
    CHECK(compared("a == b") == "(== a b)");
    CHECK(compared("(a != b)") == "(!= a b)");
}

TEST_CASE("a node's range is the text of that very sub-expression")
{
    const Tree tree = parse("a - (b + 2*c)*sin(d)");
    CHECK(source_text(tree->where) == "a - (b + 2*c)*sin(d)");
    const Tree term = tree->arguments[1];
    CHECK(source_text(term->where) == "- (b + 2*c)*sin(d)");
    const Tree product = term->arguments[0];
    CHECK(source_text(product->where) == "(b + 2*c)*sin(d)");
    CHECK(source_text(product->arguments[0]->where) == "b + 2*c");
    CHECK(source_text(product->arguments[1]->where) == "sin(d)");
}

TEST_CASE("constants are folded for the bounds only: the tree keeps what was written")
{
    CHECK(structure(parse("x^(2*3) + 2^10")) == "(add (power x (multiply 2 3)) (power 2 10))");
    CHECK(structure(parse("1^10^10")) == "(power 1 (power 10 10))");
    CHECK(structure(parse("(-1)^(10^10)")) == "(power (negate 1) (power 10 10))");
}

TEST_CASE("sums and products of 1e5 terms are parsed as one node")
{
    std::string sum = "x", product = "x";
    for (int k = 1; k < 100'000; ++k) {
        sum += "+x";
        product += "*x";
    }
    CHECK(parse(sum)->arguments.size() == 100'000);
    CHECK(parse(product)->arguments.size() == 100'000);
}
