// SPDX-License-Identifier: GPL-2.0-or-later
/// Regularity of d2L/dy2: rank, definiteness and singular points.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Kind = Regularity::Kind;

namespace {

Regularity regularity(const std::string& lagrangian, const std::string& parameters = "", const std::string& domain = "")
{
    return verified_text(
               "[parameters]\n" + parameters + "[base]\ncoordinates = [\"x\", \"y\"]\n" + domain +
               "[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" +
               lagrangian + "\"\n")
        .mechanics.regularity;
}

} // namespace

TEST_CASE("a constant positive mass matrix is regular and positive definite everywhere")
{
    const Regularity result = regularity("u^2 + u*v + v^2");
    CHECK(result.kind == Kind::regular);
    CHECK(result.rank == 2);
    CHECK(result.positive_definite);
    CHECK_FALSE(result.for_given_parameters);
}

TEST_CASE("L = u v is regular and not definite")
{
    const Regularity result = regularity("u*v");
    CHECK(result.kind == Kind::regular);
    CHECK_FALSE(result.positive_definite);
}

TEST_CASE("a mass without a sign is positive by its value, with a domain for all values")
{
    const Regularity given = regularity("m*(u^2 + v^2)/2", "m = 3\n");
    CHECK(given.kind == Kind::regular);
    CHECK(given.positive_definite);
    CHECK(given.for_given_parameters);
    const Regularity declared = regularity("m*(u^2 + v^2)/2", "m = 3\n", "domain = [\"m > 0\"]\n");
    CHECK(declared.positive_definite);
    CHECK_FALSE(declared.for_given_parameters);
}

TEST_CASE("a witness stands for almost all points of analytic functions alone")
{
    // Zero on a half line, or everywhere: the two factors are nonzero on different sides.
    for (const char* L : {"(abs(x) + x)*u^2/2 + (abs(x) - x)*v^2/2", "(abs(x) + x)*u^2/2 + v^2/2",
                          "(sqrt(x^2) + x)*u^2/2 + v^2/2", "(acos(cos(x)) - x)*u^2/2 + v^2/2",
                          "(atan(1/x) + atan(x) - pi/2)*u^2/2 + v^2/2", "sqrt(sqrt(x^4 + x^2) - abs(x))*u^2 + v^2"}) {
        INFO(L);
        const Regularity result = regularity(L);
        CHECK(result.kind == Kind::undecided);
        CHECK(result.evidence ==
              "each block of W is regular at a point; that all are so almost everywhere is not shown");
    }
    for (const char* L : {"abs(x)*u^2/2 + v^2/2", "(sqrt(1 + x^2) - 1)*u^2 + v^2", "x*sqrt(1 - u^2 - v^2)",
                          "x*atan(x)*u^2 + v^2", "sqrt(sqrt(x^4) + x^2)*u^2 + v^2", "(log(1 + x^2) + x)*u^2 + v^2",
                          "tan(x)*u^2 + v^2/x", "sqrt(x)*u^2 + sqrt(y)*v^2", "(sqrt(x) - sqrt(y))*u^2 + v^2"}) {
        INFO(L);
        CHECK(regularity(L).kind == Kind::generically_regular);
    }
    CHECK(regularity("log(x)*u^2 + v^2").kind == Kind::generically_regular);
    CHECK(regularity("log(x^2 - 1)*u^2 + v^2").kind == Kind::undecided);
    CHECK(regularity("log(x)*u^2 + v^2", "", "domain = [\"x > 0\"]\n").kind == Kind::generically_regular);
    CHECK(regularity("log(x^2)*u^2 + v^2", "", "domain = [\"x != 0\"]\n").kind == Kind::undecided);
}

TEST_CASE("a witness on one part of the constraint set does not stand for the others")
{
    const auto constrained = [](const char* L, const char* constraint) {
        return regularity(L, "", std::string("constraints = [\"") + constraint + "\"]\n").kind;
    };
    for (const char* parts : {"x^2 - 1", "x*y", "x^2 - y^2", "(x - 1)*y - 1", "x^2 - y^3"}) {
        INFO(parts);
        CHECK(constrained("(x - 1)*u^2/2 + v^2/2", parts) == Kind::undecided);
        CHECK(constrained("u*u^2 + v^2", parts) == Kind::generically_regular);
    }
    for (const char* quadric : {"x^2 + y^2 - 1", "x^2 - 2*y^2 - 3"}) {
        INFO(quadric);
        CHECK(constrained("(x - 1)*u^2/2 + v^2/2", quadric) == Kind::generically_regular);
    }
    // Regular for almost all a, and for none of the points x < 0 with the value of the file.
    const Regularity given = regularity("(a*x + abs(x))*u^2/2 + v^2/2", "a = 1\n");
    CHECK(given.kind == Kind::undecided);
    CHECK(given.evidence ==
          "each block of W is regular at a point; that all are so almost everywhere is not shown for the "
          "parameter values of the file");
    CHECK(regularity("(a*x + abs(x))*u^2/2 + v^2/2", "a = 2\n").kind == Kind::generically_regular);
}

