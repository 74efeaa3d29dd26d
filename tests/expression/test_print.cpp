// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees as text: exact texts, and the law that a text has the value of its tree.
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <optional>
#include <random>

using namespace lagen;
using namespace lagen::test;

namespace {

/// Arithmetic modulo the prime 2^61 - 1, in which an identity of rational functions holds at every point, and a
/// difference fails at almost every one. Functions and powers that are no integer are hashed.
using Word = std::uint64_t;
constexpr Word prime = (Word{1} << 61) - 1;

Word times(Word a, Word b)
{
    Word result = 0; // 2^61 - 1 leaves 3 bits: three bits of b at a time
    for (int shift = 60; shift >= 0; shift -= 3) {
        for (int k = 0; k < 3; ++k) result = result * 2 % prime;
        result = (result + a % prime * ((b >> shift) & 7)) % prime;
    }
    return result;
}

Word raised(Word a, Word n)
{
    Word result = 1;
    for (; n > 0; n >>= 1, a = times(a, a))
        if (n & 1) result = times(result, a);
    return result;
}

Word inverse(Word a)
{
    return raised(a, prime - 2);
}
Word negative(Word a)
{
    return (prime - a) % prime;
}
Word mixed(Word a, Word b)
{
    return (times(a + 0x9E3779B97F4A7C15u % prime, 0x2545F4914F6CDDu) + raised(b + 7, 5)) % prime;
}

Word residue(const Rational& value)
{
    const mpz_class p = static_cast<unsigned long>(prime);
    mpz_class top = value.get_num() % p;
    if (top < 0) top += p;
    const mpz_class below = value.get_den() % p;
    return times(top.get_ui(), inverse(below.get_ui()));
}

/// The value of a constant tree as an integer, where it is one and small.
std::optional<long> small_integer(const Tree& tree)
{
    if (tree->kind == TreeKind::negate) {
        const auto inner = small_integer(tree->arguments[0]);
        return inner ? std::optional<long>(-*inner) : std::nullopt;
    }
    if (tree->kind != TreeKind::number || tree->number.get_den() != 1) return std::nullopt;
    return tree->number.get_num().get_si();
}

Word value_of(const Tree& tree);

Word hash_of(const Tree& tree, Word seed)
{
    for (const Tree& argument : tree->arguments) seed = mixed(seed, value_of(argument));
    return seed;
}

Word value_of(const Tree& tree)
{
    const std::vector<Tree>& a = tree->arguments;
    Word result = 0;
    switch (tree->kind) {
    case TreeKind::number: return residue(tree->number);
    case TreeKind::pi: return 314159;
    case TreeKind::name: return mixed(static_cast<Word>(tree->name[0]), tree->name.size());
    case TreeKind::negate: return negative(value_of(a[0]));
    case TreeKind::add:
        for (const Tree& term : a) result = (result + value_of(term)) % prime;
        return result;
    case TreeKind::multiply:
        result = 1;
        for (const Tree& factor : a) result = times(result, value_of(factor));
        return result;
    case TreeKind::divide: return times(value_of(a[0]), inverse(value_of(a[1])));
    case TreeKind::power:
        if (const auto n = small_integer(a[1])) {
            const Word size = raised(value_of(a[0]), static_cast<Word>(std::abs(*n)));
            return *n < 0 ? inverse(size) : size;
        }
        return hash_of(tree, 1);
    case TreeKind::call: return hash_of(tree, 100 + static_cast<Word>(tree->function));
    case TreeKind::apply: return hash_of(tree, 200 + tree->name.size());
    case TreeKind::compare: return hash_of(tree, 300 + static_cast<Word>(tree->comparison));
    case TreeKind::solve:
    case TreeKind::array:
    case TreeKind::index:
    case TreeKind::sum_over:
    case TreeKind::product_over: return hash_of(tree, 400 + static_cast<Word>(tree->kind));
    }
    return 0;
}

class RandomTree {
  public:
    explicit RandomTree(unsigned seed) : random_(seed) {}

