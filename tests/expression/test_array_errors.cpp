// SPDX-License-Identifier: GPL-2.0-or-later
/// What misused arrays and sums get: one sentence, the place, a hint.
#include "closing.hpp"
#include "parsing.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

TEST_CASE("brackets must balance and hold something")
{
    CHECK(error_of("a*[b, c") == "e:1:3: error: '[' is never closed\n"
                                 "  a*[b, c\n"
                                 "    ^\n"
                                 "hint: every '[' needs a ']' after it");
    CHECK(error_of("a + b]") == "e:1:6: error: ']' closes no bracket\n"
                                "  a + b]\n"
                                "       ^\n"
                                "hint: every ']' needs a '[' before it");
    CHECK(error_of("x[]") == "e:1:2: error: the brackets are empty\n"
                             "  x[]\n"
                             "   ^~\n"
                             "hint: an index, counted from 1, stands in them");
    CHECK(sentence_of("[]") == "the brackets are empty");
    CHECK(sentence_of("[a b]") == "missing operator between 'a' and 'b'");
    CHECK(sentence_of("[a)") == "')' stands where ',' or ']' is required");
    CHECK(sentence_of("(a]") == "']' stands where ')' is required");
    CHECK(sentence_of("2[1]") == "missing operator between '2' and '['");
    CHECK(sentence_of("[a < b]") == "a comparison stands where a value is required");
    CHECK(sentence_of(std::string(300, '[')) ==
          "parentheses, calls, signs and exponents are nested more than 256 deep");
}

TEST_CASE("an entry of a matrix has its two indices in one pair of brackets")
{
    CHECK(error_of("W[2][1]") == "e:1:5: error: an index follows an index\n"
                                 "  W[2][1]\n"
                                 "      ^\n"
                                 "hint: the entry of a matrix is written W[2,..]");
    CHECK(error_of("W[1,2,3]") == "e:1:1: error: an entry has one or two indices, and 3 are given\n"
                                  "  W[1,2,3]\n"
                                  "  ^~~~~~~~\n"
                                  "hint: a vector's entry is written x[1], a matrix's W[1,2], its second row W[2,:]");
}

TEST_CASE("sum and product take an index, two bounds and a body")
{
    CHECK(error_of("1 + sum(x)") == "e:1:5: error: sum takes 4 arguments, and 1 is given\n"
                                    "  1 + sum(x)\n"
                                    "      ^~~~~~\n"
                                    "hint: sum(i, 1, n, x[i]) is x[1] + x[2] + ... + x[n]");
    CHECK(sentence_of("product()") == "product takes 4 arguments, and 0 are given");
    CHECK(error_of("product(2, 1, 3, a)") == "e:1:9: error: the first argument of product is not the name of an index\n"
                                             "  product(2, 1, 3, a)\n"
                                             "          ^\n"
                                             "hint: product(i, 1, n, x[i]) is x[1]*x[2]*...*x[n]");
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "sum(i, 1, a, x[i])") ==
          "e:1:11: error: the upper bound 'a' of a sum is not an integer constant\n"
          "  sum(i, 1, a, x[i])\n"
          "            ^\n"
          "hint: a bound is made of integers, sizes, and the indices of outer sums and products");
    CHECK(closing_error(scope, "product(i, 1/2, 2, x[i])") ==
          "the lower bound '1/2' of a product is not an integer constant");
    CHECK(closing_error(scope, "sum(i, i, 2, x[i])") == "unknown symbol 'i'");
    CHECK(closed_text(scope, "sum(i, 1, n, x[i + 1])") == "e:1:16: error: the index 5 of 'x' is outside 1..4\n"
                                                          "  sum(i, 1, n, x[i + 1])\n"
                                                          "                 ^~~~~\n"
                                                          "hint: 'i + 1' is 5 here");
}