TEST_CASE("a mass matrix that is singular for the values of the file alone says so")
{
    const Regularity absent = regularity("(m*u^2 + v^2)/2", "m = 0\n");
    CHECK(absent.kind == Kind::generically_regular);
    CHECK(absent.singular_everywhere);
    CHECK(absent.singular_at.empty());
    CHECK(absent.singular_where == std::vector<std::string>{"m"});
    CHECK(regularity("(u^2 + v^2)/2 + m*u*v*(sin(x)^2 + cos(x)^2)", "m = 1\n").singular_everywhere);
    CHECK_FALSE(regularity("(m*x^2*u^2 + v^2)/2", "m = 1\n").singular_everywhere);
}

TEST_CASE("a rank that drops on a line is generic, and the line is met")
{
    const Regularity result = regularity("(u^2 + sin(x)^2*v^2)/2");
    CHECK(result.kind == Kind::generically_regular);
    CHECK(result.rank == 2);
    CHECK_FALSE(result.positive_definite);
    REQUIRE(result.singular_at.size() == 1);
    CHECK(result.singular_at[0][0] == std::pair<std::string, PointValue>("x", Rational(0)));
    CHECK(result.singular_where == std::vector<std::string>{"sin(x)"});
}

TEST_CASE("where a matrix is singular is told by the factors of its determinant that may vanish")
{
    using Texts = std::vector<std::string>;
    CHECK(regularity("m*(u^2 + l^2*cos(x)^2*v^2)/2", "m = 2\nl = 3\n").singular_where == Texts{"cos(x)"});
    CHECK(regularity("(u^2 + cos(x)^2*(y^2 + 1)*y^4*v^2)/2").singular_where == Texts{"y", "cos(x)"});
    CHECK(regularity("(u^2 + v^2)/2 + x*u*v").singular_where == Texts{"1 - x^2"});
    CHECK(regularity("(cos(x)*u + y*v)^2/2 + (sin(x)*u)^2").singular_where == Texts{"y", "sin(x)"});
    // With a denominator, and where the matrix depends on the velocities.
    CHECK(regularity("(u^2 + x/(y^2 + 1)*v^2)/2").singular_where == Texts{"x"});
    CHECK(regularity("u^2 + v^4").singular_where == Texts{"v"});
    // Everywhere regular, degenerate, or not known for every block: nothing is told.
    CHECK(regularity("u^2 + v^2").singular_where.empty());
    CHECK(regularity("u^2").singular_where.empty());
}

TEST_CASE("a matrix that is regular on all of R^n is definite where it is at the origin")
{
    // A pendulum chain in relative angles; its leading minors are not squares to read off.
    const char* text = R"toml(
[base]
coordinates = ["a", "b", "c"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "tangent"
[definitions]
X1 = "cos(a)*u"
Y1 = "sin(a)*u"
X2 = "X1 + cos(a + b)*(u + v)"
Y2 = "Y1 + sin(a + b)*(u + v)"
X3 = "X2 + cos(a + b + c)*(u + v + w)"
Y3 = "Y2 + sin(a + b + c)*(u + v + w)"
[lagrangian]
L = "(X1^2 + Y1^2 + X2^2 + Y2^2 + X3^2 + Y3^2)/2"
)toml";
    const Regularity chain = verified_text(text).mechanics.regularity;
    CHECK(chain.kind == Kind::regular);
    CHECK(chain.positive_definite);
    CHECK_FALSE(chain.for_given_parameters);
    // Regular on both sides of x = 0 with another signature on each: the domain is not connected.
    const Regularity split = regularity("(u^2 + (x^3 + x)*v^2)/2", "", "domain = [\"x != 0\"]\n");
    CHECK(split.kind == Kind::regular);
    CHECK_FALSE(split.positive_definite);
    CHECK_FALSE(regularity("(u^2 - v^2)/2 + sin(x)*u*v").positive_definite);
    CHECK_FALSE(regularity("(u^2 + v^2/x)/2").positive_definite);
}

