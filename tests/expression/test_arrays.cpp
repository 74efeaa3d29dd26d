// SPDX-License-Identifier: GPL-2.0-or-later
/// Vectors and matrices taken apart: exact texts.
#include "closing.hpp"
#include "expression/derivative.hpp"
#include "expression/lex.hpp"
#include "parsing.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace lagen;
using namespace lagen::test;

TEST_CASE("brackets and indices are parsed as they are written")
{
    CHECK(structure(parse("[a, 2*b]")) == "(array a (multiply 2 b))");
    CHECK(structure(parse("[[a, b], [c, d]]")) == "(array (array a b) (array c d))");
    CHECK(structure(parse("x[i + 1]^2")) == "(power (index x (add i 1)) 2)");
    CHECK(structure(parse("-W[1, j]*f(y)[2]")) == "(multiply (negate (index W 1 j)) (index (apply f y) 2))");
    CHECK(structure(parse("(A*b)[1] + [a, b][k]")) == "(add (index (multiply A b) 1) (index (array a b) k))");
    CHECK(structure(parse("sum(i, 1, n, x[i]) - product(k, 2, 3, k)")) ==
          "(add (sum i 1 n (index x i)) (negate (product k 2 3 k)))");
    CHECK(structure(parse("tr(A) + trace(A)")) == "(add (trace A) (trace A))");
    CHECK(structure(parse("stumpff(2, z)")) == "(stumpff 2 z)");
}

TEST_CASE("a model's own name wins over an array function where no parentheses follow")
{
    Scope scope = array_scope();
    for (const char* name : {"norm", "hat", "sum", "tr"}) scope.declare(name, {});
    scope.define(definition("det", "2*norm"));
    CHECK(closed_text(scope, "norm*hat + det + sum*tr") == "norm*hat + 2*norm + sum*tr");
    CHECK(closed_text(scope, "norm*norm([a, b])") == "norm*sqrt(a^2 + b^2)");
    CHECK(closed_text(scope, "sum(sum, 1, 2, sum)") == "1 + 2");
    CHECK_THAT(closed_text(array_scope(), "2*det"),
               Catch::Contains("the function 'det' stands without arguments") &&
                   Catch::EndsWith("hint: arguments stand in parentheses: det(..)"));
}

TEST_CASE("entries of families are the symbols that entry_name gives them")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "x[3] + A[1, 2]") == "x[3] + A[1,2]");
    CHECK(closed_text(scope, "x[n - 1]*x[2^1]") == "x[3]*x[2]");
    CHECK(closed_text(scope, "u") == "[u[1], u[2], u[3]]");
    CHECK(closed_text(scope, "R") == "[[R[1,1], R[1,2], R[1,3]], [R[2,1], R[2,2], R[2,3]]]");
    const Tree twice = scope.close(parse("x[1]*x[2 - 1]"));
    CHECK(twice->arguments[0] == twice->arguments[1]);
    CHECK(scope.has_symbol("x[4]"));
    CHECK(scope.has_symbol("R[2,3]"));
    for (const char* name :
         {"x[5]", "x[0]", "x[01]", "x[1,1]", "R[3,1]", "R[1]", "x", "n", "x[", "x[]", "[1]", "x[1,]"})
        CHECK_FALSE(scope.has_symbol(name));
    CHECK(closed_text(scope, "n*a") == "4*a");
    CHECK(to_text(scope.close(scope.close(parse("x[3]^2")))) == "x[3]^2"); // closed once more
}

TEST_CASE("arithmetic of shapes is entry by entry, with zeros and ones folded")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "u + v - [1, 0, a]") == "[u[1] + v[1] - 1, u[2] + v[2], u[3] + v[3] - a]");
    CHECK(closed_text(scope, "-2*p") == "[-2*p[1], -2*p[2]]");
    CHECK(closed_text(scope, "a*p*b/c") == "[a*b*p[1]/c, a*b*p[2]/c]");
    CHECK(closed_text(scope, "M*p") == "[M[1,1]*p[1] + M[1,2]*p[2], M[2,1]*p[1] + M[2,2]*p[2]]");
    CHECK(closed_text(scope, "[[1, 2], [0, a]]*[[b, 0], [0, 1]]") == "[[b, 2], [0, a]]");
    CHECK(closed_text(scope, "p*transpose(p)") == "[[p[1]*p[1], p[1]*p[2]], [p[2]*p[1], p[2]*p[2]]]");
    CHECK(closed_text(scope, "[[a, 1], [0, b]]^2") == "[[a*a, a + b], [0, b*b]]");
    CHECK(closed_text(scope, "M^0") == "[[1, 0], [0, 1]]");
    CHECK(closed_text(scope, "[p, [a, b]]") == "[[p[1], p[2]], [a, b]]");
}

