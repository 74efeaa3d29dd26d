// SPDX-License-Identifier: GPL-2.0-or-later
/// Sections whose complete lift leaves L, H or a discrete L invariant, and such that do not.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

Lines symmetries_of(const std::string& text)
{
    Lines lines;
    for (const Check& check : verified_text(text).structure.checks)
        if (check.name == "symmetry") lines.push_back(line_of(check));
    return lines;
}

std::string flat_plane(const std::string& L, const std::string& symmetry)
{
    return "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta = [\"p\", \"q\"]\n"
           "[algebroid]\nkind = \"tangent\"\n" +
           L + "[symmetries]\ns = { " + symmetry + " }\n";
}

const std::string kepler = "[lagrangian]\nL = \"(u^2 + v^2)/2 + 1/sqrt(x^2 + y^2)\"\n";

std::string top(const std::string& mechanics, const std::string& symmetry)
{
    return "[parameters]\nI1 = 1\nI2 = 2\nI3 = 3\n[base]\ncoordinates = [\"G[1..3]\"]\nconstraints = [\"dot(G, G) - "
           "1\"]\n[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n[groupoid]\nkind = \"action\"\ngroup = \"SO(3)\"\n"
           "action = { G = \"transpose(W)*G\" }\n" +
           mechanics + "[symmetries]\ns = { " + symmetry + " }\n";
}

const std::string vertical = "w1 = \"G[1]\", w2 = \"G[2]\", w3 = \"G[3]\"";
const std::string heavy = "[lagrangian]\nL = \"(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - G[3]\"\n";
const std::string symmetric = "[lagrangian]\nL = \"(I1*(w1^2 + w2^2) + I3*w3^2)/2 - G[3]\"\n";
const std::string discrete_heavy =
    "[discrete]\nstep = \"h\"\nL = \"-(I1*W[1,1] + I2*W[2,2] + I3*W[3,3])/h - h*G[3]\"\n";
const std::string discrete_symmetric =
    "[discrete]\nstep = \"h\"\nL = \"-(I1*(W[1,1] + W[2,2]) + I3*W[3,3])/h - h*G[3]\"\n";

} // namespace

TEST_CASE("Kepler's problem is invariant under rotations and not under translations")
{
    CHECK(symmetries_of(flat_plane(kepler, "u = \"-y\", v = \"x\"")) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(flat_plane(kepler, "u = \"y\", v = \"x\"")) == Lines{"symmetry(s) refuted"});
    CHECK(symmetries_of(flat_plane(kepler, "u = 1")) == Lines{"symmetry(s) refuted"});
}

TEST_CASE("a symmetry whose momentum jumps says where it holds")
{
    const auto where_of = [](const std::string& L, const std::string& symmetry) {
        std::vector<Lines> found;
        for (const Check& check :
             verified_text(flat_plane("[lagrangian]\nL = \"" + L + "\"\n", symmetry)).structure.checks)
            if (check.name == "symmetry") found.push_back(check.where);
        return found.at(0);
    };
    CHECK(where_of("(u^2 + v^2)/2", "u = \"2 + abs(x)/x\"") == Lines{"x != 0"});
    CHECK(where_of("(u^2 + v^2)/2", "u = \"1 + atan2(x, -1) + atan(x)\"") == Lines{"x != 0"});
    CHECK(where_of("(u^2 + v^2)/2 + v*abs(x)/x", "v = 1") == Lines{"x != 0"});
    CHECK(where_of("(u^2 + v^2)/2", "u = \"-y\", v = \"x\"").empty());
}

TEST_CASE("a symmetry of H is one of its L")
{
    const std::string H = "[hamiltonian]\nH = \"(p^2 + q^2)/2 - 1/sqrt(x^2 + y^2)\"\n";
    CHECK(symmetries_of(flat_plane(H, "u = \"-y\", v = \"x\"")) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(flat_plane(H, "v = 1")) == Lines{"symmetry(s) refuted"});
}

TEST_CASE("a heavy top is symmetric about the vertical, whose section depends on the point, and about its own axis")
{
    // The opposite sign of the bracket term would refute the first and not the second.
    CHECK(symmetries_of(top(heavy, vertical)) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(top(heavy, "w3 = 1")) == Lines{"symmetry(s) refuted"});
    CHECK(symmetries_of(top(symmetric, "w3 = 1")) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(top(symmetric, "w1 = 1")) == Lines{"symmetry(s) refuted"});
}

