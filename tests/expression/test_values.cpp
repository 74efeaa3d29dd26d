// SPDX-License-Identifier: GPL-2.0-or-later
/// The values of three hundred random expressions against those of another language's exact arithmetic.
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace lagen;
using namespace lagen::test;

namespace {

Rational power_of(const Rational& base, const Rational& exponent)
{
    REQUIRE(exponent.get_den() == 1);
    const long n = exponent.get_num().get_si();
    Rational result = 1;
    for (long k = 0; k < std::abs(n); ++k) result *= base;
    return n < 0 ? Rational(1 / result) : result;
}

/// The value of a tree at x = 3/5, y = -7/4, z = 2.
Rational exact_value(const Tree& tree)
{
    std::vector<Rational> arguments;
    for (const Tree& argument : tree->arguments) arguments.push_back(exact_value(argument));
    Rational result;
    switch (tree->kind) {
    case TreeKind::number: return tree->number;
    case TreeKind::name: return tree->name == "x" ? Rational(3, 5) : tree->name == "y" ? Rational(-7, 4) : Rational(2);
    case TreeKind::negate: return -arguments[0];
    case TreeKind::add:
        for (const Rational& term : arguments) result += term;
        return result;
    case TreeKind::multiply:
        result = 1;
        for (const Rational& factor : arguments) result *= factor;
        return result;
    case TreeKind::divide: return arguments[0] / arguments[1];
    case TreeKind::power: return power_of(arguments[0], arguments[1]);
    default: FAIL("no rational operation: " << to_text(tree));
    }
    return result;
}

} // namespace

TEST_CASE("three hundred random expressions have the values that exact arithmetic elsewhere gives them")
{
    std::ifstream file(LAGEN_SOURCE_DIR "/tests/data/expressions.txt");
    std::size_t count = 0;
    for (std::string line; std::getline(file, line);) {
        const std::size_t equals = line.find(" = ");
        if (line.starts_with('#') || equals == std::string::npos) continue;
        const std::string text = line.substr(0, equals);
        const Rational expected(line.substr(equals + 3));
        const Tree tree = parse(text);
        INFO(text);
        CHECK(exact_value(tree) == expected);
        CHECK(exact_value(parse(to_text(tree))) == expected);
        ++count;
    }
    CHECK(count == 300);
}