TEST_CASE("the functions of vectors and matrices have their textbook entries")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "dot(u, v)") == "u[1]*v[1] + u[2]*v[2] + u[3]*v[3]");
    CHECK(closed_text(scope, "norm(p)") == "sqrt(p[1]^2 + p[2]^2)");
    CHECK(closed_text(scope, "cross([a, 0, 0], [0, b, 0])") == "[0, 0, a*b]");
    CHECK(closed_text(scope, "trace(M) + tr([[a, b], [b, 2]])") == "M[1,1] + M[2,2] + a + 2");
    CHECK(closed_text(scope, "transpose([[a, b, c]])") == "[[a], [b], [c]]");
    CHECK(closed_text(scope, "det(M)") == "M[1,1]*M[2,2] - M[1,2]*M[2,1]");
    CHECK(closed_text(scope, "diag(a, b)") == "[[a, 0], [0, b]]");
    CHECK(closed_text(scope, "diag(p)*identity(n - 2)") == "[[p[1], 0], [0, p[2]]]");
    CHECK(closed_text(scope, "hat([a, b, c])") == "[[0, -c, b], [c, 0, -a], [-b, a, 0]]");
    CHECK(closed_text(scope, "hat(s)") == "[[0, -s], [s, 0]]");
    CHECK(closed_text(scope, "vee(hat(u))") == "[u[1], u[2], u[3]]");
    CHECK(closed_text(scope, "vee(hat(u)*a - hat(v)/2)") == "[a*u[1] - v[1]/2, a*u[2] - v[2]/2, a*u[3] - v[3]/2]");
    CHECK(closed_text(scope, "stumpff(n - 2, a)") == "stumpff(2, a)");
}

TEST_CASE("an inverse is solved with, and its own entries are solves with unit vectors")
{
    const Scope scope = array_scope();
    const Tree solve = scope.close(parse("(inverse(M)*p)[2]"));
    CHECK(structure(solve) == "(solve 1 M[1,1] M[1,2] M[2,1] M[2,2] p[1] p[2])");
    CHECK(to_text(solve) == "(inverse([[M[1,1], M[1,2]], [M[2,1], M[2,2]]])*[p[1], p[2]])[2]");
    CHECK(same_tree(scope.close(parse(to_text(solve))), solve));
    CHECK(same_tree(scope.close(parse("(M^-1*p)[2]")), solve));
    CHECK(structure(scope.close(parse("inverse(M)[1,2]"))) == "(solve 0 M[1,1] M[1,2] M[2,1] M[2,2] 0 1)");
    CHECK(closed_text(scope, "inverse([[a]])") == "[[1/a]]");
    CHECK(closed_text(scope, "inverse([[a]])*[b]") == "[b/a]");
    CHECK(closed_text(scope, "inverse(inverse(M))") == closed_text(scope, "M"));
    Scope named = array_scope();
    named.define(definition("K", "inverse(M)"));
    CHECK(same_tree(named.close(parse("(K*p)[2]")), solve)); // through a definition as well
}

TEST_CASE("rotations are smooth at zero")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "exp(hat([0, a, b]))").find("stumpff(1, a^2 + b^2)*b") != std::string::npos);
    CHECK(closed_text(scope, "exp(hat(s))") == "[[cos(s), -sin(s)], [sin(s), cos(s)]]");
    CHECK(closed_text(scope, "cay(hat(s))") ==
          "[[(1 - s^2/4)/(1 + s^2/4), -s/(1 + s^2/4)], [s/(1 + s^2/4), (1 - s^2/4)/(1 + s^2/4)]]");
    for (const char* text :
         {"exp(hat(a*u))", "exp(a*hat(u))", "exp(-hat(u))", "exp(hat(u) + hat(v)*a)", "exp((A - transpose(A))/2)",
          "exp(hat(u)*hat(v) - hat(v)*hat(u))", "cay(hat(u))", "exp([[0, a - b], [b - a, 0]])"}) {
        INFO(text);
        CHECK_THAT(closed_text(scope, text), Catch::StartsWith("[["));
    }
}

