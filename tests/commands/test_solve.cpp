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
    arguments.insert(arguments.begin(), "solve");
    arguments.insert(arguments.end(), {"--relative-equilibria", "--format", "json"});
    const Outcome outcome = call(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return json::parse(outcome.out)["relative_equilibria"].entries;
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

TEST_CASE("a cyclic coordinate moves at a constant rate", "[run]")
{
    const auto cones = equilibria_of({"spherical_pendulum.toml"});
    REQUIRE(cones.size() == 1);
    CHECK(cones[0]["rates"]["ph"].number() == Approx(cones[0]["multipliers"].entries[0].number()).epsilon(1e-12));
}