TEST_CASE("an index is an integer constant within the range of its family")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "2*x[0]") == "e:1:5: error: the index 0 of 'x' is outside 1..4\n"
                                          "  2*x[0]\n"
                                          "      ^");
    CHECK(closed_text(scope, "R[1, 4]") == "e:1:6: error: the column 4 of 'R' is outside 1..3\n"
                                           "  R[1, 4]\n"
                                           "       ^");
    CHECK(closing_error(scope, "R[n, 1]") == "the row 4 of 'R' is outside 1..2");
    CHECK(closed_text(scope, "x[1/2]") ==
          "e:1:3: error: the index '1/2' is not an integer constant\n"
          "  x[1/2]\n"
          "    ^~~\n"
          "hint: an index is made of integers, sizes, and the indices of sum and product");
    CHECK(closing_error(scope, "x[a]") == "the index 'a' is not an integer constant");
    CHECK(closing_error(scope, "x[u]") == "an index is a vector of 3");
    CHECK(closing_error(scope, "x[1e300]") == "the index '1e300' is not an integer constant");
    CHECK(closed_text(scope, "a[1]") == "e:1:1: error: 'a' is a scalar and has no entries\n"
                                        "  a[1]\n"
                                        "  ^~~~");
    CHECK(closed_text(scope, "M[1]") == "e:1:1: error: 'M' is a 2 x 2 matrix and takes two indices, and one is given\n"
                                        "  M[1]\n"
                                        "  ^~~~\n"
                                        "hint: its first entry is written with [1,1], its first row with [1,:]");
    CHECK(closing_error(scope, "x[1, 2]") == "'x' is a vector of 4 and takes one index, and two are given");
    CHECK(closing_error(scope, "y[1]") == "unknown symbol 'y'");
}

TEST_CASE("shapes that do not fit are named, both of them")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "u + p - v") == "e:1:5: error: a vector of 2 is added to a vector of 3\n"
                                             "  u + p - v\n"
                                             "      ^\n"
                                             "hint: the terms of a sum have the same shape");
    CHECK(closed_text(scope, "a*R*p") ==
          "e:1:1: error: a 2 x 3 matrix is multiplied by a vector of 2\n"
          "  a*R*p\n"
          "  ^~~~~\n"
          "hint: a matrix with n columns multiplies a vector of n or a matrix with n rows");
    CHECK_THAT(closed_text(scope, "u*v"),
               Catch::Contains("a vector of 3 is multiplied by a vector of 3") &&
                   Catch::EndsWith("hint: the scalar product is written dot(a, b), the vector product cross(a, b)"));
    CHECK_THAT(closed_text(scope, "u*A"),
               Catch::Contains("a vector of 3 is multiplied by a 3 x 3 matrix") &&
                   Catch::EndsWith("hint: a vector is a column: write transpose(A)*v, or dot(v, A*w) for v^T A w"));
    CHECK_THAT(closed_text(scope, "a/M"), Catch::Contains("a scalar is divided by a 2 x 2 matrix") &&
                                              Catch::EndsWith("hint: A^-1 b is written inverse(A)*b"));
    CHECK(closing_error(scope, "u/v") == "a vector of 3 is divided by a vector of 3");
    CHECK_THAT(closed_text(scope, "u^2"), Catch::Contains("a power of a vector of 3 is not defined") &&
                                              Catch::EndsWith("hint: |v|^2 is written dot(v, v)"));
    CHECK(closing_error(scope, "R^2") == "a power of a 2 x 3 matrix is not defined");
    CHECK(closing_error(scope, "a^u") == "an exponent is a vector of 3");
    CHECK(closing_error(scope, "A^a") == "the exponent of a matrix is not an integer from -64 to 64");
    CHECK(closing_error(scope, "A^(16*n + 1)") == "the exponent of a matrix is not an integer from -64 to 64");
    CHECK(closing_error(scope, "[u, a]") == "a scalar stands beside a vector of 3");
    CHECK(closing_error(scope, "[A, A]") == "an entry is a 3 x 3 matrix");
    CHECK(closed_text(scope, "[[1, 2, 3], [4, 5]]") == "e:1:13: error: row 2 has length 2, and row 1 has length 3\n"
                                                       "  [[1, 2, 3], [4, 5]]\n"
                                                       "              ^~~~~~\n"
                                                       "hint: the rows of a matrix have the same length");
}

