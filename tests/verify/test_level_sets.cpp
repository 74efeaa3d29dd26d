// SPDX-License-Identifier: GPL-2.0-or-later
/// Level sets: the frames that are made of constraints, against hand-written ones, and what is decided on them.
#include "verify/checking.hpp"

#include "elaborate/build_algebroid.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;

namespace {

std::string base(const std::string& coordinates, const std::string& constraints, const std::string& domain = "")
{
    return "[base]\ncoordinates = " + coordinates + "\nconstraints = " + constraints + "\ndomain = [" + domain + "]\n";
}

std::string fibre(const std::string& names)
{
    return "[fibre]\ncoordinates = " + names + "\n";
}

const std::string level_set = "[algebroid]\nkind = \"level_set\"\n";

const std::string lower_sphere = base("['x', 'y', 'z']", "['x^2 + y^2 + z^2 - 1']", "'z < 0'");

Model model_of(const std::string& text)
{
    return read_model_text("test.toml", "name = \"test\"\n" + text, {}, choosers());
}

/// "rho(v_x) has x: 1", a line an entry, and "C" where there is one.
std::vector<std::string> entries_of(const std::string& text)
{
    const Model model = model_of(text);
    const WrittenAlgebroid written = build_algebroid(model);
    std::vector<std::string> lines;
    for (const AnchorValue& entry : written.rho)
        lines.push_back(written.fibre[entry.a].name + " -> " + written.base[entry.i].name + ": " +
                        to_text(entry.value));
    if (!written.C.empty()) lines.emplace_back("C");
    return lines;
}

using Lines = std::vector<std::string>;

bool all_proved(const Report& report)
{
    return std::ranges::all_of(report.structure.checks,
                               [](const Check& check) { return check.decision.status == ProofStatus::proved; });
}

/// The crank a, the coupler b and the rocker c of a linkage whose loop equations are not triangular.
const std::string linkage =
    base("['th', 'ph', 'ps']", "['cos(th) + 3*cos(ph) - 2*cos(ps) - 3', 'sin(th) + 3*sin(ph) - 2*sin(ps)']",
         "'sin(ps - ph) > 0'") +
    level_set + "[lagrangian]\nL = \"v_th^2 + v_ph^2 + v_ps^2 - sin(th)\"\n";

} // namespace

TEST_CASE("a frame keeps coordinates whose minor is proved not to vanish, and its brackets are zero")
{
    const Lines wanted = {"v_x -> x: 1", "v_x -> z: -x/z", "v_y -> y: 1", "v_y -> z: -y/z"};
    CHECK(entries_of(lower_sphere + level_set) == wanted);
    const Model model = model_of(lower_sphere + level_set + "[lagrangian]\nL = \"v_x^2 + v_y^2 + v_z^2\"\n");
    REQUIRE(model.fibre.coordinates.size() == 2);
    CHECK(to_text(model.lagrangian) == "v_x^2 + v_y^2 + (-x/z*v_x - y/z*v_y)^2");
    CHECK(all_proved(verified_text(lower_sphere + level_set)));
}

TEST_CASE("the names of the fibre say which coordinates are kept, in their order, or are new names of their velocities")
{
    const std::string graph = base("['x', 'y', 'z']", "['z - x*y^2']");
    CHECK(entries_of(graph + fibre("['v_y', 'v_x']") + level_set) ==
          Lines{"v_y -> y: 1", "v_y -> z: 2*y*x", "v_x -> x: 1", "v_x -> z: y^2"});
    CHECK(entries_of(graph + fibre("['a', 'b']") + level_set) ==
          Lines{"a -> x: 1", "a -> z: y^2", "b -> y: 1", "b -> z: 2*y*x"});
    CHECK_THROWS_WITH(model_of(graph + fibre("['v_x', 'v_x']") + level_set),
                      Catch::Contains("[fibre] names 'v_x' twice"));
}

TEST_CASE("a regular curve has a tangent without charts, which turns to the left of the gradient")
{
    const std::string circle = base("['x', 'y']", "['x^2 + y^2 - 1']");
    CHECK(entries_of(circle + fibre("['w']") + level_set) == Lines{"w -> x: -y", "w -> y: x"});
    // Where z = 0 cuts the sphere.
    const std::string equator = base("['x', 'y', 'z']", "['x^2 + y^2 + z^2 - 1', 'z']");
    const Lines around = entries_of(equator + fibre("['w']") + level_set);
    CHECK(around == Lines{"w -> x: y", "w -> y: -x"});
}

