// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce --group`: the file that it writes, its motions beside those of the whole model, and what is refused.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

const std::string beanie_on_tangent = std::string(LAGEN_SOURCE_DIR) + "/models/morphisms/elroys_beanie_unreduced.toml";

/// Left multiplication of the pose (th, x, y) by W^-1.
const std::string motions_of_plane = "th = th - atan2(W[2,1], W[1,1]), x = W[1,1]*(x - W[1,3]) + W[2,1]*(y - W[2,3]), "
                                     "y = W[1,1]*(y - W[2,3]) - W[2,1]*(x - W[1,3])";

/// Two points in space under forces along the sides of the triangle that they make with the origin.
const std::string two_points = R"toml([parameters]
m = 2
k = 0.7
[base]
coordinates = ["a[1..3]", "b[1..3]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*dot(v_a, v_a)/2 + dot(v_b, v_b)/2 - k*dot(a, b)^2/2 - dot(a, a) - 1/sqrt(dot(b, b))"
[invariants]
momentum = "m*(a[1]*v_a[2] - a[2]*v_a[1]) + b[1]*v_b[2] - b[2]*v_b[1]"
square = "dot(m*cross(a, v_a) + cross(b, v_b), m*cross(a, v_a) + cross(b, v_b))"
[observables]
distance = "sqrt(dot(a - b, a - b))"
first = "a[1]"
[scene.default]
initial = { a = [0.9, 0, 0], b = [0.2, 1.1, 0], v_a = [0.1, 0.4, 0.3], v_b = [-0.3, 0.2, 0.5] }
duration = 4
observe = ["distance", "energy", "first", "a[1]*a[1] + dot(b, b)", "sqrt(dot(a, a))"]
)toml";

/// The names and indices of the checks of a report, with those that are not proved marked by "!".
std::vector<std::string> named_checks(const json::Value& report)
{
    std::vector<std::string> lines;
    for (const json::Value& check : report["checks"].entries) {
        std::string line = (check["status"].text == "proved" ? "" : "!") + check["name"].text;
        for (const json::Value& index : check["indices"].entries) line += " " + index.text;
        lines.push_back(line);
    }
    return lines;
}

std::map<std::string, double> end_of(const std::string& model)
{
    return last_columns(finished_run({model, "--tolerance", "1e-13"}));
}

} // namespace

TEST_CASE("Elroy's beanie is reduced by the motions of the plane to an Atiyah algebroid over its shapes", "[run]")
{
    const std::string reduced = fresh_folder() + "/beanie.toml";
    const Outcome outcome = done({"reduce", beanie_on_tangent, "--group", "SE(2)", "--action", motions_of_plane,
                                  "--format", "json", "-o", reduced});
    const json::Value report = json::parse(outcome.out);
    CHECK(report["verdict"].text == "valid");
    CHECK(report["lagrangian"].text == "I1*w1^2/2 + I2*(v_ps + w1)^2/2 + M*(w2^2 + w3^2)/2 + k*(cos(ps) - 1)");
    CHECK(named_checks(report) ==
          std::vector<std::string>{"anchor w1 w2 y", "anchor w1 w3 x", "action w1 th", "action w1 x", "action w1 y",
                                   "action w2 x", "action w3 x", "action w3 y", "symmetry w1", "symmetry w2",
                                   "symmetry w3", "projects v_ps", "projects w1", "projects w2", "projects w3"});
    CHECK(read_text(reduced) == report["file"].text);
    CHECK(
        read_text(reduced) ==
        R"toml(# The quotient of elroys_beanie_unreduced.toml by SE(2), cut by the slice th = 0.3, x = 0, y = 0. A motion is a point of the slice moved
# by g^-1, and w1, w2, w3 are the components of g^-1 g'.

title = "Elroy's beanie on TQ, reduced by SE(2)"

[parameters]
I1 = 1.3
I2 = 0.5
M = 2
k = 0.9

[base]
coordinates = ["ps"]
domain = ["I1 > 0", "I2 > 0", "M > 0"]

[fibre]
coordinates = ["v_ps", "w1", "w2", "w3"]

[algebroid]
kind = "atiyah"
algebra = "se(2)"

[definitions]
th = "0.3"
x = "0"
y = "0"
v_th = "w1"
v_x = "w2"
v_y = "w3"

[lagrangian]
L = "I1*w1^2/2 + I2*(v_ps + w1)^2/2 + M*(w2^2 + w3^2)/2 + k*(cos(ps) - 1)"

[invariants]
spin = "I1*v_th + I2*(v_th + v_ps)"

[scene.default]
initial = { ps = "2/5", v_ps = "6/5", w1 = "0.7", w2 = "1/2", w3 = "-0.3" }
duration = 10
)toml");
    CHECK(call({"check", reduced}).code == 0);
    std::map<std::string, double> whole = end_of(beanie_on_tangent), part = end_of(reduced);
    CHECK(std::abs(whole["ps"] - part["ps"]) < 1e-11);
    CHECK(std::abs(whole["v_th"] - part["w1"]) < 1e-11);
    // The body sees what the whole model has in fixed axes; its pose was 0.3 at the start, where the slice cuts.
    const double turned = whole["th"] - 0.3;
    CHECK(std::abs(std::cos(turned) * whole["v_x"] + std::sin(turned) * whole["v_y"] - part["w2"]) < 1e-11);
    CHECK(std::abs(std::cos(turned) * whole["v_y"] - std::sin(turned) * whole["v_x"] - part["w3"]) < 1e-11);
}

