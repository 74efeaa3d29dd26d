// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen solve --relative-equilibria`: those of bodies, tops and potentials with their stability, against formulas.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

std::vector<json::Value> equilibria_of(std::vector<std::string> arguments)
{
    arguments.emplace_back("--relative-equilibria");
    return report_of("solve", std::move(arguments))["relative_equilibria"].entries;
}

/// "2 stable, 4 spectrally_unstable"
std::string counts_of(const std::vector<json::Value>& equilibria)
{
    std::map<std::string, int> counts;
    for (const json::Value& each : equilibria) ++counts[each["stability"].text];
    std::string text;
    for (const auto& [stability, count] : counts)
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + stability;
    return text;
}

std::vector<json::Value> sleeping_top(const std::string& spin)
{
    return equilibria_of({"lagrange_top.toml", "--set", "I1=1", "--set", "I3=1", "--set", "mgl=1", "--initial", "g1=0",
                          "--initial", "g2=0", "--initial", "g3=1", "--initial", "w1=0", "--initial", "w2=0",
                          "--initial", "w3=" + spin});
}

} // namespace

TEST_CASE("a free body is stable about its first and last axis, and unstable about the middle one")
{
    const auto equilibria = equilibria_of({"rigid_body.toml"});
    REQUIRE(counts_of(equilibria) == "2 spectrally_unstable, 4 stable");
    for (const json::Value& each : equilibria) {
        CHECK(each["certified"].text == "true");
        const bool middle = std::abs(each["state"]["Pi2"].number()) > 0;
        CHECK((each["stability"].text == "spectrally_unstable") == middle);
        if (!middle) continue;
        const long double w = each["velocities"]["w2"].number(), I1 = 1.1, I2 = 2.3, I3 = 3.4;
        CHECK(std::abs(each["eigenvalues"].entries[1].entries[0].number()) ==
              Approx(std::abs(w) * std::sqrt((I3 - I2) * (I2 - I1) / (I1 * I3))).epsilon(1e-12));
    }
}

namespace {

std::vector<json::Value> equilibria_of_text(const std::string& text)
{
    const std::string path = written_file("model.toml", text);
    return equilibria_of({path});
}

const std::string free_body = R"toml([fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "lie_algebra"
algebra = "so(3)"
[lagrangian]
L = "(w1^2 + 2*w2^2 + 3*w3^2)/2"
[scene.default]
initial = { w1 = 0, w2 = 0, w3 = )toml";

} // namespace

TEST_CASE("Casimirs hold the level of the start, whatever energy is made of, and momenta are no angles")
{
    // |Pi| = 3, and pi: +-Pi are two equilibria, and not one of them is Pi = 0.
    for (const char* spin : {"1 }\n", "\"pi/3\" }\n"}) {
        const auto equilibria = equilibria_of_text(free_body + spin);
        CHECK(counts_of(equilibria) == "2 spectrally_unstable, 4 stable");
    }
    // se(2): the level p_a^2 + p_b^2 = 1 of an invariant that is one of energy and its own.
    const auto plane = equilibria_of_text(
        "[fibre]\ncoordinates = [\"w\", \"a\", \"b\"]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"se(2)\"\n"
        "[lagrangian]\nL = \"(w^2 + a^2 + 2*b^2)/2\"\n[scene.default]\ninitial = { w = 0, a = 1, b = 0 }\n");
    CHECK(counts_of(plane) == "2 spectrally_unstable, 2 stable");
    for (const json::Value& each : plane)
        CHECK(std::hypot(each["state"]["p_a"].number(), each["state"]["p_b"].number()) == Approx(1).epsilon(1e-14));
    // x = pi and x = -pi of a potential without a period
    CHECK(counts_of(equilibria_of_text("[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                                       "L = \"v_x^2/2 - (x^2 - pi^2)^2\"\n[scene.default]\n"
                                       "initial = { x = 0, v_x = 0 }\n")) == "1 spectrally_unstable, 2 stable");
}

TEST_CASE("at a bifurcation in decimal numbers nothing is proved of stability")
{
    // H = (p^2 + j^2)/2 + b j^2 q^2/2 - c q^2/2 - q^4 with b j^2 = c: q = 0 is a maximum of -q^4. No double is 9/10.
    const auto at = [](const std::string& j) {
        return equilibria_of_text("[parameters]\nb = 0.1\nc = 0.081\n[base]\ncoordinates = [\"q\", \"ph\"]\n[fibre]\n"
                                  "coordinates = [\"v\", \"w\"]\nmomenta = [\"p\", \"j\"]\n[algebroid]\nkind = "
                                  "\"tangent\"\n[hamiltonian]\nH = \"(p^2 + j^2)/2 + b*j^2*q^2/2 - c*q^2/2 - q^4\"\n"
                                  "[scene.default]\ninitial = { q = 0, ph = 0, p = 0, j = " +
                                  j + " }\n");
    };
    const auto stability_at_rest = [&](const std::string& j) {
        for (const json::Value& each : at(j))
            if (std::abs(each["state"]["q"].number()) < 1e-9) return each["stability"].text;
        return std::string();
    };
    CHECK(stability_at_rest("0.9") == "undecided");
    CHECK(stability_at_rest("0.9000001") == "stable");
    CHECK(stability_at_rest("0.8999999") == "spectrally_unstable");
}