TEST_CASE("of a symmetric matrix the entries count once, and a chart of the rotations is proved")
{
    const std::string rotations = base("['R[1..3,1..3]']", "['transpose(R)*R - identity(3)']",
                                       "'det(R) > 0', 'R[3,3] > 0', 'R[2,2]*R[3,3] - R[2,3]*R[3,2] > 0'");
    const std::string kept = fibre("['v_R_1_2', 'v_R_1_3', 'v_R_2_3']");
    const Model model = model_of(rotations + kept + level_set);
    CHECK(model.base.constraints.size() == 6);
    const ModelReport verified =
        verified_text(rotations + kept + level_set + "[lagrangian]\nL = \"trace(transpose(v_R)*v_R)\"\n");
    CHECK(verified.structure.checks.size() > 30);
    CHECK(all_proved(verified));
    CHECK(verified.mechanics.regularity.kind == Regularity::Kind::regular);
    // The minor of the first choice, when nothing says that it is not 0.
    CHECK_THROWS_WITH(model_of(base("['R[1..2,1..2]']", "['transpose(R)*R - identity(2)']") + level_set),
                      Catch::Contains("4*R[2,1]*(R[1,2]*R[2,1] - R[1,1]*R[2,2]) (keeping R[1,1])"));
}

TEST_CASE("a level set with a singular point is refused by that point, wherever it lies")
{
    const auto refuses = [](const std::string& constraint, const std::string& point) {
        CHECK_THROWS_WITH(model_of(base("['x', 'y', 'z']", "['" + constraint + "']") + fibre("['u', 'v']") + level_set),
                          Catch::Contains("the level set is singular at " + point +
                                          ": the gradient of its constraint is zero there"));
    };
    refuses("(x - 1/2)^2 - y^2", "x = 1/2, y = 0, z = 0");
    refuses("(3*x - 1)^2 + y^2 - z^2", "x = 1/3, y = 0, z = 0");
    refuses("(x - 7)^3 - y^2", "x = 7, y = 0, z = 0");
}

TEST_CASE("where constraints are not triangular, what holds around the level set is proved, and nothing is refuted")
{
    const ModelReport verified = verified_text(linkage);
    REQUIRE(verified.structure.checks.size() == 2);
    CHECK(all_proved(verified));
    CHECK(verified.mechanics.regularity.kind == Regularity::Kind::regular);

    const ModelReport claims =
        verified_text(linkage + "[invariants]\nloop = \"cos(th) + 3*cos(ph) - 2*cos(ps)\"\nfalse = \"cos(th)\"\n");
    CHECK(line_of(claims.structure.checks.at(2)) == "invariant(loop) proved");
    CHECK(line_of(claims.structure.checks.at(3)) == "invariant(false) undecided");
    CHECK(claims.structure.checks[3].decision.evidence ==
          "not 0 at a point that need not fulfil the base constraints: not all are triangular");
}

TEST_CASE("a level set is an inner algebroid of frames, prolongations and nonholonomic models")
{
    const std::string inside = "of = { kind = \"level_set\" }\n";
    const std::string rotations =
        "[algebroid]\nkind = \"frame\"\nsections = { a = { v_x = \"z\" }, b = { v_y = \"z\" } }\n";
    const std::string lagrangian = "[lagrangian]\nL = \"v_x^2 + v_y^2 + v_z^2\"\n";
    const ModelReport frame = verified_text(lower_sphere + fibre("['a', 'b']") + rotations + inside + lagrangian);
    CHECK(all_proved(frame));
    CHECK(frame.mechanics.regularity.kind == Regularity::Kind::regular);
    CHECK(all_proved(verified_text(lower_sphere + "[algebroid]\nkind = \"prolongation\"\n" + inside)));
    const std::string blade = base("['x', 'y', 'z', 'th']", "['z - x^2 - y^2']") + fibre("['v_x', 'v_th']") +
                              "[algebroid]\nkind = \"nonholonomic\"\n" + inside +
                              "constraints = [\"v_x*sin(th) - v_y*cos(th)\"]\n" +
                              "[lagrangian]\nL = \"v_x^2 + v_y^2 + v_z^2 + v_th^2\"\n";
    const ModelReport verified = verified_text(blade);
    CHECK(all_proved(verified));
    CHECK(verified.structure.checks.size() > 2);
}
