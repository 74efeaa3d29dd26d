// SPDX-License-Identifier: GPL-2.0-or-later
/// Models that are written by Dt, by rates and by H = p.X, from the file to the numbers.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;

TEST_CASE("the L of positions by Dt is proved to be the one worked out by hand", "[check]")
{
    const Outcome outcome = call({"check", "cart_pole_is_written.toml"});
    INFO(outcome.out);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("invariance"));
}

TEST_CASE("a rotation matrix is a base in one line, and its top moves as that of the vertical does", "[run]")
{
    const std::vector<double> matrix = last_row({"heavy_top_matrix.toml", "--tolerance", "1e-13"});
    const std::vector<double> vertical = last_row({"heavy_top.toml", "--tolerance", "1e-13"});
    REQUIRE(matrix.size() >= 13);  // t, R, w
    REQUIRE(vertical.size() >= 7); // t, gamma, w
    for (std::size_t k = 1; k < 7; ++k) CHECK(matrix[6 + k] == Approx(vertical[k]).epsilon(1e-9));
    const Outcome check = call({"check", "heavy_top_matrix.toml"});
    CHECK(check.code == 0);
    CHECK_THAT(check.out, Catch::Contains("heavy_top_matrix: valid"));
}

TEST_CASE("any first-order system runs as H = p.X, with its adjoint", "[run]")
{
    const std::vector<double> row = last_row({"first_order.toml", "--tolerance", "1e-12"});
    REQUIRE(row.size() == 7); // t, x, p, divergence, speed
    const double growth = std::exp(0.2);
    CHECK(row[1] == Approx(growth * std::cos(2.0)).epsilon(1e-10));
    CHECK(row[2] == Approx(-growth * std::sin(2.0)).epsilon(1e-10));
    CHECK(row[3] == Approx(2 / growth * std::sin(2.0)).epsilon(1e-10));
    CHECK(row[4] == Approx(2 / growth * std::cos(2.0)).epsilon(1e-10));
    CHECK(row[5] == Approx(0.2).epsilon(1e-14));
    CHECK(row[6] == Approx(growth * std::sqrt(1.01)).epsilon(1e-10));
}

TEST_CASE("a body by its pose is pushed along its own axis while it turns about it, slower and slower", "[run]")
{
    const std::vector<double> row = last_row({"pose.toml", "--tolerance", "1e-12"});
    REQUIRE(row.size() == 19); // t, R, x, w, v
    const double rate = 0.5 / 3, angle = (1 - std::exp(-2 * rate)) / rate;
    CHECK(row[5] == Approx(std::cos(angle)).epsilon(1e-10)); // R[2,2]
    CHECK(row[8] == Approx(std::sin(angle)).epsilon(1e-10)); // R[3,2]
    CHECK(row[10] == Approx(1).epsilon(1e-10));              // x[1] = thrust t^2/(2m)
    CHECK(row[13] == Approx(std::exp(-2 * rate)).epsilon(1e-10));
    CHECK(row[16] == Approx(1).epsilon(1e-10)); // v[1] = thrust t/m
}

TEST_CASE("time that cancels is no explicit time: a hoop that turns steadily has equilibria", "[run]")
{
    const std::string hoop = written_file("hoop.toml", R"toml([parameters]
O = 2
[base]
coordinates = ["q"]
[algebroid]
kind = "tangent"
[definitions]
P = "[sin(q)*cos(O*t), sin(q)*sin(O*t), cos(q)]"
[lagrangian]
L = "dot(Dt(P), Dt(P))/2 + P[3]"
[scene.default]
initial = { q = 1, v_q = 0 }
duration = 1
)toml");
    // cos q = 1/O^2
    const lagen::json::Value found = lagen::json::parse(call({"linearize", hoop, "--format", "json"}).out);
    CHECK(found["equilibrium"]["q"].number() == Approx(std::acos(0.25)).epsilon(1e-12));
    CHECK(finished_run({hoop})["invariants"]["energy"]["max_drift"].number() < 1e-8L);
    CHECK(call({"run", hoop}).out.find("not conserved") == std::string::npos);
    CHECK(call({"generate", hoop}).out.find("power") == std::string::npos);
}
