// SPDX-License-Identifier: GPL-2.0-or-later
/// Regularity of discrete Lagrangians on all four kinds of groupoid: Newton's matrix N_ab = <-e_b(F^-L_a).
#include "geometry/reference_models.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Kind = Regularity::Kind;
using Lines = std::vector<std::string>;

namespace {

Regularity regularity(const std::string& model)
{
    return verify(read_model_text("test.toml", "name = \"test\"\n" + model)).mechanics.discrete;
}

std::string discrete(const std::string& L)
{
    return "[discrete]\nstep = \"h\"\nL = \"" + L + "\"\n";
}

Regularity on_pairs(const std::string& L, const std::string& parameters = "", const std::string& domain = "")
{
    return regularity("[parameters]\n" + parameters + "[base]\ncoordinates = [\"x\", \"y\"]\n" + domain +
                      "[groupoid]\nkind = \"pair\"\n" + discrete(L));
}

Regularity on_group(const std::string& group, const std::string& fibre, const std::string& L)
{
    return regularity("[parameters]\nm = 2\n[fibre]\ncoordinates = [" + fibre + "]\n[groupoid]\nkind = \"group\"\n" +
                      group + "\n" + discrete(L));
}

Regularity on_sphere(const std::string& L)
{
    return regularity("[base]\ncoordinates = [\"G[1..3]\"]\nconstraints = [\"dot(G, G) - 1\"]\n[fibre]\ncoordinates = "
                      "[\"w1\", \"w2\", \"w3\"]\n[groupoid]\nkind = \"action\"\ngroup = \"SO(3)\"\naction = { G = "
                      "\"transpose(W)*G\" }\n" +
                      discrete(L));
}

Regularity of_scheme(const std::string& scheme, const std::string& L)
{
    return regularity("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[groupoid]\nkind = "
                      "\"pair\"\n[lagrangian]\nL = \"" +
                      L + "\"\n[discrete]\nstep = \"h\"\nscheme = \"" + scheme + "\"\n");
}

Lines kernel_of(const Regularity& known)
{
    Lines lines;
    for (const auto& vector : known.kernel) {
        std::string line;
        for (const auto& [name, value] : vector) line += (line.empty() ? "" : ", ") + name + " = " + to_text(value);
        lines.push_back(line);
    }
    return lines;
}

} // namespace

TEST_CASE("the discrete Lagrangians of the reference trajectories are regular")
{
    for (const DiscreteCase& each : discrete_cases()) {
        INFO(each.name);
        const Regularity known = verify(read_model_text(each.name + ".toml", each.model)).mechanics.discrete;
        // A rotation has arrows at which N is singular; the pendulum's N is 1/h.
        CHECK(known.kind == (each.name == "verlet_pendulum" ? Kind::regular : Kind::generically_regular));
        const std::size_t rank = each.name == "verlet_pendulum" ? 1 : each.name == "atiyah_sliding_mass" ? 4 : 3;
        CHECK(known.rank == rank);
        CHECK(known.kernel.empty());
        CHECK(known.of == Regularity::Matrix::newton);
    }
}

TEST_CASE("on pairs N is -d2L/dx_next dx")
{
    const Regularity mixed = on_pairs("(x_next - x)*(y_next - y)/h");
    CHECK(mixed.kind == Kind::regular);
    CHECK(mixed.rank == 2);
    CHECK_FALSE(mixed.for_given_parameters);
    CHECK(on_pairs("m*(x_next - x)^2/h + (y_next - y)^2/h", "m = 2\n").for_given_parameters);
    CHECK_FALSE(
        on_pairs("m*(x_next - x)^2/h + (y_next - y)^2/h", "m = 2\n", "domain = [\"m > 0\"]\n").for_given_parameters);
    const Regularity none = on_pairs("m*(x_next - x)^2/h + (y_next - y)^2/h", "m = 0\n");
    CHECK(none.kind == Kind::generically_regular);
    CHECK(none.singular_everywhere);
}

TEST_CASE("a degenerate L on pairs has the kernel of d2L/dx_next dx, which is not symmetric")
{
    CHECK(kernel_of(on_pairs("(x_next - x + y_next - y)^2/(2*h)")) == Lines{"v_x = -1, v_y = 1"});
    const Regularity shear = on_pairs("x*(x_next + 2*y_next)/h + y^2 + y_next^2");
    CHECK(shear.kind == Kind::degenerate);
    CHECK(shear.rank == 1);
    CHECK(kernel_of(shear) == Lines{"v_x = 1, v_y = -1/2"});
    const Regularity none = on_pairs("x^2 + y_next");
    CHECK(none.kind == Kind::degenerate);
    CHECK(none.rank == 0);
    CHECK(kernel_of(none) == Lines{"v_x = 1", "v_y = 1"});
}

TEST_CASE("a kernel may move with the arrow")
{
    // L depends on the target through r^2 = x_next^2 + y_next^2 and the source alone.
    const Regularity known = on_pairs("(x + y)*(x_next^2 + y_next^2)/h");
    CHECK(known.kind == Kind::degenerate);
    CHECK(known.rank == 1);
    CHECK(kernel_of(known) == Lines{"v_x = 1, v_y = -x_next/y_next"});
}

