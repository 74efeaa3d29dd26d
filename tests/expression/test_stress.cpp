// SPDX-License-Identifier: GPL-2.0-or-later
/// Random texts: each is a tree or a ModelError with a place inside of the text, and nothing else.
#include "parsing.hpp"

#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <random>

using namespace lagen;
using namespace lagen::test;

namespace {

constexpr std::size_t trials = LAGEN_SANITIZED ? 20'000 : 200'000;

struct Outcome {
    std::size_t parsed = 0;
    std::size_t rejected = 0;
};

/// Parses a text; what is accepted must print to a text that is accepted and grows no more.
void try_text(const std::string& text, const Scope& scope, Outcome& outcome)
{
    Tree tree;
    try {
        tree = parse(text);
        (void)scope.close(tree, true);
    } catch (const ModelError& error) {
        const SourceRange& where = error.diagnostic().where;
        if (where.begin > where.end || error.diagnostic().message.empty())
            FAIL("a range of negative length in: " << text);
    }
    if (!tree) {
        ++outcome.rejected;
        return;
    }
    ++outcome.parsed;
    const std::string printed = to_text(tree);
    try {
        if (to_text(parse(printed)).size() > printed.size()) FAIL("grows: " << text << " -> " << printed);
    } catch (const ModelError& error) {
        FAIL("printed text is refused: " << text << " -> " << error.what());
    }
}

} // namespace

TEST_CASE("random token strings are parsed or refused, never anything else")
{
    constexpr std::array tokens{"x",  "y",    "2",  "0.5",  "1e3", "+",  "-",      "*",   "/",  "^",  "(",  ")",
                                ",",  "sin(", "f(", "pi",   " ",   "<",  "atan2(", "if(", "==", "θ",  "[",  "10",
                                "64", "e",    ".",  "(-x)", "V",   "^2", "*y",     "+1",  "-x", "/3", "99", "\xCE"};
    Scope scope;
    for (const char* symbol : {"x", "y", "θ"}) scope.declare(symbol, {});
    scope.define({"f", {"q"}, parse("q^2 + x"), {}});
    scope.define({"V", {}, parse("f(y)/2"), {}});
    std::mt19937 random(20240607);
    Outcome outcome;
    for (std::size_t k = 0; k < trials; ++k) {
        std::string text;
        for (auto length = 1 + random() % 9; length > 0; --length) text += tokens[random() % tokens.size()];
        try_text(text, scope, outcome);
    }
    CHECK(outcome.parsed > trials / 40);
    CHECK(outcome.rejected > trials / 2);
}

TEST_CASE("random strings of arrays and sums are parsed or refused, never anything else")
{
    constexpr std::array tokens{
        "u",          "A",        "x",         "2",       "3",       "i",          "n",
        "[1]",        "[i]",      "[1,2]",     "[",       "]",       ",",          "(",
        ")",          "+",        "-",         "*",       "/",       "^2",         "^-1",
        "det(",       "hat(",     "exp(",      "cay(",    "vee(",    "norm(",      "dot(u,",
        "cross(",     "diag(",    "1]",        "[[1,2],", "[x,2,3]", "sum(i,1,n,", "product(i,1,2,",
        "transpose(", "inverse(", "identity(", "g(",      "tr(",     "norm",       "stumpff(1,"};
    Scope scope;
    scope.declare("x", {});
    scope.declare_size("n", 3, {});
    scope.declare_family("u", {Rank::vector, 3, 1}, {});
    scope.declare_family("A", {Rank::matrix, 3, 3}, {});
    scope.define({"g", {"q"}, parse("q[1]*u + q"), {}});
    std::mt19937 random(31);
    Outcome outcome;
    for (std::size_t k = 0; k < trials / 2; ++k) {
        std::string text;
        for (auto length = 1 + random() % 8; length > 0; --length) text += tokens[random() % tokens.size()];
        auto open = std::count(text.begin(), text.end(), '(') - std::count(text.begin(), text.end(), ')');
        if (random() % 2) // half of them with their parentheses closed
            for (; open > 0; --open) text += ")";
        try_text(text, scope, outcome);
    }
    CHECK(outcome.parsed > trials / 70);
    CHECK(outcome.rejected > trials / 7);
}

TEST_CASE("random bytes are parsed or refused, never anything else")
{
    Scope scope;
    std::mt19937 random(7);
    Outcome outcome;
    for (int k = 0; k < 50'000; ++k) {
        std::string text;
        for (auto length = 1 + random() % 12; length > 0; --length) text += static_cast<char>(random() % 256);
        try_text(text, scope, outcome);
    }
    CHECK(outcome.rejected > 45'000);
}
