// SPDX-License-Identifier: GPL-2.0-or-later
/// sum and product written out, and how much of them is shared.
#include "closing.hpp"
#include "parsing.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <chrono>

using namespace lagen;
using namespace lagen::test;

TEST_CASE("sums and products are written out from left to right")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "sum(i, 1, n, x[i])") == "x[1] + x[2] + x[3] + x[4]");
    CHECK(closed_text(scope, "product(i, 2, n, x[i] + i)") == "(x[2] + 2)*(x[3] + 3)*(x[4] + 4)");
    CHECK(closed_text(scope, "sum(i, 3, 3, x[i])") == "x[3]");
    CHECK(closed_text(scope, "sum(i, -1, 1, a^i)") == "a^-1 + a^0 + a^1");
    CHECK(closed_text(scope, "a + sum(i, 5, n, x[i])") == "a + 0");
    CHECK(closed_text(scope, "product(i, 5, n, x[i])") == "1");
    CHECK(closed_text(scope, "sum(i, 1, 2, sum(j, i, 2, x[i]*x[j]))") == "x[1]*x[1] + x[1]*x[2] + x[2]*x[2]");
}

TEST_CASE("an index hides a name of the same spelling in its body alone")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "a*sum(a, 1, 2, a*b) + a") == "a*(1*b + 2*b) + a");
    CHECK(closed_text(scope, "sum(i, 1, 2, i*sum(i, i, 2, x[i]))") == "1*(x[1] + x[2]) + 2*x[2]");
    CHECK(closed_text(scope, "sum(x, 1, 2, x)") == "1 + 2");
    CHECK(closing_error(scope, "sum(i, 1, 2, x[i]) + i") == "unknown symbol 'i'");
    Scope with_function = array_scope();
    with_function.define(definition("f", "sum(i, 1, 2, x[i]*q)", {"q"}));
    CHECK(closed_text(with_function, "sum(i, 1, 2, f(i))") == "x[1]*1 + x[2]*1 + x[1]*2 + x[2]*2");
    Scope hides_pi = array_scope();
    hides_pi.define(definition("f", "sum(i, 1, 2, x[i]*pi)", {"pi"}));
    CHECK(closed_text(hides_pi, "f(a) - f(b)") == "x[1]*a + x[2]*a - (x[1]*b + x[2]*b)");
}

TEST_CASE("vectors are summed, and an empty sum of them is the zero of every shape")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "sum(i, 1, 2, x[i]*p)") == "[x[1]*p[1] + x[2]*p[1], x[1]*p[2] + x[2]*p[2]]");
    CHECK(closed_text(scope, "p + 2*sum(i, 1, 0, x[i]*p)") == "[p[1], p[2]]");
    CHECK(closed_text(scope, "p - sum(i, 1, 0, p)") == "[p[1], p[2]]");
    CHECK(closed_text(scope, "dot(sum(i, 1, 0, p), p)") == "0");
    CHECK(closed_text(scope, "product(i, 1, 2, [[1, i], [0, 1]])") == "[[1, 2 + 1], [0, 1]]");
    CHECK(closing_error(scope, "p + 0") == "a scalar is added to a vector of 2");
}

TEST_CASE("a sum up to i continues the sum up to i - 1")
{
    const Scope scope = array_scope();
    const Tree tree = scope.close(parse("sum(i, 1, 4, sum(j, 1, i, x[j])^2)"));
    const auto partial = [&](std::size_t i) { return tree->arguments[i]->arguments[0]; };
    CHECK(to_text(partial(3)) == "x[1] + x[2] + x[3] + x[4]");
    for (std::size_t i = 1; i < 4; ++i) CHECK(partial(i)->arguments[0] == partial(i - 1));
    CHECK(partial(0) == partial(1)->arguments[0]);
}

TEST_CASE("a chain of 64 links closes at once to a tree of the order of 64 nodes")
{
    Scope scope;
    scope.declare_size("n", 64, {});
    for (const char* family : {"th", "v", "m", "l"}) scope.declare_family(family, {Rank::vector, 64, 1}, {});
    const auto begin = std::chrono::steady_clock::now();
    const Tree tree = scope.close(parse("sum(i, 1, n, m[i]/2*(sum(j, 1, i, l[j]*cos(th[j])*v[j])^2 + "
                                        "sum(j, 1, i, l[j]*sin(th[j])*v[j])^2))"));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    CHECK(size_of(tree).nodes < 64 * 20);
    CHECK(size_of(tree).arguments < 64 * 40);
    CHECK(seconds.count() < 0.2);
}