TEST_CASE("where L is not regular at single pairs, they are named")
{
    const Regularity known = on_pairs("x*(x_next - x)^2/(2*h) + (y_next - y)^2/(2*h)");
    CHECK(known.kind == Kind::generically_regular);
    CHECK(known.singular_where == Lines{"2*x/h - x_next/h"});
    // x = 0 is such a point with x_next = 0 alone: no slice on which one coordinate is zero is singular.
    CHECK(known.singular_at.empty());
    const Regularity slice = on_pairs("x^2*x_next/h + y*y_next/h");
    REQUIRE(slice.singular_at.size() == 1);
    CHECK(slice.singular_at[0][0].first == "x");
    CHECK(to_text(slice.singular_at[0][0].second) == "0");
}

TEST_CASE("that almost all pairs are regular is said where it is shown")
{
    const Regularity known = on_pairs("(abs(x) + x)*x_next/h + y*y_next/h");
    CHECK(known.kind == Kind::undecided);
    CHECK(known.evidence == "N is regular at an arrow; that it is so at almost all is not shown");
    // 0 on one half of the domain and not on the other: the rank is that of the point that was met.
    CHECK(on_pairs("(abs(x) - x)*x_next/h + y*y_next/h").kind == Kind::undecided);
}

TEST_CASE("on groups N is found at elements of the group")
{
    CHECK(on_group("group = \"SO(3)\"", "\"w1\", \"w2\", \"w3\"", "-(W[1,1] + W[2,2] + W[3,3])/h").rank == 3);
    const Regularity axis = on_group("group = \"SO(3)\"", "\"w1\", \"w2\", \"w3\"", "W[3,3]/h");
    CHECK(axis.kind == Kind::degenerate);
    CHECK(axis.rank == 2);
    CHECK(kernel_of(axis) == Lines{"w3 = 1"});
    // The first entries of W W^T and W^T W are 1 on the group, and not on other matrices.
    const Regularity constant = on_group("group = \"SO(3)\"", "\"w1\", \"w2\", \"w3\"",
                                         "(W[1,1]^2 + W[1,2]^2 + W[1,3]^2)*(W[1,1]^2 + W[2,1]^2 + W[3,1]^2)/h");
    CHECK(constant.kind == Kind::degenerate);
    CHECK(constant.rank == 0);
    CHECK(kernel_of(constant).size() == 3);
    CHECK(constant.coordinates == "W = cay(s(c) E_c) with the generators E_c of the group");
}

TEST_CASE("on an abelian group N is the Hessian, and regular everywhere")
{
    const Regularity known = on_group("group = \"R^2\"", "\"u\", \"v\"", "(m^2 + 1)*(W[1,3]^2 + W[1,3]*W[2,3])/h");
    CHECK(known.kind == Kind::regular);
    CHECK(known.rank == 2);
}

TEST_CASE("of a group without a Cayley map nothing is said")
{
    const Regularity known = on_group("generators = [[[1, 0], [0, 2]]]", "\"u\"", "W[1,1]^2/h");
    CHECK(known.kind == Kind::undecided);
    CHECK(known.evidence ==
          "arrows are made by Cayley's map, which does not lead into this group or is not shown to, or has larger "
          "matrices than are computed with");
}

TEST_CASE("on an action groupoid L may be regular or not")
{
    CHECK(on_sphere("-trace(W)/h - h*G[3]").kind == Kind::generically_regular);
    const Regularity axis = on_sphere("W[3,3]/h - h*G[3]");
    CHECK(axis.kind == Kind::degenerate);
    CHECK(axis.rank == 2);
    CHECK(kernel_of(axis) == Lines{"w3 = 1"});
    // A function of both ends alone does not see rotations about the target.
    const Regularity ends = on_sphere("dot(G, transpose(W)*G)/h");
    CHECK(ends.kind == Kind::degenerate);
    CHECK(ends.rank == 2);
}

TEST_CASE("on an Atiyah groupoid L may be regular or not")
{
    const auto on_atiyah = [](const std::string& L) {
        return regularity("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\", \"q\"]\n[algebroid]\nkind = "
                          "\"atiyah\"\nalgebra = \"R\"\nconnection = { x = { q = \"sin(x)\" } }\n[groupoid]\nkind = "
                          "\"atiyah\"\ngroup = \"R\"\n" +
                          discrete(L));
    };
    const Regularity known = on_atiyah("(x_next - x)^2/(2*h) + W[1,2]^2/(2*h)");
    CHECK(known.kind == Kind::regular);
    CHECK(known.rank == 2);
    // W[1,2] + A(x_next) - A(x) with dA = sin: along <-e_v = d/dx_next - sin(x_next) W E it does not change.
    const Regularity moved = on_atiyah("(W[1,2] - cos(x_next) + cos(x))^2/h");
    CHECK(moved.kind == Kind::degenerate);
    CHECK(moved.rank == 1);
    CHECK(kernel_of(moved) == Lines{"v = 1"});
}

TEST_CASE("a scheme makes a degenerate discrete Lagrangian of a degenerate one, and a regular one of a regular one")
{
    for (const char* scheme : {"left", "trapezoidal", "midpoint", "gauss:2", "lobatto:3"}) {
        INFO(scheme);
        const Regularity good = of_scheme(scheme, "(u^2 + v^2)/2 - cos(x)*y");
        CHECK((good.kind == Kind::regular || good.kind == Kind::generically_regular));
        CHECK(good.rank == 2);
        const Regularity bad = of_scheme(scheme, "(u + v)^2/2 - (x + y)^4");
        CHECK(bad.kind == Kind::degenerate);
        CHECK(bad.rank == 1);
    }
    CHECK(kernel_of(of_scheme("midpoint", "(u + v)^2/2 - cos(x + y)")) == Lines{"u = -1, v = 1"});
}
