// SPDX-License-Identifier: GPL-2.0-or-later
/// What `lagen run` tells of long runs: drifts and slopes of what the equations keep, and warnings where a run lost it.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;
using Catch::Contains;

namespace {

struct Told {
    json::Value value;
    std::string warnings;
};

Told told_run(std::vector<std::string> arguments, const Surroundings& around = {})
{
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = done(arguments, around);
    return {json::parse(outcome.out), outcome.err};
}

long double slope_over_error(const json::Value& figure)
{
    return std::abs(figure["slope"].number()) / figure["slope_error"].number();
}

const std::string constraint = "g1^2 + g2^2 + g3^2 - 1";

} // namespace

TEST_CASE("Casimirs and constraints that drift are told, with their slopes and the distance from the manifold", "[run]")
{
    const Told told =
        told_run({"heavy_top.toml", "--method", "rk4", "--step", "0.05", "--t-end", "1000", "--at", "1000"});
    const json::Value& casimir = told.value["casimirs"]["norm_squared"];
    const json::Value& off = told.value["constraints"][constraint];
    CHECK(casimir.keys == std::vector<std::string>{"initial", "max_drift", "t", "slope", "slope_error"});
    CHECK(off.keys == std::vector<std::string>{"max", "t", "slope", "slope_error"});
    CHECK(casimir["initial"].text == "1");
    // RK4 shrinks the vertical: at the end the last row says how far.
    const json::Value& row = told.value["rows"][0];
    long double squares = 0;
    for (std::size_t k = 1; k <= 3; ++k) squares += row[k].number() * row[k].number();
    CHECK(off["max"].number() == Approx(double(1 - squares)).epsilon(1e-9));
    CHECK(off["t"].number() == 1000);
    CHECK(casimir["max_drift"].number() == Approx(double(1 - squares)).epsilon(1e-3));
    CHECK(casimir["slope"].number() == Approx(double(squares - 1) / 1000).epsilon(0.2));
    CHECK(slope_over_error(casimir) > 3);
    CHECK(told.value["manifold_distance"]["max"].number() == Approx(double(1 - std::sqrt(squares))).epsilon(1e-3));
    CHECK(told.warnings.empty());
    const Outcome text =
        call({"run", "heavy_top.toml", "--method", "rk4", "--step", "0.05", "--t-end", "1000", "--at", "1000"});
    CHECK_THAT(text.err, Contains("\n  norm_squared: 1 at the start, largest drift 0.000366 at t = ") &&
                             Contains("\n  " + constraint + " = 0: at most 0.000366 off at t = 1000, slope -3.") &&
                             Contains("\n  distance from the manifold: at most 0.000183 at t = "));
}

TEST_CASE("the energy of a symplectic method has no slope, that of RK4 has one", "[run]")
{
    const std::vector<std::string> common{"pendulum.toml", "--step", "0.02", "--t-end", "2000", "--at", "2000"};
    const auto energy = [&](const char* method) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"--method", method});
        return told_run(arguments).value["invariants"]["energy"];
    };
    const json::Value verlet = energy("leapfrog_kdk"), rk4 = energy("rk4");
    CHECK(verlet["max_drift"].number() > 1e-3); // it swings
    CHECK(slope_over_error(verlet) < 1);
    CHECK(verlet["slope_error"].number() * 2000 < 0.1 * verlet["max_drift"].number());
    CHECK(slope_over_error(rk4) > 10);
    CHECK(rk4["slope"].number() < 0);
}

TEST_CASE("a fixed step that jumps over a collision ends with a warning that says when", "[run]")
{
    // Free fall from rest at r = 1, off the axis by 1e-3: the collision is at t = pi/(2 sqrt 2).
    const Told told = told_run({"kepler.toml", "--initial", "x=1", "--initial", "u=0", "--initial", "v=1e-3",
                                "--method", "rk4", "--step", "0.01", "--t-end", "2", "--at", "2"});
    CHECK(told.value["status"].text == "ok");
    const json::Value& energy = told.value["invariants"]["energy"];
    CHECK(energy["size"].number() == Approx(1).epsilon(1e-4)); // |x dE/dx| + |v dE/dv|
    CHECK(energy["max_drift"].number() > 1);
    CHECK(energy["moved_at"].number() == Approx(M_PI / std::sqrt(8.0)).epsilon(0.02));
    CHECK_THAT(told.warnings, Contains("warning: energy should be constant and moved by ") &&
                                  Contains(": by more than 1e-3 of its size 1 from t = 1.1"));
    // The same without a collision.
    CHECK(told_run({"kepler.toml", "--method", "rk4", "--step", "0.01", "--t-end", "2", "--at", "2"}).warnings.empty());
}

TEST_CASE("what is 0 at the start has a size of its own", "[run]")
{
    // laplace_y is 0 at perihelion; its gradient and the state are not.
    const Told told = told_run({"kepler.toml", "--method", "rk4", "--step", "0.2", "--t-end", "20", "--at", "20"});
    const json::Value& vector = told.value["invariants"]["laplace_y"];
    CHECK(std::abs(vector["initial"].number()) < 1e-15);
    CHECK(vector["size"].number() > 0.5);
    CHECK(vector["size"].number() < 50);
    CHECK_THAT(told.warnings, Contains("warning: laplace_y should be constant and moved by "));
}