TEST_CASE("nested sums of a chain longer than trees are high still close")
{
    Scope scope;
    scope.declare_family("x", {Rank::vector, 3000, 1}, {});
    const Tree tree = scope.close(parse("sum(i, 1, 3000, sum(j, 1, i, x[j])^2)"));
    CHECK(tree->arguments.size() == 3000);
    CHECK(size_of(tree).arguments < 40'000);
}

TEST_CASE("the body of a sum is closed once for each value of the indices in it")
{
    const Scope scope = array_scope();
    const Tree tree = scope.close(parse("sum(i, 1, 3, i*sum(j, 1, 3, sin(x[j])))"));
    CHECK(tree->arguments[0]->arguments[1] == tree->arguments[2]->arguments[1]);
    const Tree deep =
        array_scope(99).close(parse("sum(i, 1, n, sum(j, 1, n, sum(k, 1, n, sum(l, 1, n, x[l])))) + sum(i, 1, 9, i)"));
    CHECK(size_of(deep).nodes < 200);
}

TEST_CASE("what is written out is bounded, and the bound is named")
{
    const Scope scope = array_scope();
    CHECK(closing_error(scope, "sum(i, 1, 100001, a)") ==
          "a sum runs from 1 to 100001, where at most 100000 indices are allowed");
    CHECK(closing_error(scope, "sum(i, -9e18, 9e18, a)") ==
          "a sum runs from -9000000000000000000 to 9000000000000000000, where at most 100000 indices are allowed");
    CHECK(closing_error(scope, "identity(65)") == "a 65 x 65 matrix is too large");
    CHECK(closing_error(scope, "identity(9e18)") == "a 9000000000000000000 x 9000000000000000000 matrix is too large");
    CHECK(closed_text(scope, "sum(i, 1, 3, (identity(64)*identity(64))[1,1])") == "1 + 1 + 1");
    // A million allocations each, of which sanitizers need but one series.
    for (const char* long_text :
         {"inverse(identity(60))", "sum(i, 1, 9999, sum(j, 1, 9999, a*i*j))",
          "sum(i, 1, 99999, (i*identity(64)*identity(64))[1,1])", "sum(i, 1, 99999, transpose(i*identity(64))[1,1])"}) {
        CHECK(closing_error(scope, long_text) ==
              "the expression is longer than 1000000 operations when its sums and arrays are written out");
        if (LAGEN_SANITIZED) break;
    }
}

TEST_CASE("sums inside sums stand for a bounded number of terms, however few nodes they are")
{
    const Scope scope = array_scope();
    const std::string beyond = " stands for more than 1000000000 terms when those inside it are written out";
    CHECK(closing_error(scope, "sum(i, 1, 10000, sum(j, 1, 10000, sum(k, 1, 10000, a)))") == "this sum" + beyond);
    CHECK(closing_error(scope, "product(i, 1, 1000, sum(j, 1, 10000, sum(k, 1, 1000, a)))") == "this product" + beyond);
    CHECK(closing_error(scope, "sum(i, 1, 40000, sum(j, 1, 30000, b)^2 + i*a)") == "this sum" + beyond);
    CHECK(closing_error(scope, "sum(i, 1, 1001, [sum(j, 1, 1000, sum(k, 1, 1000, a)), b])[2]") == "this sum" + beyond);
    Scope with_functions = array_scope();
    with_functions.define(definition("f", "sum(i, 1, 100, q^2 + q)", {"q"}));
    with_functions.define(definition("S", "sum(i, 1, 100000, a)", {}));
    CHECK(closing_error(with_functions, "f(f(f(f(f(a)))))") == "this sum" + beyond);
    CHECK(closing_error(with_functions, "sum(i, 1, 100000, S)") == "this sum" + beyond);
    CHECK_NOTHROW(with_functions.close(parse("sum(i, 1, 10000, S)")));
    // Beside one another they add up to what is written out, and that is bounded by its operations.
    CHECK_NOTHROW(scope.close(parse("sum(i, 1, 30000, a) + sum(i, 1, 30000, sum(j, 1, 30000, b))")));
}

TEST_CASE("products that are written out reach the degree of a power and no more")
{
    const Scope scope = array_scope();
    CHECK_NOTHROW(scope.close(parse("product(i, 1, 4096, a)")));
    CHECK(closing_error(scope, "product(i, 1, 4097, a)") == "a product reaches the total degree 4097");
    CHECK(closing_error(scope, "product(i, 1, 100, product(j, 1, 100, a + 1))") ==
          "a product reaches the total degree 10000");
    CHECK(closing_error(scope, "(a^64)^64/(a + b)") == "a quotient reaches the total degree 4097");
    Scope chain = array_scope();
    chain.define(definition("f0", "q + q^2", {"q"}));
    for (int k = 1; k <= 12; ++k)
        chain.define(definition("f" + std::to_string(k),
                                "f" + std::to_string(k - 1) + "(q)*f" + std::to_string(k - 1) + "(q + 1)", {"q"}));
    CHECK_NOTHROW(chain.close(parse("f11(a)")));
    CHECK(closing_error(chain, "f12(a)") == "a product reaches the total degree 8192");
}
