// SPDX-License-Identifier: GPL-2.0-or-later
/// diff, grad, jacobian and Dt: closed forms, shapes, what wins, and what is refused.
#include "closing.hpp"
#include "expression/derivative.hpp"
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using namespace lagen::test;

namespace {

/// t, base coordinates a, b and x[1..n] with the rates s, -c*a and u, and a parameter m.
Scope moving_scope()
{
    Scope scope = array_scope(3);
    scope.declare("t", {});
    scope.declare("m", {});
    const auto rate = [&](const std::string& name, const std::string& text) {
        scope.define({rate_name(name), {}, parse(text), {}});
    };
    rate("t", "1");
    rate("m", "0");
    rate("a", "s");
    rate("b", "-c*a");
    return scope;
}

/// The difference quotient of a tree by a symbol.
double quotient(const Tree& tree, Point point, const std::string& symbol)
{
    constexpr double h = 1e-5;
    const double middle = point.at(symbol);
    point[symbol] = middle + h;
    const double above = value_at(tree, point);
    point[symbol] = middle - h;
    return (above - value_at(tree, point)) / (2 * h);
}

} // namespace

TEST_CASE("derivatives are folded by the zeros and ones that they have")
{
    const Scope scope = array_scope();
    CHECK(closed_text(scope, "diff(a, a)") == "1");
    CHECK(closed_text(scope, "diff(a, b)") == "0");
    CHECK(closed_text(scope, "diff(a*b*c, b)") == "a*c");
    CHECK(closed_text(scope, "diff(a^2*b - c, a)") == "2*a*b");
    CHECK(closed_text(scope, "diff(a^3/b, a)") == "3*a^2/b");
    CHECK(closed_text(scope, "diff(b/a, a)") == "-b/a/a");
    CHECK(closed_text(scope, "diff(sin(a*b), a)") == "cos(a*b)*b");
    CHECK(closed_text(scope, "diff(sqrt(a), a)") == "1/(2*sqrt(a))");
    CHECK(closed_text(scope, "diff(a^b, b)") == "a^b*log(a)");
    CHECK(closed_text(scope, "diff(diff(exp(a*b), a), b)") == "exp(a*b)*a*b + exp(a*b)");
    CHECK(closed_text(scope, "diff(x[2]^2 + x[3], x[2])") == "2*x[2]");
    CHECK(closed_text(scope, "sum(i, 1, n, diff(dot(x, x), x[i]))") == "2*x[1] + 2*x[2] + 2*x[3] + 2*x[4]");
}

TEST_CASE("every function has the derivative that its difference quotient has")
{
    const Scope scope = array_scope();
    const Point point{{"a", 0.37}, {"b", 0.81}, {"c", -0.6}};
    for (const char* text : {"sin(a*b)",
                             "cos(a^2)",
                             "tan(a - c)",
                             "asin(a*c)",
                             "acos(a/2)",
                             "atan(a*b + c)",
                             "atan2(a*b, a - c)",
                             "sinh(a)",
                             "cosh(a*c)",
                             "tanh(a)",
                             "exp(-a^2)",
                             "log(1 + a)",
                             "sqrt(a + b)",
                             "abs(c*a)",
                             "stumpff(0, a*b)",
                             "stumpff(3, a^2)",
                             "erf(a*b)",
                             "a^-3",
                             "a^(1/2)",
                             "(a + b)^a",
                             "1/(1 + 1/a)",
                             "min(a, b)*a",
                             "max(a^2, c)",
                             "if(a < b, a^3, b)",
                             "(inverse([[a + 3, b], [c*a, 2]])*[a, 1])[2]",
                             "inverse([[a + 3, b], [c, a]])[1,2]"}) {
        INFO(text);
        const Tree value = scope.close(parse(text), true);
        const Tree derivative = scope.close(parse("diff(" + std::string(text) + ", a)"), true);
        CHECK(value_at(derivative, point) == Approx(quotient(value, point, "a")).epsilon(1e-7));
    }
}

TEST_CASE("grad has the shape of what it is taken by, jacobian a row for each entry, diff the shape of the function")
{
    const Scope scope = array_scope(3);
    CHECK(closed_text(scope, "grad(a*x[2]^2, x)") == "[0, a*2*x[2], 0]");
    CHECK(closed_text(scope, "grad(a*b, [a, c, b])") == "[b, 0, a]");
    CHECK(closed_text(scope, "grad(det(M), M)") == "[[M[2,2], -M[2,1]], [-M[1,2], M[1,1]]]");
    CHECK(closed_text(scope, "jacobian([a*b, a^2, c], [a, b])") == "[[b, a], [2*a, 0], [0, 0]]");
    CHECK(closed_text(scope, "jacobian(cross(u, v), v)") == "[[0, -u[3], u[2]], [u[3], 0, -u[1]], [-u[2], u[1], 0]]");
    CHECK(closed_text(scope, "diff(a*p, a)") == "[p[1], p[2]]");
    CHECK(closed_text(scope, "diff(M, M[1,2])") == "[[0, 1], [0, 0]]");
}

TEST_CASE("definitions are differentiated by what they depend on, functions at their arguments")
{
    Scope scope = array_scope();
    scope.define(definition("T", "m2*s^2/2"));
    scope.define(definition("m2", "a + b*c"));
    scope.define(definition("V", "q^2/2", {"q"}));
    scope.define(definition("slope", "diff(f, q)", {"f", "q"}));
    CHECK(closed_text(scope, "diff(T, c)") == "b*s^2/2");
    CHECK(closed_text(scope, "diff(V(a - b), b)") == "-2*(a - b)/2");
    CHECK(closed_text(scope, "slope(V(a), a)") == "2*a/2");
    CHECK(closing_error(scope, "slope(V(a), V(a))") == "diff is taken by 'q', which is no symbol");
    CHECK(closing_error(scope, "diff(a, T)") == "diff is taken by 'T', which is no symbol");
    CHECK(closing_error(scope, "diff(a, n)") == "diff is taken by 'n', which is no symbol");
    CHECK(closing_error(scope, "grad(a, [a, a^2])") == "grad is taken by '[a, a^2]', which is no symbol");
    CHECK_NOTHROW(scope.check_definitions());
}