    Tree operator()(int depth)
    {
        if (depth == 0) return leaf();
        switch (random_() % 9) {
        case 0: return leaf();
        case 1: return negate((*this)(depth - 1));
        case 2: return add(several(depth));
        case 3: return multiply(several(depth));
        case 4: return divide((*this)(depth - 1), name("b"));
        case 5: return divide(name("a"), (*this)(depth - 1));
        case 6: return power((*this)(depth - 1), exponent());
        case 7: return call(Function::atan2, {(*this)(depth - 1), (*this)(depth - 1)});
        default:
            return call(Function::select,
                        {compare(Comparison::less_equal, (*this)(depth - 1), leaf()), leaf(), leaf()});
        }
    }

  private:
    std::vector<Tree> several(int depth)
    {
        std::vector<Tree> result;
        for (auto k = 1 + random_() % 3; k > 0; --k) result.push_back((*this)(depth - 1));
        return result;
    }
    Tree exponent()
    {
        const long n = static_cast<long>(random_() % 5) - 2;
        return random_() % 2 ? number(Rational(n == 0 ? 3 : n)) : negate(name("c"));
    }
    Tree leaf()
    {
        static const char* const values[] = {"2", "-3", "1/3", "-7/10", "1/8", "49/10"};
        if (random_() % 2) return name(std::string(1, static_cast<char>('a' + random_() % 4)));
        return random_() % 5 ? number(Rational(values[random_() % 6])) : constant_pi();
    }

    std::mt19937 random_;
};

std::string reprinted(const std::string& text)
{
    return to_text(parse(text));
}

} // namespace

TEST_CASE("a text has the fewest parentheses")
{
    for (const char* text : {"a + b*c",     "(a + b)*c",
                             "a - (b + c)", "a - b - c",
                             "a/(b*c)",     "a/b/c",
                             "a/(b/c)",     "-x^2",
                             "(-x)^2",      "x^y^z",
                             "(x^y)^z",     "2^-x",
                             "x^(a + b)",   "-(a + b)",
                             "a*b/c*d",     "sin(x)^2 + cos(x)^2",
                             "V(a, b + 1)", "if(x <= 0, min(a, b), -x)",
                             "2*pi*r",      "a*-b",
                             "--x",         "2^(a/b)",
                             "x/-y",        "a - -b"}) {
        CHECK(reprinted(text) == text);
    }
    CHECK(reprinted("((a))+((b*(c)))") == "a + b*c");
    CHECK(reprinted("a+(b+c)") == "a + b + c");
    CHECK(reprinted("a*(b*c)") == "a*b*c");
    CHECK(reprinted("a*(b/c)") == "a*b/c");
    CHECK(reprinted("a + (-b)*c") == "a - b*c");
    CHECK(reprinted("-(a*b)") == "-a*b");
    CHECK(reprinted("a*--0.025") == "a*--1/40");
    CHECK(reprinted(reprinted("a*--0.025")) == "a*--1/40");
    CHECK(reprinted("x/(-(a*b))") == "x/(-a*b)");
}

TEST_CASE("a number prints as an integer, a fraction, or a shorter decimal")
{
    const auto text = [](const char* value) { return to_text(number(Rational(value))); };
    CHECK(text("42") == "42");
    CHECK(text("-42") == "-42");
    CHECK(text("1/2") == "1/2");
    CHECK(text("1/3") == "1/3");
    CHECK(text("1/10") == "0.1");
    CHECK(text("49/10") == "4.9");
    CHECK(text("-981/100") == "-9.81");
    CHECK(text("1/8") == "1/8");
    CHECK(text("1/1000") == "0.001");
    CHECK(text("1000000") == "1000000");
    CHECK(to_text(parse("21e399")) == "21e399");
    CHECK(to_text(parse("-5e-300")) == "-5e-300");
    CHECK(to_text(parse("12345678901234567890123456789")) == "12345678901234567890123456789");
    CHECK(to_text(power(number(Rational(1, 3)), name("x"))) == "(1/3)^x");
    CHECK(to_text(power(number(Rational(1, 10)), number(-2))) == "0.1^-2");
    CHECK(to_text(power(number(-2), number(2))) == "(-2)^2");
    CHECK(to_text(multiply({number(Rational(1, 2)), name("m")})) == "1/2*m");
    CHECK(to_text(divide(name("m"), number(Rational(1, 2)))) == "m/(1/2)");
    CHECK(to_text(add({name("x"), number(-3), multiply({number(-2), name("y")})})) == "x - 3 - 2*y");
}