TEST_CASE("entries that are sines of right angles fold like the numbers that they are")
{
    const Scope scope = array_scope();
    const auto by_calls = [&](const std::string& angle) {
        return closed_text(
            scope, fmt::format("[[1, 0, 0], [0, cos({0}), -sin({0})], [0, sin({0}), cos({0})]]*[a, b, c]", angle));
    };
    for (const char* angle : {"-pi/2", "-(pi/2)", "3*pi/2", "pi*(3/2)", "-0.5*pi", "7*pi/2"})
        CHECK(by_calls(angle) == "[a, c, -b]");
    for (const char* angle : {"pi/2", "5*pi/2", "pi/4*2"}) CHECK(by_calls(angle) == "[a, -c, b]");
    for (const char* angle : {"0", "2*pi", "0*pi"}) CHECK(by_calls(angle) == "[a, b, c]");
    CHECK(by_calls("pi") == "[a, -b, -c]");
    CHECK(closed_text(scope, "[sin(pi/6), cos(2*pi/3), tan(pi/4)]") == "[1/2, -1/2, 1]");
    for (const char* call : {"tan(pi/2)", "sin(a*pi)", "cos(1)", "sin(pi^2)", "exp(0)"})
        CHECK(closed_text(scope, call) == call);
}

TEST_CASE("rotations about a constant axis are written by sine and cosine")
{
    const Scope scope = array_scope();
    const char* about_z = "[[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 1]]";
    for (const char* text : {"exp(hat([0, 0, a]))", "exp(a*hat([0, 0, 1]))", "exp(hat([0, 0, 2])*(a/2))",
                             "exp(hat(a*[0, sin(pi), -cos(pi)]))", "exp(-a*hat([0, 0, -1]))"}) {
        INFO(text);
        CHECK(closed_text(scope, text) == about_z);
    }
    for (const char* axis : {"[3/5, 0, 4/5]", "[1, 2, 2]/3", "[1, -1, 0]/sqrt(2)", "[sqrt(3)/2, 0, 1/2]",
                             "[cos(pi/6), 0, sin(-pi/6)]", "[2, 0, 1]", "[1, 1, 1]", "[0, 0.5, 0]"}) {
        INFO(axis);
        const std::string rotation = fmt::format("exp((a - b/3)*hat({}))", axis);
        CHECK(closed_text(scope, rotation).find("stumpff") == std::string::npos);
        // The same by the Stumpff functions of a vector that is no constant where a third symbol is 0.
        const std::string general = fmt::format("exp((a - b/3)*hat({} + [c, s, c*s]))", axis);
        CHECK(closed_text(scope, general).find("stumpff") != std::string::npos);
        const ArrayValue fixed = scope.close_array(parse(rotation)), other = scope.close_array(parse(general));
        const Point point{{"a", 0.7}, {"b", -1.1}, {"c", 0}, {"s", 0}};
        for (std::size_t k = 0; k < 9; ++k)
            CHECK(value_at(fixed.entries[k], point) == Approx(value_at(other.entries[k], point)).margin(1e-15));
    }
}

TEST_CASE("a range of indices picks a vector or a matrix")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "R[2,:]") == "[R[2,1], R[2,2], R[2,3]]");
    CHECK(closed_text(scope, "R[:,1]") == "[R[1,1], R[2,1]]");
    CHECK(closed_text(scope, "R[1..2,2..n - 1]") == "[[R[1,2], R[1,3]], [R[2,2], R[2,3]]]");
    CHECK(closed_text(scope, "R[2..2,:]") == "[[R[2,1], R[2,2], R[2,3]]]");
    CHECK(closed_text(scope, "x[2..3]") == "[x[2], x[3]]");
    CHECK(closed_text(scope, "x[:]") == closed_text(scope, "x"));
    CHECK(closed_text(scope, "dot([a, b, c][2..3], p)") == "b*p[1] + c*p[2]");
    CHECK(closed_text(scope, "dot(A[2,:], A[:,1])") == "A[2,1]*A[1,1] + A[2,2]*A[2,1] + A[2,3]*A[3,1]");
    CHECK(closed_text(scope, "sum(i, 1, 2, dot(x[i..i + 1], p))") == "x[1]*p[1] + x[2]*p[2] + x[2]*p[1] + x[3]*p[2]");
    CHECK(closed_text(scope, "grad(a*A[1,2], A[1,:])") == "[0, a, 0]");
    CHECK(to_text(parse("A[2,:] + A[1..n-1,3]")) == "A[2,:] + A[1..n - 1,3]");
    CHECK(same_tree(parse(to_text(parse("(x[2..n])[1] + A[:,:]"))), parse("(x[2..n])[1] + A[:,:]")));
    Scope functions = array_scope();
    functions.define(definition("tail", "q[2..3]", {"q"}));
    functions.define(definition("head", "q[1..k]", {"q", "k"}));
    functions.check_definitions();
    CHECK(closed_text(functions, "tail(u) + head(v, 2)") == "[u[2] + v[1], u[3] + v[2]]");
}