TEST_CASE("functions of the model that are called diff, grad, jacobian or Dt win, symbols stand beside them")
{
    Scope scope = array_scope();
    scope.define(definition("diff", "p1 - p2", {"p1", "p2"}));
    scope.define(definition("Dt", "2*p1", {"p1"}));
    scope.declare("grad", {});
    CHECK(closed_text(scope, "diff(a, b)") == "a - b");
    CHECK(closed_text(scope, "Dt(a)") == "2*a");
    CHECK(closed_text(scope, "grad*grad(a^2, [a])") == "[grad*2*a]");
}

TEST_CASE("Dt is the rate along the motion of scalars, vectors and matrices")
{
    const Scope scope = moving_scope();
    CHECK(closed_text(scope, "Dt(a)") == "s");
    CHECK(closed_text(scope, "Dt(m*a*t)") == "m*t*s + m*a");
    CHECK(closed_text(scope, "Dt([a^2, b, m])") == "[2*a*s, -c*a, 0]");
    CHECK(closed_text(scope, "Dt([[a, b], [0, t]])") == "[[s, -c*a], [0, 1]]");
    CHECK(closing_error(scope, "Dt(Dt(a))") == "Dt is taken of an expression with 's', whose rate is not known here");
    CHECK(closing_error(array_scope(), "Dt(a)") ==
          "Dt is taken of an expression with 'a', whose rate is not known here");
}

TEST_CASE("kinks are differentiated where they may stand, and refused by their names elsewhere")
{
    const Scope scope = array_scope();
    const auto rough = [&](const std::string& text) { return to_text(scope.close(parse(text), true)); };
    CHECK(rough("diff(min(a^2, b), a)") == "if(a^2 <= b, 2*a, 0)");
    CHECK(rough("diff(max(a, b), b)") == "if(a >= b, 0, 1)");
    CHECK(rough("diff(if(a < b, a*c, c), c)") == "if(a < b, a, 1)");
    CHECK(rough("diff(sign(a)*a, a)") == "sign(a)");
    CHECK(rough("diff(abs(a), a)") == "a/abs(a)");
    CHECK(closed_text(scope, "diff(abs(a), a)") == "a/abs(a)");
    CHECK(closing_error(scope, "diff(min(a^2, b), a)") == "the function 'min' is not smooth");
    CHECK(closing_error(scope, "diff(sign(a), a)") == "the function 'sign' is not smooth");
    CHECK(closing_error(scope, "diff(diff(sign(a)*a, b), b)") == "the function 'sign' is not smooth");
}

TEST_CASE("derivatives take what they can, and say what that is")
{
    const Scope scope = array_scope();
    CHECK(closing_error(scope, "diff(a)") == "diff takes 2 arguments, and 1 is given");
    CHECK(closing_error(scope, "Dt(a, b)") == "Dt takes 1 argument, and 2 are given");
    CHECK(closing_error(scope, "diff(a, x)") == "diff is taken by a vector of 4");
    CHECK(closing_error(scope, "grad(x, x)") == "grad is taken of a vector of 4");
    CHECK(closing_error(scope, "grad(a, b)") == "grad is taken by a scalar");
    CHECK(closing_error(scope, "jacobian(a, x)") == "jacobian is taken of a scalar");
    CHECK(closing_error(scope, "jacobian(x, A)") == "jacobian is taken by a 3 x 3 matrix");
    CHECK(closing_error(scope, "diff(stumpff(31, a), a)") == "the derivative of stumpff(31, z) is taken");
    CHECK(closing_error(scope, "dif(a, b)") == "unknown function 'dif'");
}

TEST_CASE("a derivative is walked over once for all symbols, and is bounded like what is written out")
{
    Scope scope;
    scope.declare_family("x", {Rank::vector, 400, 1}, {});
    scope.define(definition("chain", "sum(i, 1, 400, sin(x[i])*sum(j, 1, i, x[j]))"));
    const ArrayValue gradient = scope.close_array(parse("grad(chain, x)"));
    CHECK(gradient.entries.size() == 400);
    CHECK_THAT(closing_error(scope, "sum(i, 1, 400, diff(chain, x[i]) + diff(chain, x[401 - i]))"),
               Catch::Contains("longer than 1000000 operations"));
}

TEST_CASE("a function that is linear as it is written has coefficients, others have none")
{
    const Scope scope = array_scope();
    const auto coefficients = [&](const std::string& text) {
        const auto found = linear_coefficients(scope.close(parse(text)), {"a", "b"});
        std::string out;
        for (const Tree& each : found.value_or(std::vector<Tree>{}))
            out += (out.empty() ? "" : ", ") + (each ? to_text(each) : "-");
        return out;
    };
    CHECK(coefficients("c*a - b*sin(s)/2") == "c, -sin(s)/2");
    CHECK(coefficients("a + 0*s") == "1, -");
    CHECK(coefficients("0") == "-, -");
    CHECK(coefficients("a*b").empty());
    CHECK(coefficients("a + c").empty());
    CHECK(coefficients("sin(a)").empty());
    CHECK(coefficients("a^2/a").empty());
}