TEST_CASE("points outside the domain are not singular points of the model")
{
    CHECK(regularity("(u^2 + x^2*v^2)/2").singular_at.size() == 1);
    CHECK(regularity("(u^2 + x^2*v^2)/2", "", "domain = [\"x > 0\"]\n").kind == Kind::regular);
    CHECK(regularity("(u^2 + x^2*v^2)/2 - 1/x").singular_at.empty());
}

TEST_CASE("where a root or a logarithm of the Lagrangian is undefined there are no singular points")
{
    CHECK(regularity("(u^2 + x^2*v^2)/2 + sqrt(y + 1 - x^2)").singular_at.size() == 1);
    CHECK(regularity("(u^2 + x^2*v^2)/2 + sqrt(x^2 - y^2 - 1)*y").singular_at.empty());
    CHECK(regularity("(u^2 + x*v^2)/2 + log(x - 1)").kind == Kind::regular);
}

TEST_CASE("singular points are found on a constraint too")
{
    const std::string circle = "constraints = [\"x^2 + y^2 - 1\"]\n";
    const Regularity result = regularity("(u^2 + (1 - y^2)*v^2)/2", "", circle);
    CHECK(result.kind == Kind::generically_regular);
    REQUIRE(result.singular_at.size() == 1);
    CHECK(result.singular_at[0][0] == std::pair<std::string, PointValue>("x", Rational(0)));
    CHECK(result.singular_at[0][1] == std::pair<std::string, PointValue>("y", Rational(1)));
}

TEST_CASE("degenerate Lagrangians have their generic rank")
{
    CHECK(regularity("(u + v)^2").kind == Kind::degenerate);
    CHECK(regularity("(u + v)^2").rank == 1);
    CHECK(regularity("u*x - v*y").rank == 0);
    CHECK(regularity("(sin(x)*u + cos(x)*v)^2/2").kind == Kind::degenerate);
}

namespace {

/// L on R^10 with `diagonal` y_a^2 + `coupling` y_a y_(a+1).
Regularity chain_of_ten(const std::string& diagonal, const std::string& coupling, const std::string& parameters = "")
{
    std::string coordinates;
    std::string lagrangian;
    for (int a = 0; a < 10; ++a) {
        const std::string y = "y" + std::to_string(a);
        coordinates += (a == 0 ? "\"" : ", \"") + y + "\"";
        lagrangian += (a == 0 ? "" : " + ") + diagonal + "*" + y + "^2";
        if (a > 0) lagrangian += " + " + coupling + "*y" + std::to_string(a - 1) + "*" + y;
    }
    return verified_text(parameters + "[fibre]\ncoordinates = [" + coordinates +
                         "]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"R^10\"\n[lagrangian]\nL = \"" +
                         lagrangian + "\"\n")
        .mechanics.regularity;
}

} // namespace

TEST_CASE("a constant mass matrix of any size is decided by elimination")
{
    const Regularity definite = chain_of_ten("1", "1");
    CHECK(definite.kind == Kind::regular);
    CHECK(definite.rank == 10);
    CHECK(definite.positive_definite);
    CHECK_FALSE(definite.for_given_parameters);
    const Regularity indefinite = chain_of_ten("1", "2");
    CHECK(indefinite.kind == Kind::regular);
    CHECK_FALSE(indefinite.positive_definite);
    CHECK(chain_of_ten("0", "1").kind == Kind::regular);
    CHECK(chain_of_ten("0", "0").kind == Kind::degenerate);
}

TEST_CASE("a large mass matrix with parameters is definite at the values of the file")
{
    const Regularity given = chain_of_ten("m", "1", "[parameters]\nm = 1\n");
    CHECK(given.kind == Kind::regular);
    CHECK(given.rank == 10);
    CHECK(given.positive_definite);
    CHECK(given.for_given_parameters);
}

TEST_CASE("a large mass matrix that depends on the state is regular where it is known to be")
{
    const Regularity result = chain_of_ten("(1 + y0^2)", "1");
    CHECK(result.kind == Kind::generically_regular);
    CHECK(result.singular_where.empty());
    CHECK(result.rank == 10);
}

TEST_CASE("H = p.X is told from a degenerate Hamiltonian: it makes a first-order system")
{
    const auto of = [](const char* H) {
        return verified_text(std::string("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\nmomenta = [\"p\", \"q\"]\n"
                                         "[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"") +
                             H + "\"\n")
            .mechanics.regularity;
    };
    CHECK(of("p*sin(y) - q*x + x^2").is_first_order());
    CHECK_FALSE(of("p^2/2 - q*x").is_first_order());
    CHECK_FALSE(of("(p^2 + q^2)/2").is_first_order());
}
