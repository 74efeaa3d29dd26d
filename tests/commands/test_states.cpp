// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs with first-order states and quadratures beside the motion.
#include "program.hpp"
#include "turning_body.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

/// x, v and F of m v' = F, tau F' = u0 - F from rest, with m = 2, tau = 1/4, u0 = 3.
struct Cart {
    double x, v, F;
    explicit Cart(double t)
    {
        const double tau = 0.25, decay = std::exp(-t / tau);
        F = 3 * (1 - decay);
        v = 1.5 * (t - tau * (1 - decay));
        x = 1.5 * (t * t / 2 - tau * t + tau * tau * (1 - decay));
    }
};

} // namespace

TEST_CASE("a motor with a lag pulls a cart as its closed form says, and the work done is its energy", "[run]")
{
    const std::vector<double> row = last_row({"cart.toml", "--tolerance", "1e-12"});
    const Cart end(2);
    REQUIRE(row.size() == 6); // t, x, v_x, F, work, path
    CHECK(row[1] == Approx(end.x).epsilon(1e-11));
    CHECK(row[2] == Approx(end.v).epsilon(1e-11));
    CHECK(row[3] == Approx(end.F).epsilon(1e-11));
    CHECK(row[4] == Approx(end.v * end.v).epsilon(1e-11)); // m v^2/2
    CHECK(row[5] == Approx(end.x).epsilon(1e-9));
    const std::vector<double> held = last_row({"cart.toml", "--scene", "held"});
    CHECK(held[1] == Approx(3).epsilon(1e-11)); // u0 t^2/(2 m)
    CHECK(held[5] == Approx(1 + held[1]).epsilon(1e-9));
    const std::vector<double> pushed =
        last_row({"cart.toml", "--scene", "held", "--initial", "F=0", "--initial", "path=0"});
    CHECK(pushed[1] == Approx(end.x).epsilon(1e-9));
}

TEST_CASE("states that nobody observes are no part of the run, and what is claimed with them is tracked", "[run]")
{
    const Outcome pull = done({"run", "cart.toml", "--scene", "pull", "--format", "json"});
    const json::Value run = json::parse(pull.out);
    CHECK(run["columns"].size() == 3);
    CHECK(std::strtod(run["rows"][2][2].text.c_str(), nullptr) == Approx(Cart(2).F).epsilon(1e-9));
    const double drift = std::strtod(run["invariants"]["balance"]["max_drift"].text.c_str(), nullptr);
    CHECK(drift < 1e-9);
    CHECK(drift > 0);
    const std::vector<double> row = last_row({"cart.toml", "--scene", "motion"});
    REQUIRE(row.size() == 7);
    CHECK(row[6] == Approx(row[4] + 1).epsilon(1e-14));
}

TEST_CASE("a sweep starts first-order states where it is told to", "[sweep]")
{
    const std::string file = fresh_folder() + "/table.csv";
    const Outcome sweep = done({"sweep", "cart.toml", "--initial", "work=0:2:3", "-o", file});
    const Outcome check = call({"check", "cart.toml"});
    CHECK(check.code == 0);
    CHECK(check.out.find("invariant       1 proved") != std::string::npos);
}

TEST_CASE("equations of first-order states are printed behind those of the motion, at the velocities of the form",
          "[derive]")
{
    const Outcome lagrange = call({"derive", "cart.toml"}),
                  hamilton = call({"derive", "cart.toml", "--form", "hamilton"});
    CHECK(lagrange.out.find("first-order states") != std::string::npos);
    CHECK(lagrange.out.find("v_x") != std::string::npos);
    CHECK(hamilton.out.find("p_v_x F/m") != std::string::npos);
    const Outcome latex = call({"derive", "cart.toml", "--format", "latex"});
    CHECK(latex.out.find("\\dot z = f(t, x, y, z)") != std::string::npos);
}

TEST_CASE("a rigid body turns with its velocity: R stays a rotation and R I w is constant, by steps and implicitly",
          "[run]")
{
    for (const std::string method : {"dop853", "gauss4"})
        check_turned(last_row({"turning_body.toml", "--method", method, "--step", "0.01"}), 2e-6);
    CHECK(last_row({"turning_body.toml", "--scene", "bare"}).size() == 2);
    const std::vector<double> upright = last_row({"turning_body.toml", "--scene", "upright"});
    REQUIRE(upright.size() == 13);
    CHECK(upright[4] == Approx(std::cos(2.5)).epsilon(1e-9));
    CHECK(upright[5] == Approx(-std::sin(2.5)).epsilon(1e-9));
}

TEST_CASE("a rigid body turns with its velocity, whatever the method", "[all]")
{
    for (const std::string method : {"rk4", "taylor", "radau5"})
        check_turned(last_row({"turning_body.toml", "--method", method, "--step", "0.01"}), 2e-6);
}