TEST_CASE("a range that picks nothing is refused where it stands")
{
    const Scope scope = array_scope();
    CHECK(closing_error(scope, "x[3..2]") == "the range '3..2' is empty");
    CHECK(closing_error(scope, "x[2..7]") == "the index 7 of 'x' is outside 1..4");
    CHECK(closing_error(scope, "A[1..a,1]") == "the index 'a' is not an integer constant");
    CHECK(closing_error(scope, "x[u..2]") == "an index is a vector of 3");
    CHECK(closing_error(scope, "A[:]") == "'A' is a 3 x 3 matrix and takes two indices, and one is given");
    CHECK(closing_error(scope, "a[:]") == "'a' is a scalar and has no entries");
}

TEST_CASE("a name is read as equations print it")
{
    Scope scope = array_scope();
    scope.declare("x1", {});
    scope.declare("q", {});
    scope.declare("θ", {});
    for (const char* name : {"q", "x1", "θ", "x[2]"}) {
        scope.declare(std::string("v_") + name, {});
        scope.define({rate_name(name),
                      {},
                      name == std::string("x[2]") ? lagen::name("b") : lagen::name(std::string("v_") + name),
                      {}});
    }
    CHECK(closed_text(scope, "x₁ + x₂ + u₃ + A₁₂") == "x1 + x[2] + u[3] + A[1,2]");
    CHECK(closed_text(scope, "q̇ + ẋ1 + ẋ₁ + 2*θ̇") == "v_q + v_x1 + v_x1 + 2*v_θ");
    CHECK(closed_text(scope, "ẋ₂") == "b");
    CHECK(closing_error(scope, "ẏ") == "unknown symbol 'ẏ'");
    CHECK(closing_error(scope, "q̈") == "unknown symbol 'q̈'");
    CHECK(closing_error(scope, "q²").substr(0, 25) == "unexpected character '²'");
    scope.declare("ẏ", {});
    CHECK(closed_text(scope, "ẏ") == "ẏ"); // what is declared wins
    CHECK_FALSE(is_identifier("x₁"));
    CHECK_FALSE(is_identifier("q̇"));
}

TEST_CASE("definitions and functions may be vectors and matrices")
{
    Scope scope = array_scope();
    scope.define(definition("r", "[a, b]"));
    scope.define(definition("kinetic", "dot(q, J*q)/2", {"q", "J"}));
    scope.define(definition("V", "x[i]^2*i", {"i"}));
    CHECK(closed_text(scope, "2*r") == "[2*a, 2*b]");
    CHECK(closed_text(scope, "r[2]") == "b");
    CHECK(closed_text(scope, "kinetic(r, diag(1, c))") == "(a^2 + b*c*b)/2");
    CHECK(closed_text(scope, "sum(k, 1, 2, V(k))") == "x[1]^2*1 + x[2]^2*2");
    CHECK(closing_error(scope, "V(a)") == "the index 'i' is not an integer constant");
    scope.check_definitions();
    const Tree twice = scope.close(parse("kinetic(p, M)*kinetic(p, M)"));
    CHECK(twice->arguments[0] == twice->arguments[1]);
}

TEST_CASE("a function that nobody uses is checked as far as its arguments' shapes do not matter")
{
    Scope scope = array_scope();
    scope.define(definition("f", "dot(q, q) + sum(i, 1, k, q[i]*zz)", {"q", "k"}));
    try {
        scope.check_definitions();
        FAIL("accepted");
    } catch (const ModelError& error) {
        CHECK(error.diagnostic().message == "unknown symbol 'zz'");
    }
    Scope large = array_scope();
    large.define(definition("f", "q^(250*n)", {"q"}));
    CHECK_THROWS_WITH(large.check_definitions(), Catch::Contains("the exponent 1000 is too large"));
    Scope shapes = array_scope();
    shapes.define(definition("f", "q + (u + p)", {"q"}));
    CHECK_THROWS_WITH(shapes.check_definitions(), Catch::Contains("a vector of 2 is added to a vector of 3"));
}