TEST_CASE("parameters of the scene are those of its equilibria")
{
    const auto found = equilibria_of_text("[parameters]\nk = 1\n[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = "
                                          "\"tangent\"\n[lagrangian]\nL = \"v_x^2/2 - (x - k)^2\"\n[scene.default]\n"
                                          "parameters = { k = \"10/3\" }\ninitial = { x = 0, v_x = 0 }\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0]["exact"]["x"].text == "10/3");
}

TEST_CASE("a second variation that is definite says with which multipliers")
{
    // Two springs that push outwards in a field that turns: H is indefinite at rest, H - lambda (x p_y - y p_x) is not
    // for lambda near -2, where it is (p_x^2 + p_y^2 + 3 (x^2 + y^2))/2 in turned coordinates.
    const auto found =
        equilibria_of_text("[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                           "L = \"(v_x^2 + v_y^2)/2 + 2*(x*v_y - y*v_x) + (x^2 + y^2)/2\"\n[scene.default]\n"
                           "initial = { x = 0, y = 0, v_x = 0, v_y = 0 }\n");
    REQUIRE(counts_of(found) == "1 stable");
    CHECK(found[0]["multipliers"].entries[0].number() == 0);
    // positive definite for |lambda + 2| < sqrt(3)
    CHECK(std::abs(found[0]["definite_at"].entries[0].number() + 2) < 1.7);
}

TEST_CASE("Lagrange's sleeping top is stable above the limit, unstable below it, and left open at it", "[run]")
{
    const auto upright = [](const std::vector<json::Value>& equilibria) {
        for (const json::Value& each : equilibria)
            if (each["state"]["g3"].number() == 1) return each;
        FAIL("no sleeping top");
        return equilibria[0];
    };
    const json::Value above = upright(sleeping_top("2.01")), at = upright(sleeping_top("2")),
                      below = upright(sleeping_top("1.99"));
    CHECK(above["stability"].text == "stable"); // (I3 w3)^2 > 4 I1 mgl
    CHECK(above["second_variation"].text == "positive definite");
    CHECK(above["exact"]["p_w3"].text == "201/100");
    CHECK(at["stability"].text == "undecided");
    CHECK(below["stability"].text == "spectrally_unstable");
    // Steady precession takes over: g3 = 1.99 - 1, as lambda3 = I1 and p = lambda2 e3 + lambda3 g.
    const auto tilted = sleeping_top("1.99");
    REQUIRE(counts_of(tilted) == "1 spectrally_unstable, 1 stable");
    CHECK(tilted[0]["state"]["g3"].number() == Approx(0.99).epsilon(1e-12));
    CHECK(tilted[0]["flows"].number() == 1);
    CHECK(sleeping_top("2.01").size() == 1);
}

TEST_CASE("equilibria of potentials, of coupled pendulums and of a body in a fluid", "[run]")
{
    const auto saddles = equilibria_of({"henon_heiles.toml"});
    REQUIRE(counts_of(saddles) == "3 spectrally_unstable, 1 stable");
    for (const json::Value& each : saddles)
        if (each["stability"].text != "stable") CHECK(each["energy"].number() == Approx(1.0 / 6).epsilon(1e-14));
    CHECK(counts_of(equilibria_of({"double_pendulum.toml"})) == "3 spectrally_unstable, 1 stable");
    CHECK(counts_of(equilibria_of({"kirchhoff.toml"})) == "4 spectrally_unstable, 2 stable");
}

TEST_CASE("a circular orbit of Kepler's is one of a family that the rotations make")
{
    const auto circles = equilibria_of({"kepler.toml"});
    REQUIRE(counts_of(circles) == "1 stable");
    const long double x = circles[0]["state"]["x"].number(), y = circles[0]["state"]["y"].number();
    CHECK(x * x + y * y == Approx(0.64 * 0.64).epsilon(1e-12)); // r = p^2/k, p = 0.8
    CHECK(circles[0]["multipliers"].entries[0].number() == Approx(0.8 / (0.64 * 0.64)).epsilon(1e-12));
}

TEST_CASE("neither the boundary of the domain nor infinity is an equilibrium")
{
    const auto of = [](const std::string& base, const std::string& L, const std::string& start) {
        const std::string path =
            written_file("model.toml", "[base]\n" + base + "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" + L +
                                           "\"\n[scene.default]\ninitial = { " + start + " }\n");
        return equilibria_of({path});
    };
    const auto hoop = of("coordinates = [\"th\", \"ph\"]\ndomain = [\"sin(th) > 0\"]\n",
                         "(v_th^2 + sin(th)^2*v_ph^2)/2 + v_ph^2/5 + 9*cos(th)", "th = 1, ph = 0, v_th = 0, v_ph = 4");
    REQUIRE(hoop.size() == 1); // and not th = 0
    CHECK(hoop[0]["state"]["th"].number() == Approx(0.987399350133L));
    const auto orbit = of("coordinates = [\"r\", \"th\"]\ndomain = [\"r > 0\"]\n", "(v_r^2 + r^2*v_th^2)/2 + 1/r",
                          "r = 1, th = 0, v_r = 0.1, v_th = 1");
    REQUIRE(orbit.size() == 1); // dH tends to 0 far away
    CHECK(orbit[0]["state"]["r"].number() == Approx(1));
}

TEST_CASE("a cyclic coordinate moves at a constant rate", "[run]")
{
    const auto cones = equilibria_of({"spherical_pendulum.toml"});
    REQUIRE(cones.size() == 1);
    CHECK(cones[0]["rates"]["ph"].number() == Approx(cones[0]["multipliers"].entries[0].number()).epsilon(1e-12));
}