TEST_CASE("two points in space are reduced by rotations: what is not invariant is left out, and motions agree", "[run]")
{
    const std::string whole = written_file("points.toml", two_points), reduced = fresh_folder() + "/reduced.toml";
    const Outcome outcome = call(
        {"reduce", whole, "--group", "SO(3)", "--action", "a = transpose(W)*a, b = transpose(W)*b", "-o", reduced});
    CHECK(outcome.code == 0);
    CHECK(outcome.err ==
          "points: reduced by SO(3): valid\n"
          "  a = [a_1, 0, 0]\n"
          "  b = [b_1, b_2, 0]\n"
          "  v_a = [v_a_1, w3*a_1, -w2*a_1]\n"
          "  v_b = [u_b_1 - w3*b_2, u_b_2 + w3*b_1, w1*b_2 - w2*b_1]\n"
          "  L = m*(a_1^2*w2^2 + a_1^2*w3^2 + v_a_1^2)/2 - k*a_1^2*b_1^2/2 - a_1^2 - 1/sqrt(b_1^2 + b_2^2) "
          "+ (b_1*w2 - b_2*w1)^2/2 + (b_1*w3 + u_b_2)^2/2 + (b_2*w3 - u_b_1)^2/2\n");
    const std::string text = read_text(reduced);
    CHECK(text.find("# Left out: the invariant momentum, the observable first.\n") != std::string::npos);
    CHECK(text.find("domain = [\"b_2*a_1^2 != 0\"]\n") != std::string::npos);
    CHECK(text.find("observe = [\"distance\", \"energy\", \"sqrt(dot(a, a))\"]\n") != std::string::npos);
    CHECK(call({"check", reduced}).out.find("reduced: valid\n") == 0);
    std::map<std::string, double> points = end_of(whole), triangle = end_of(reduced);
    for (const char* name : {"distance", "energy", "sqrt(dot(a, a))"})
        CHECK(std::abs(points.at(name) - triangle.at(name)) < 1e-10);
}

TEST_CASE("where every coordinate is moved the quotient is a Lie algebra, on the slice that one names")
{
    const std::string sledge = written_file("sledge.toml", R"toml([parameters]
m = 2
J = 0.4
[base]
coordinates = ["th", "x", "y"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "J*v_th^2/2 + m*(v_x^2 + v_y^2)/2 + 0.3*(cos(th)*v_x + sin(th)*v_y)^2"
)toml");
    const Outcome outcome =
        call({"reduce", sledge, "--group", "SE(2)", "--action", motions_of_plane, "--slice", "th = 0, x = 0, y = 0"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n\n[algebroid]\nkind = \"lie_algebra\"\n"
                           "algebra = \"se(2)\"\n") != std::string::npos);
    CHECK(outcome.out.find("L = \"m*w3^2/2 + J*w1^2/2 + (5*m + 3)*w2^2/10\"\n") != std::string::npos);
}

TEST_CASE("a left action, and one that changes L, are refuted; nothing is written")
{
    const std::string whole = written_file("points.toml", two_points);
    const Outcome left = call({"reduce", whole, "--group", "SO(3)", "--action", "a = W*a, b = W*b"});
    CHECK(left.code == 1);
    CHECK(left.out.empty());
    CHECK(left.err.find("points: reduced by SO(3): invalid\n  x.W is no right action\n") == 0);
    CHECK(left.err.find("this is a left action") != std::string::npos);
    const Outcome one = call({"reduce", whole, "--group", "SO(3)", "--action", "a = transpose(W)*a"});
    CHECK(one.code == 1);
    CHECK(one.out.empty());
    CHECK(one.err.find("points: reduced by SO(3): invalid\n  the action does not leave L as it is\n\n"
                       "refuted: symmetry (w1)\n") == 0);
}

TEST_CASE("an action whose fields at the identity are one, and that is none, is refuted at the element")
{
    // x.(W V) - (x.W).V = 2 W[1,2] V[1,2]
    const std::string line =
        written_file("line.toml", "[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n"
                                  "[lagrangian]\nL = \"v_x^2/2\"\n");
    const Outcome bent = call({"reduce", line, "--group", "R", "--action", "x = x + W[1,2] + W[1,2]^2"});
    CHECK(bent.code == 1);
    CHECK(bent.err.find("refuted: action (w, x)\n  d/ds x of x.(W exp(s E)) less x of the field of the action at x.W, "
                        "generator w\n  residual 2*s(1)\n") != std::string::npos);
    const Outcome turned = call(
        {"reduce", beanie_on_tangent, "--group", "SE(2)", "--action",
         "th = th - atan2(W[2,1], W[1,1]) + W[1,3]*W[2,3]" + motions_of_plane.substr(motions_of_plane.find(", x ="))});
    CHECK(turned.code == 1);
    CHECK(turned.err.find("refuted: action (w2, th)\n") != std::string::npos);
}

TEST_CASE("rates Dt of what a reduction fixes or forgets are written out in velocities")
{
    const std::string cart = written_file("cart.toml", R"toml([base]
coordinates = ["x", "th"]
[algebroid]
kind = "tangent"
[definitions]
bob = "[x + sin(th), -cos(th)]"
"speed(X)" = "dot(Dt(X), Dt(X))"
T = "3*Dt(x)^2/2 + speed(bob)/2"
[lagrangian]
L = "T - 9.81*bob[2]"
[observables]
kinetic = "T"
rate = "Dt(bob)"
twice = "2*speed(bob)"
[invariants]
momentum = "3*Dt(x) + Dt(bob)[1]"
[scene.default]
initial = { x = 0.2, th = 0.7, v_x = 0.4, v_th = 1 }
)toml");
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--group", "R", "--action", "x = x + W[1,2]"}, {"--routh", "x"}}) {
        const std::string reduced = fresh_folder() + "/reduced.toml";
        std::vector<std::string> arguments{"reduce", cart, "-o", reduced};
        arguments.insert(arguments.end(), how.begin(), how.end());
        const Outcome outcome = done(arguments);
        const std::string file = read_text(reduced);
        CHECK(file.find("rate = \"[v_x + cos(th)*v_th, sin(th)*v_th]\"\n") != std::string::npos);
        CHECK(file.find("kinetic = \"T\"\n") != std::string::npos);
        CHECK(file.find("momentum = \"3*v_x + v_x + cos(th)*v_th\"\n") != std::string::npos);
        CHECK(file.find("Dt") == std::string::npos);
        CHECK(call({"check", reduced}).code == 0);
    }
}