TEST_CASE("a vector is no scalar")
{
    const Scope scope = array_scope();
    const auto scalar_error = [&](const char* text) {
        try {
            (void)scope.close(parse(text));
        } catch (const ModelError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK(scalar_error("2*u") == "e:1:1: error: a vector of 3 stands where a scalar is required\n"
                                 "  2*u\n"
                                 "  ^~~\n"
                                 "hint: an entry is written x[1], a norm norm(x)");
    CHECK(scalar_error("A*B") == "e:1:1: error: a 3 x 3 matrix stands where a scalar is required\n"
                                 "  A*B\n"
                                 "  ^~~\n"
                                 "hint: an entry is written W[1,2]");
}

TEST_CASE("each function names what it takes")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "sin([a, b])") == "e:1:5: error: an argument of sin is a vector of 2\n"
                                               "  sin([a, b])\n"
                                               "      ^~~~~~\n"
                                               "hint: sin takes a scalar");
    CHECK_THAT(closed_text(scope, "atan2(a, u)"), Catch::Contains("an argument of atan2 is a vector of 3") &&
                                                      Catch::EndsWith("hint: atan2 takes scalars"));
    CHECK_THAT(closed_text(scope, "dot(u, a)"),
               Catch::Contains("an argument of dot is a scalar") && Catch::EndsWith("hint: dot takes two vectors"));
    CHECK(closing_error(scope, "dot(u, p)") == "dot is taken of a vector of 3 and a vector of 2");
    CHECK(closing_error(scope, "cross(p, p)") == "an argument of cross is a vector of 2");
    CHECK(closing_error(scope, "norm(A)") == "an argument of norm is a 3 x 3 matrix");
    CHECK(closing_error(scope, "trace(R)") == "an argument of trace is a 2 x 3 matrix");
    CHECK(closing_error(scope, "transpose(a)") == "an argument of transpose is a scalar");
    CHECK(closing_error(scope, "det(R)") == "an argument of det is a 2 x 3 matrix");
    CHECK_THAT(closed_text(scope, "det(identity(9))"),
               Catch::Contains("the determinant of a 9 x 9 matrix is too large") &&
                   Catch::EndsWith("hint: a determinant is written out up to 8 x 8"));
    CHECK(closing_error(scope, "inverse(R)") == "the inverse of a 2 x 3 matrix is not defined");
    CHECK(closing_error(scope, "diag(a, u)") == "an argument of diag is a vector of 3");
    CHECK(closing_error(scope, "diag(A)") == "an argument of diag is a 3 x 3 matrix");
    CHECK(closing_error(scope, "identity(a)") == "the argument of identity is not a positive integer constant");
    CHECK(closing_error(scope, "hat(p)") == "an argument of hat is a vector of 2");
    CHECK(closing_error(scope, "vee(A)") == "an argument of vee is a 3 x 3 matrix that is not seen to be skew");
    CHECK_THAT(closed_text(scope, "exp(A)"),
               Catch::Contains("an argument of exp is a 3 x 3 matrix that is not seen to be skew") &&
                   Catch::EndsWith("hint: exp takes a scalar, or a skew matrix, 3 x 3 or 2 x 2, such as hat(v); "
                                   "cay(A) takes any square matrix"));
    CHECK(closing_error(scope, "exp(u)") == "an argument of exp is a vector of 3");
    CHECK(closing_error(scope, "cay(R)") == "an argument of cay is a 2 x 3 matrix");
    CHECK(closing_error(scope, "stumpff(33, a)") == "the first argument of stumpff is not an integer from 0 to 32");
    CHECK(closing_error(scope, "stumpff(a, 2)") == "the first argument of stumpff is not an integer from 0 to 32");
    CHECK(closing_error(scope, "if(u > 0, 1, 2)") == "a vector of 3 is compared");
    CHECK(sentence_of("det(A, B)") == "det takes 1 argument, and 2 are given");
    CHECK(sentence_of("diag()") == "diag takes 1 argument, and 0 are given");
}

TEST_CASE("families and sizes share one space of names with all others")
{
    Scope scope = array_scope();
    const auto error = [&](auto action) {
        try {
            action();
        } catch (const ModelError& refused) {
            return refused.diagnostic().message;
        }
        return std::string("accepted");
    };
    CHECK(error([&] { scope.declare("u", {}); }) == "'u' is declared twice");
    CHECK(error([&] { scope.declare_size("A", 2, {}); }) == "'A' is declared twice");
    CHECK(error([&] { scope.declare_family("a", {Rank::vector, 2, 1}, {}); }) == "'a' is declared twice");
    CHECK(error([&] { scope.define(definition("n", "a")); }) == "'n' is declared twice");
    CHECK(error([&] { scope.define(definition("norm", "q", {"q"})); }) ==
          "'norm' is a built-in function and cannot be defined");
    CHECK(error([&] { scope.declare("stumpff", {}); }) == "'stumpff' is a built-in function and cannot be declared");
    CHECK_THAT(closed_text(scope, "2*y"),
               Catch::EndsWith("hint: known names are n, a, b, c, s, u, v, w, p, A, B, M, R, x"));
}
