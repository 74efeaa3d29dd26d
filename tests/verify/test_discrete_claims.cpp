// SPDX-License-Identifier: GPL-2.0-or-later
/// What the steps of a discrete Lagrangian keep, proved and refuted: momenta of symmetries, Casimirs, and what is none.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

Lines invariants_of(const std::string& text)
{
    Lines lines;
    for (const Check& check : verified_text(text).structure.checks)
        if (check.name == "invariant") lines.push_back(line_of(check));
    return lines;
}

std::string pairs(const std::string& L, const std::string& claims, const std::string& more = "")
{
    return "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = "
           "\"tangent\"\n" +
           more + "[discrete]\nstep = \"h\"\nL = \"" + L + "\"\n[invariants]\n" + claims;
}

const std::string spring = "((x_next - x)^2 + (y_next - y)^2)/(2*h) - h*(x^2 + y^2 + x_next^2 + y_next^2)/4";

} // namespace

TEST_CASE("steps in a central potential keep the angular momentum and no single one")
{
    CHECK(invariants_of(pairs(spring, "spin = \"x*p_v - y*p_u\"\np = \"p_u\"\n")) ==
          Lines{"invariant(spin) proved", "invariant(p) refuted"});
}

TEST_CASE("a free discrete body keeps |mu|^2 and no component, an axis that is a symmetry its own")
{
    const auto body = [](const std::string& J) {
        return "[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n[groupoid]\nkind = \"group\"\ngroup = \"SO(3)\"\n"
               "[discrete]\nstep = \"h\"\nL = \"-(W[1,1] + " +
               J + "*W[2,2] + 3*W[3,3])/h\"\n[invariants]\nsquare = \"p_w1^2 + p_w2^2 + p_w3^2\"\nthird = \"p_w3\"\n";
    };
    CHECK(invariants_of(body("2")) == Lines{"invariant(square) proved", "invariant(third) refuted"});
    CHECK(invariants_of(body("1")) == Lines{"invariant(square) proved", "invariant(third) proved"});
}

TEST_CASE("explicit time moves on by a step, and what is no function of points and momenta stays open")
{
    CHECK(invariants_of(pairs("((x_next - x)^2 + (y_next - y)^2)/(2*h)", "p = \"p_u\"\nway = \"x - t*p_u\"\n"
                                                                         "speed = \"u\"\n")) ==
          Lines{"invariant(p) proved", "invariant(way) proved", "invariant(speed) undecided"});
}

TEST_CASE("a degenerate discrete Lagrangian proves what every arrow keeps, and refutes nothing")
{
    // Motions have y = 0 and keep it; the arrow from y = 2 to y = 4, which no motion has, does not.
    CHECK(invariants_of(pairs("(x_next - x)^2/(2*h) - h*y^2/2", "a = \"y\"\np = \"p_u\"\n")) ==
          Lines{"invariant(a) undecided", "invariant(p) proved"});
}

TEST_CASE(
    "beside [lagrangian] a claim in momenta is decided for its motions and for the steps, one in velocities for the "
    "motions alone")
{
    const std::string L = "[lagrangian]\nL = \"(u^2 + v^2)/2 - (x^2 + y^2)/2\"\n";
    const std::string energy = "H = \"(p_u^2 + p_v^2 + x^2 + y^2)/2\"\n", spin = "spin = \"x*v - y*u\"\n";
    CHECK(invariants_of(pairs(spring, energy + spin, L)) ==
          Lines{"invariant(H) proved", "invariant(spin) proved", "invariant(H, discrete) refuted"});
}