TEST_CASE("a half-plane is invariant where its boundary is scaled")
{
    const std::string half_plane = written_file("half_plane.toml", R"toml([base]
coordinates = ["x", "y", "z"]
domain = ["x > 0"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(v_x^2 + v_y^2)/(2*x^2) + v_z^2/2 + z*v_y/x"
[scene.default]
initial = { x = 1.2, y = 0.3, z = 0.4, v_x = 0.1, v_y = 0.7, v_z = 0.2 }
)toml");
    const Outcome outcome =
        call({"reduce", half_plane, "--group", "AFF(1)", "--action", "x = x/W[1,1], y = (y - W[1,2])/W[1,1]"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("L = \"z*(3*w1 + 10*w2)/12 + v_z^2/2 + w1^2/2 + (3*w1 + 10*w2)^2/288\"\n") !=
          std::string::npos);
    CHECK(outcome.out.find("domain") == std::string::npos);
}

TEST_CASE("orbits that are smaller than the group have no slice")
{
    const std::string point = written_file("point.toml", R"toml([base]
coordinates = ["a[1..3]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "dot(v_a, v_a)/2 - dot(a, a)"
)toml");
    const Outcome outcome = call({"reduce", point, "--group", "SO(3)", "--action", "a = transpose(W)*a"});
    CHECK(outcome.code == 1);
    CHECK(outcome.err == "error: no slice of its coordinates cuts the orbits of SO(3) on model 'point' in points: the "
                         "group has dimension 3\n"
                         "hint: the group acts freely where orbits are as large as it is; --slice 'x=1, y=0' names "
                         "coordinates and values\n");
}

TEST_CASE("what a reduction by a group does not take is said")
{
    const std::string whole = written_file("points.toml", two_points);
    CHECK(call({"reduce", whole, "--group", "SO(3)"}).err ==
          "lagen reduce: --group needs --action, how an element W moves the coordinates\n");
    CHECK(call({"reduce", whole, "--action", "a = a"}).err == "lagen reduce: --action goes with --group\n");
    CHECK(call({"reduce", whole, "--slice", "a = 0"}).err == "lagen reduce: --slice goes with --group\n");
    CHECK(call({"reduce", whole, "--group", "SO(3)", "--action", "a = transpose(W)*a, b = transpose(W)*b", "--slice",
                "c = 0"})
              .err == "lagen reduce: 'c' of --slice is no coordinate of model 'points'\n");
    CHECK(
        call({"reduce", models_folder() + "/rigid_body.toml", "--group", "SO(3)", "--action", "x = x"})
            .err.find("error: a reduction by a group takes a Lagrangian on a tangent bundle, and model 'rigid_body' is "
                      "something else\n") == 0);
    const std::string slid = written_file("slid.toml", R"toml([base]
coordinates = ["x", "y"]
domain = ["x > 0"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(v_x^2 + v_y^2)/2 - y^2"
)toml");
    const Outcome outcome = call({"reduce", slid, "--group", "R", "--action", "x = x + W[1,2]"});
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("error: the domain of model 'slid' is not shown to be invariant under R: x > 0\n") == 0);
}