TEST_CASE("the discrete heavy top has the same symmetries")
{
    CHECK(symmetries_of(top(discrete_heavy, vertical)) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(top(discrete_heavy, "w3 = 1")) == Lines{"symmetry(s) refuted"});
    CHECK(symmetries_of(top(discrete_symmetric, "w3 = 1")) == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(top(heavy + discrete_heavy, vertical)) ==
          Lines{"symmetry(s) proved", "symmetry(s, discrete) proved"});
}

TEST_CASE("of a scheme the symmetry of L is decided")
{
    CHECK(symmetries_of(top(heavy + "[discrete]\nstep = \"h\"\nscheme = \"midpoint\"\n", vertical)) ==
          Lines{"symmetry(s) proved"});
}

TEST_CASE("on pairs a rotation turns both points")
{
    const auto pairs = [](const std::string& L, const std::string& symmetry) {
        return symmetries_of("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[groupoid]\n"
                             "kind = \"pair\"\n[discrete]\nstep = \"h\"\nL = \"" +
                             L + "\"\n[symmetries]\ns = { " + symmetry + " }\n");
    };
    const std::string L = "((x_next - x)^2 + (y_next - y)^2)/(2*h) - h*sqrt(1 + x^2 + y^2)";
    CHECK(pairs(L, "u = \"-y\", v = \"x\"") == Lines{"symmetry(s) proved"});
    CHECK(pairs(L, "u = 1") == Lines{"symmetry(s) refuted"});
    // Free motion has translations; its residual has no terms, and is told as proved all the same.
    CHECK(pairs("(x_next - x)^2/(2*h) + (y_next - y)^2/(2*h) + y", "u = 1") == Lines{"symmetry(s) proved"});
}

TEST_CASE("the charge of a particle is the momentum of the circle, continuous and discrete")
{
    const std::string atiyah =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\", \"q\"]\n"
        "[algebroid]\nkind = \"atiyah\"\nalgebra = \"R\"\nconnection = { x = { q = \"-y/2\" }, y "
        "= { q = \"x/2\" } }\n[groupoid]\nkind = \"atiyah\"\ngroup = \"R\"\n";
    const std::string L = "[lagrangian]\nL = \"(u^2 + v^2 + q^2)/2 - (x^2 + y^2)\"\n";
    CHECK(symmetries_of(atiyah + L + "[symmetries]\ns = { q = 1 }\n") == Lines{"symmetry(s) proved"});
    // A rotation with the gauge -A(rotation): (x^2 + y^2)/2 is the rate of the flux.
    const std::string rotation = "u = \"-y\", v = \"x\", q = \"(x^2 + y^2)/2\"";
    CHECK(symmetries_of(atiyah + L + "[symmetries]\ns = { " + rotation + " }\n") == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(atiyah + L + "[symmetries]\ns = { u = \"-y\", v = \"x\" }\n") == Lines{"symmetry(s) refuted"});
    const std::string discrete =
        "[discrete]\nstep = \"h\"\nL = \"((x_next - x)^2 + (y_next - y)^2 + (W[1,2] + (x*y_next "
        "- y*x_next)/2)^2)/(2*h) - h*(x^2 + y^2)\"\n";
    CHECK(symmetries_of(atiyah + discrete + "[symmetries]\ns = { " + rotation + " }\n") == Lines{"symmetry(s) proved"});
    CHECK(symmetries_of(atiyah + discrete + "[symmetries]\ns = { u = \"-y\", v = \"x\" }\n") ==
          Lines{"symmetry(s) refuted"});
}

TEST_CASE("on a group symmetries are constant sections")
{
    const auto body = [](const std::string& L) {
        return symmetries_of(
            "[parameters]\nI1 = 1\nI3 = 2\n[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n[groupoid]\n"
            "kind = \"group\"\ngroup = \"SO(3)\"\n[discrete]\nstep = \"h\"\nL = \"" +
            L + "\"\n[symmetries]\ns = { w3 = 1 }\n");
    };
    CHECK(body("-(I1*(W[1,1] + W[2,2]) + I3*W[3,3])/h") == Lines{"symmetry(s) proved"});
    CHECK(body("-(I1*W[1,1] + I3*W[2,2] + I3*W[3,3])/h") == Lines{"symmetry(s) refuted"});
    // On the group alone: W[1,1]^2 + W[1,2]^2 = 1 - W[1,3]^2, which a rotation about e3 moves.
    CHECK(body("(W[3,1]^2 + W[3,2]^2)*(W[1,3]^2 + W[2,3]^2)/h - W[3,3]") == Lines{"symmetry(s) proved"});
}
