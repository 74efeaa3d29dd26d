// SPDX-License-Identifier: GPL-2.0-or-later
/// Declarations of families and the keys of their entries.
#include "closing.hpp"
#include "expression/parse_family.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// "x: a vector of 4", or the error.
std::string declared(const std::string& text, const Scope& scope = array_scope())
{
    try {
        const FamilyDeclaration family = parse_family(whole_text("k", text));
        return family.name + ": " + to_text(close_shape(family, scope));
    } catch (const ModelError& error) {
        return error.what();
    }
}

std::string key(const std::string& text)
{
    try {
        return entry_key(whole_text("k", text), array_scope());
    } catch (const ModelError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("a family is declared by ranges over sizes")
{
    CHECK(declared("x[1..3]") == "x: a vector of 3");
    CHECK(declared(" x [ 1 .. n ] ") == "x: a vector of 4");
    CHECK(declared("θ[1..2*n + 1]") == "θ: a vector of 9");
    CHECK(declared("W[1..n,1..(n - 1)]") == "W: a 4 x 3 matrix");
}

TEST_CASE("a range that is none is refused with how it is written")
{
    CHECK(declared("x[0..3]") == "k:1:3: error: the range '0..3' does not start at 1\n"
                                 "  x[0..3]\n"
                                 "    ^~~~\n"
                                 "hint: a family is declared as x[1..n], or W[1..n,1..m]");
    CHECK(declared("x[3]") == "k:1:3: error: '3' is not a range\n"
                              "  x[3]\n"
                              "    ^\n"
                              "hint: a family is declared as x[1..n], or W[1..n,1..m]");
    CHECK(declared("x[1..0]") == "k:1:6: error: the end of the range is 0\n"
                                 "  x[1..0]\n"
                                 "       ^\n"
                                 "hint: it is 1 at least");
    CHECK(declared("x[1..n/3]") == "k:1:6: error: the end of the range 'n/3' is not an integer constant\n"
                                   "  x[1..n/3]\n"
                                   "       ^~~\n"
                                   "hint: it is made of integers and sizes");
    CHECK_THAT(declared("x[1..a]"), Catch::Contains("the end of the range 'a' is not an integer constant"));
    CHECK_THAT(declared("x[1..z]"), Catch::Contains("unknown symbol 'z'"));
    CHECK_THAT(declared("x[1..3"), Catch::Contains("'[' is never closed"));
    CHECK_THAT(declared("x[1..3]y"), Catch::Contains("'y' follows the brackets"));
    CHECK_THAT(declared("x[1..2,1..2,1..2]"),
               Catch::Contains("has 3 ranges or indices, where one or two are required"));
    CHECK_THAT(declared("2x[1..3]"), Catch::Contains("'2x' is not a name"));
    CHECK_THAT(declared("[1..3]"), Catch::Contains("'' is not a name"));
    CHECK_THAT(declared("x[]"), Catch::Contains("'' is not a range"));
    CHECK_THAT(declared("x[1..]"), Catch::Contains("the expression is empty"));
    CHECK_THAT(declared("W[1..65,1..64]"),
               Catch::Contains("the family 'W' is a 65 x 64 matrix, where at most 4096 entries are allowed"));
    CHECK_THAT(
        declared("x[1..9e18]"),
        Catch::Contains("the family 'x' is a vector of 9000000000000000000, where at most 4096 entries are allowed"));
}

TEST_CASE("a key is the name of an entry without its blanks")
{
    CHECK(key("x[ 3 ]") == "x[3]");
    CHECK(key(" W [ 1 , n - 2 ] ") == "W[1,2]");
    CHECK(key("x") == "x");
    CHECK_THAT(key("x[0]"), Catch::Contains("the index is 0"));
    CHECK_THAT(key("x[a]"), Catch::Contains("the index 'a' is not an integer constant"));
    CHECK_THAT(key("x[1][2]"), Catch::Contains("'[2]' follows the brackets"));
    CHECK_THAT(key("x[[1]"), Catch::Contains("'[' is never closed"));
}
