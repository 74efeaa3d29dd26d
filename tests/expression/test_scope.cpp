// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing trees over declared names and definitions.
#include "closing.hpp"
#include "parsing.hpp"

#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

using namespace lagen;
using namespace lagen::test;

namespace {

Scope scope_of(const std::vector<std::string>& symbols, std::vector<Definition> definitions = {})
{
    Scope scope;
    for (const std::string& symbol : symbols) scope.declare(symbol, {});
    for (Definition& entry : definitions) scope.define(std::move(entry));
    return scope;
}

std::string closed(const Scope& scope, const std::string& text, bool nonsmooth = false)
{
    try {
        return structure(scope.close(parse(text), nonsmooth));
    } catch (const ModelError& error) {
        return error.what();
    }
}

template <class Action>
std::string error_text(Action action)
{
    try {
        action();
    } catch (const ModelError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("definitions are expanded in any order, functions with their arguments")
{
    const Scope scope = scope_of({"m", "v", "q", "g"}, {definition("L", "T - V(q + 1)"), definition("T", "m*v^2/2"),
                                                        definition("V", "m*g*h", {"h"})});
    CHECK(closed(scope, "L") == "(add (divide (multiply m (power v 2)) 2) (negate (multiply m g (add q 1))))");
    CHECK(closed(scope, "V(V(2))") == "(multiply m g (multiply m g 2))");
}

TEST_CASE("a parameter of a function hides a symbol of the same name")
{
    const Scope scope = scope_of({"x", "y"}, {definition("f", "x + y + pi", {"x", "pi"})});
    CHECK(closed(scope, "f(y, 2)") == "(add y y 2)");
}

TEST_CASE("pi is a constant unless the model declares it")
{
    CHECK(closed(scope_of({"x"}), "pi*x") == "(multiply PI x)");
    const Scope own = scope_of({"pi"}, {definition("a", "2*pi")});
    CHECK(own.close(parse("pi"))->kind == TreeKind::name);
    CHECK(closed(own, "a") == "(multiply 2 pi)");
    CHECK(closed(scope_of({"x"}, {definition("pi", "x + 3")}), "2*pi") == "(multiply 2 (add x 3))");
}

TEST_CASE("letters that other systems reserve are symbols where the model says so")
{
    CHECK(closed(scope_of({"I", "e", "D", "Pi"}), "I*e/D^Pi") == "(divide (multiply I e) (power D Pi))");
}

TEST_CASE("a definition is one shared tree wherever it stands")
{
    const Scope scope = scope_of({"x"}, {definition("a", "sin(x)"), definition("f", "q^2", {"q"})});
    const Tree twice = scope.close(parse("a*a + f(x + 1)/f(x + 1) + f(x + 2)"));
    const Tree product = twice->arguments[0];
    CHECK(product->arguments[0] == product->arguments[1]);
    const Tree quotient = twice->arguments[1];
    CHECK(quotient->arguments[0] == quotient->arguments[1]);
    CHECK(quotient->arguments[0] != twice->arguments[2]);
    CHECK(scope.close(parse("a")) == product->arguments[0]);
}

TEST_CASE("a tree without definitions is closed already and is returned as it is")
{
    const Scope scope = scope_of({"x"});
    const Tree tree = parse("sin(x)^2 + 3");
    CHECK(scope.close(tree) == tree);
}

TEST_CASE("what a closed tree calls pi is the number, whatever another scope calls pi")
{
    const Tree closed_here = scope_of({"x"}).close(parse("x + pi"));
    const Scope other = scope_of({"x", "pi"});
    CHECK(names_in(other.close(closed_here)) == std::vector<std::string>{"x"});
    CHECK(names_in(other.close(parse("x + pi"))) == std::vector<std::string>{"x", "pi"});
}

TEST_CASE("an unknown symbol gets the nearest name")
{
    const Scope scope = scope_of({"g1", "g2", "g3", "mgl"}, {definition("T", "g1")});
    CHECK(closed(scope, "T - mgl*g4") == "e:1:9: error: unknown symbol 'g4'\n"
                                         "  T - mgl*g4\n"
                                         "          ^~\n"
                                         "hint: did you mean 'g1'?");
    CHECK(closed(scope, "zeta") == "e:1:1: error: unknown symbol 'zeta'\n"
                                   "  zeta\n"
                                   "  ^~~~\n"
                                   "hint: known names are g1, g2, g3, mgl, T");
    CHECK_THAT(closed(scope, "π"), Catch::EndsWith("hint: the constant is written pi"));
    CHECK_THAT(closed(scope_of({}), "x"), Catch::EndsWith("hint: sizes are declared first: [sizes] x = 3"));
}

TEST_CASE("what is to be listed last stands behind all others in a hint, which is cut after twenty names")
{
    Scope scope = scope_of({"m", "x"}, {definition("T", "x")});
    scope.declare_family("w", {lagen::Rank::vector, 2, 1}, {});
    scope.list_last("m");
    CHECK_THAT(closed(scope, "zeta"), Catch::EndsWith("hint: known names are x, w, T, m"));
    std::vector<std::string> many;
    for (int k = 10; k < 31; ++k) many.push_back("a" + std::to_string(k));
    CHECK_THAT(closed(scope_of(many), "zeta"), Catch::EndsWith(", a28, a29, ..."));
}

TEST_CASE("energy, Hamiltonian and Lagrangian are known by their letters where they are known")
{
    CHECK_THAT(closed(scope_of({"x", "energy"}), "E"), Catch::EndsWith("hint: did you mean 'energy'?"));
    CHECK_THAT(closed(scope_of({"x", "energy", "hamiltonian"}), "H"), Catch::EndsWith("did you mean 'hamiltonian'?"));
    CHECK_THAT(closed(scope_of({"x", "lagrangian"}), "L"), Catch::EndsWith("hint: did you mean 'lagrangian'?"));
    CHECK_THAT(closed(scope_of({"x"}), "E"), Catch::EndsWith("hint: known names are x"));
}

TEST_CASE("an unknown name that reads like an entry of a family gets that entry, before the nearest name")
{
    Scope scope = scope_of({"I1", "x2"});
    scope.declare_family("w", {lagen::Rank::vector, 12, 1}, {});
    scope.declare_family("W", {lagen::Rank::matrix, 2, 3}, {});
    scope.declare_family("x_", {lagen::Rank::vector, 2, 1}, {});
    CHECK_THAT(closed(scope, "w1"), Catch::EndsWith("hint: did you mean 'w[1]'?"));
    CHECK_THAT(closed(scope, "w_12"), Catch::EndsWith("hint: did you mean 'w[12]'?"));
    CHECK_THAT(closed(scope, "W23"), Catch::EndsWith("hint: did you mean 'W[2,3]'?"));
    CHECK_THAT(closed(scope, "x_2"), Catch::EndsWith("hint: did you mean 'x_[2]'?"));
    CHECK_THAT(closed(scope, "w13 + 1"), !Catch::Contains("["));
    CHECK_THAT(closed(scope, "W32"), !Catch::Contains("W[3,2]"));
    CHECK(closed(scope, "x2") == "x2");
}

TEST_CASE("a name that is explained has that hint where it is not declared")
{
    Scope scope = scope_of({"x", "p_y"});
    scope.explain("p_x", "momenta stand elsewhere");
    scope.explain("p_y", "momenta stand elsewhere");
    CHECK_THAT(closed(scope, "2*p_x"),
               Catch::EndsWith("unknown symbol 'p_x'\n  2*p_x\n    ^~~\nhint: momenta stand elsewhere"));
    CHECK(closed(scope, "p_y") == "p_y");
}

TEST_CASE("an unknown function gets the nearest function or this language's spelling")
{
    const Scope scope = scope_of({"x"}, {definition("energy", "q^2", {"q"})});
    CHECK(closed(scope, "enregy(x)") == "e:1:1: error: unknown function 'enregy'\n"
                                        "  enregy(x)\n"
                                        "  ^~~~~~~~~\n"
                                        "hint: did you mean 'energy'?");
    CHECK_THAT(closed(scope, "ln(x)"), Catch::EndsWith("hint: the natural logarithm is written log(x)"));
    CHECK_THAT(closed(scope, "sinn(x)"), Catch::EndsWith("hint: did you mean 'sin'?"));
}

TEST_CASE("symbols are not functions and functions are not symbols")
{
    const Scope scope = scope_of({"x"}, {definition("T", "x"), definition("V", "a*b", {"a", "b"})});
    CHECK(closed(scope, "x(2)") == "e:1:1: error: 'x' is not a function\n"
                                   "  x(2)\n"
                                   "  ^~~~\n"
                                   "hint: a product is written with '*': x*(..)");
    CHECK_THAT(closed(scope, "T(2)"),
               Catch::Contains("'T' is not a function") &&
                   Catch::EndsWith("hint: a function is defined with its arguments: \"T(q)\" = \"..\""));
    CHECK(closed(scope, "2*V") == "e:1:3: error: the function 'V' stands without arguments\n"
                                  "  2*V\n"
                                  "    ^\n"
                                  "hint: its arguments stand in parentheses: V(a, b)");
    CHECK(closed(scope, "V(x)") == "e:1:1: error: V takes 2 arguments, and 1 is given\n"
                                   "  V(x)\n"
                                   "  ^~~~\n"
                                   "hint: it is defined as V(a, b)");
}

TEST_CASE("a cycle among definitions is listed")
{
    const Scope scope = scope_of({"x"}, {definition("a", "b + 1"), definition("b", "2*c"), definition("c", "x*a"),
                                         definition("f", "f(q - 1)*q", {"q"})});
    CHECK(closed(scope, "a") == "c:1:3: error: the definition of 'a' refers to itself\n"
                                "  x*a\n"
                                "    ^\n"
                                "hint: the cycle is a -> b -> c -> a");
    CHECK_THAT(closed(scope, "f(x)"), Catch::EndsWith("hint: the cycle is f -> f"));
    CHECK(closed(scope, "x") == "x"); // an error before leaves nothing behind
}

TEST_CASE("functions that are not smooth are refused where smoothness matters, also inside definitions")
{
    const Scope scope = scope_of({"x"}, {definition("a", "2*max(x, 0)")});
    CHECK(closed(scope, "x + a") == "a:1:3: error: the function 'max' is not smooth\n"
                                    "  2*max(x, 0)\n"
                                    "    ^~~~~~~~~\n"
                                    "hint: min, max, sign and if stand in forces, observables and events only");
    CHECK(closed(scope, "x + a", true) == "(add x (multiply 2 (max x 0)))");
    CHECK_THAT(closed(scope, "if(x > 0, 1, 2)"), Catch::Contains("the function 'if' is not smooth"));
    CHECK(closed(scope, "if(x > 0, 1, a)", true) == "(if (> x 0) 1 (multiply 2 (max x 0)))");
    CHECK_THAT(closed(scope, "a"), Catch::Contains("the function 'max' is not smooth")); // after it was accepted once
}

TEST_CASE("a name is declared once")
{
    const Excerpt file = whole_text("m.toml", "x\ny\nx\n");
    Scope scope;
    scope.declare("x", file.range(0, 1));
    CHECK(error_text([&] { scope.declare("x", file.range(4, 5)); }) ==
          "m.toml:3:1: error: 'x' is declared twice\n  x\n  ^\nhint: the first declaration is at m.toml:1:1");
    CHECK_THAT(error_text([&] {
                   scope.define({"x", {}, parse("1"), file.range(4, 5)});
               }),
               Catch::Contains("'x' is declared twice"));
    CHECK(error_text([&] { scope.declare("sin", {}); }) ==
          "error: 'sin' is a built-in function and cannot be declared\nhint: choose another name");
    CHECK_THAT(error_text([&] {
                   scope.define({"f", {"a", "a"}, parse("a"), {}});
               }),
               Catch::Contains("the parameter 'a' stands twice") &&
                   Catch::EndsWith("hint: the parameters of a function have different names"));
    CHECK_THAT(error_text([&] {
                   scope.define({"f", {"sin"}, parse("1"), {}});
               }),
               Catch::Contains("'sin' is a built-in function and cannot be a parameter"));
}

TEST_CASE("a wider scope knows more symbols, and the model's own names keep their meaning")
{
    const Scope scope = scope_of({"x"}, {definition("t", "2*x")});
    const Scope wider = scope.with({"p_x", "t", "x"});
    CHECK(closed(wider, "p_x + t") == "(add p_x (multiply 2 x))");
    CHECK_FALSE(scope.has_symbol("p_x"));
    CHECK_THAT(closed(scope, "p_x"), Catch::Contains("unknown symbol 'p_x'"));
}

TEST_CASE("bounds hold across definitions")
{
    const Scope scope =
        scope_of({"x"}, {definition("a", "x^64"), definition("b", "a^64"), definition("c", "b^2"),
                         definition("n", "10^10"), definition("z", "1 - 1"), definition("f", "1/q", {"q"})});
    CHECK(closed(scope, "b") == "(power (power x 64) 64)");
    CHECK_THAT(closed(scope, "c"), Catch::Contains("nested powers reach the total degree 8192"));
    CHECK_THAT(closed(scope, "x^n"), Catch::Contains("the exponent 10000000000 is too large"));
    CHECK_THAT(closed(scope, "10^n"), Catch::Contains("a constant needs more than 4096 bits"));
    CHECK_THAT(closed(scope, "x/z"), Catch::Contains("division by zero"));
    CHECK_THAT(closed(scope, "f(z)"), Catch::Contains("division by zero"));
}

TEST_CASE("definitions that double at each level stay shared and are closed at once")
{
    Scope scope = scope_of({"x"}, {definition("d0", "sin(x)")});
    for (int k = 1; k <= 60; ++k) scope.define(definition(fmt::format("d{}", k), fmt::format("d{0} + d{0}*x", k - 1)));
    const Tree tree = scope.close(parse("d60"));
    CHECK(names_in(tree) == std::vector<std::string>{"x"});
    CHECK(same_tree(tree, scope.with({"extra"}).close(parse("d60"))));
}

#if !LAGEN_SANITIZED // tests/errors/definitions_expand.toml does the same
TEST_CASE("an expansion without an end in sight is stopped")
{
    Scope scope = scope_of({"x"}, {definition("g0", "q^2", {"q"})});
    for (int k = 1; k <= 40; ++k)
        scope.define(definition(fmt::format("g{}", k), fmt::format("g{0}(q + 1) + g{0}(2*q)", k - 1), {"q"}));
    CHECK_THAT(closed(scope, "g40(x)"), Catch::Contains("the definitions expand to more than 1000000 operations"));
}
#endif

TEST_CASE("chains of definitions are bounded in depth, in whichever order they are closed")
{
    constexpr int links = LAGEN_SANITIZED ? 20'000 : 100'000;
    const auto chain = [](int length, const char* body) {
        Scope scope = scope_of({"x"}, {definition("c0", "x")});
        for (int k = 1; k <= length; ++k)
            scope.define(definition(fmt::format("c{}", k), fmt::format(fmt::runtime(body), k - 1)));
        return scope;
    };
    const Scope fine = chain(1900, "c{} + 1");
    CHECK(names_in(fine.close(parse("c1900"))) == std::vector<std::string>{"x"});
    const Scope backward = chain(links, "c{} + 1");
    CHECK(closed(backward, fmt::format("c{}", links)) ==
          fmt::format("c{}:1:1: error: the definitions used here are nested more than 2000 operations deep\n"
                      "  c{} + 1\n  ^~~~~~\nhint: shorten the chain of definitions",
                      links - 2999, links - 3000));
    CHECK_THAT(error_text([&] { backward.check_definitions(); }),
               Catch::Contains("more than 2000 operations stand inside one another"));
    CHECK_THAT(closed(chain(links, "c{}"), fmt::format("c{}", links)),
               Catch::Contains("nested more than 2000 operations deep"));
}

TEST_CASE("mistakes in definitions that nobody uses are found")
{
    const Scope scope = scope_of({"x"}, {definition("f", "q*y", {"q"})});
    CHECK(error_text([&] { scope.check_definitions(); }) ==
          "f:1:3: error: unknown symbol 'y'\n  q*y\n    ^\nhint: known names are q, x");
    CHECK(error_text([&] { scope_of({"x"}, {definition("f", "q*min(x, 1)", {"q"})}).check_definitions(); }) ==
          "accepted");
}