TEST_CASE("sums and products of none or one print their values")
{
    CHECK(to_text(add({})) == "0");
    CHECK(to_text(power(multiply({}), name("x"))) == "1^x");
    CHECK(to_text(power(add({multiply({name("x")})}), number(2))) == "x^2");
}

TEST_CASE("what is printed has the value of the tree, and printed again it is no longer")
{
    for (unsigned seed = 0; seed < 1500; ++seed) {
        const Tree tree = RandomTree(seed)(1 + static_cast<int>(seed % 5));
        const std::string text = to_text(tree);
        const Tree again = parse(text);
        if (value_of(again) == value_of(tree) && to_text(again).size() <= text.size()) continue;
        INFO(structure(tree));
        INFO(text);
        CHECK(value_of(again) == value_of(tree));
        CHECK(to_text(again).size() <= text.size());
    }
}

TEST_CASE("the random trees of the law above tell different values apart")
{
    CHECK(value_of(parse("a - (b - c)")) != value_of(parse("a - b - c")));
    CHECK(value_of(parse("a/(b*c)")) != value_of(parse("a/b*c")));
    CHECK(value_of(parse("(a + b)^2")) == value_of(parse("a^2 + 2*a*b + b^2")));
    CHECK(value_of(parse("a^-2")) == value_of(parse("1/a/a")));
}

TEST_CASE("names are listed in order of first occurrence")
{
    CHECK(names_in(parse("b*(a + c) - sin(b)*V(d)^a + pi")) == std::vector<std::string>{"b", "a", "c", "d"});
    CHECK(names_in(parse("1 + 2")).empty());
}

TEST_CASE("trees are the same where structure, numbers and names are, whatever their positions")
{
    CHECK(same_tree(parse("a + 0.5*b"), parse("  a+ (1e-1*5*b)")) == false);
    CHECK(same_tree(parse("a + 0.5*b"), parse("  a+ (.5*b)")));
    CHECK_FALSE(same_tree(parse("a + b"), parse("b + a")));
    CHECK_FALSE(same_tree(parse("sin(a)"), parse("cos(a)")));
    CHECK_FALSE(same_tree(parse("f(a)"), parse("g(a)")));
    CHECK_FALSE(same_tree(parse("a + b"), parse("a + b + c")));
    CHECK_FALSE(same_tree(parse("pi"), parse("3")));
}

TEST_CASE("shared trees of 60 doublings are compared, listed and cut at once")
{
    Tree left = name("x"), right = name("x"), other = name("y");
    for (int k = 0; k < 60; ++k) {
        left = add({left, left});
        right = add({right, right});
        other = add({other, other});
    }
    CHECK(same_tree(left, right));
    CHECK_FALSE(same_tree(left, other));
    CHECK(names_in(left) == std::vector<std::string>{"x"});
    const std::string text = to_text(left);
    CHECK(text.size() == 1'000'003);
    CHECK(text.substr(0, 9) == "x + x + x");
    CHECK(text.substr(1'000'000) == "...");
}

TEST_CASE("a tree a million levels deep is printed, walked and released without recursion")
{
    Tree deep = name("x");
    for (int k = 0; k < 1'000'000; ++k) deep = k % 2 ? negate(deep) : divide(deep, name("y"));
    CHECK(names_in(deep) == std::vector<std::string>{"x", "y"});
    CHECK(same_tree(deep, deep));
    CHECK(to_text(deep).size() == 1'000'003);
}
