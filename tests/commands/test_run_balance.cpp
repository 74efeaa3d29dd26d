// SPDX-License-Identifier: GPL-2.0-or-later
/// `energy_balance` of a run with forces, dissipation or explicit time: E(t) - E(0) less the integral of the power is
/// no larger than the error of the method, and falls with its order.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;
using Catch::Contains;

namespace {

json::Value balanced_run(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--t-end", "10", "--at", "10", "--format", "json"});
    const Outcome outcome = done(arguments);
    return json::parse(outcome.out);
}

double balance_of(const char* model, const char* method, const char* step)
{
    return double(balanced_run({model, "--method", method, "--step", step})["energy_balance"]["max_drift"].number());
}

/// The order of the balance between a step and its half.
double order_of(const char* model, const char* method, const char* step, const char* half)
{
    return std::log2(balance_of(model, method, step) / balance_of(model, method, half));
}

} // namespace

TEST_CASE("the work of a run is what its energy gained, by a closed form and by its own rows", "[run]")
{
    // A damped pendulum, small: x = e^(-t/4) (cos k t + sin k t / (4 k)), k^2 = 1 - 1/16, and E ends at
    // (x'^2 + x^2)/2 of 1/2, in units of the amplitude's square and up to that.
    const json::Value damped = balanced_run({"driven_pendulum.toml", "--method", "dop853", "--tolerance", "1e-12",
                                             "--set", "A=0", "--initial", "th=0.0001"});
    const double k = std::sqrt(15.0) / 4, decay = std::exp(-2.5), angle = 10 * k;
    const double x = decay * (std::cos(angle) + std::sin(angle) / (4 * k)), v = -decay * std::sin(angle) / k;
    const json::Value& balance = damped["energy_balance"];
    CHECK(double(balance["work"].number()) == Approx(1e-8 * (x * x + v * v - 1) / 2).epsilon(1e-7));
    CHECK(std::abs(balance["max_drift"].number()) < 1e-15);
    // A top that is driven and braked: the rows have the energy at the end.
    const json::Value top = balanced_run({"driven_top.toml", "--method", "taylor", "--tolerance", "1e-14"});
    const auto lane = [&](std::size_t i) { return double(top["rows"][0][i].number()); };
    const double kinetic = (1.2 * lane(4) * lane(4) + 2.1 * lane(5) * lane(5) + 2.9 * lane(6) * lane(6)) / 2;
    const double energy = kinetic + 1.7 * (0.48 * lane(1) + 0.6 * lane(2) + 0.64 * lane(3));
    const json::Value& found = top["energy_balance"];
    CHECK(double(found["initial"].number()) == double(top["invariants"]["energy"]["initial"].number()));
    CHECK(double(found["work"].number()) == Approx(energy - double(found["initial"].number())).epsilon(1e-13));
    CHECK(double(found["work"].number()) == Approx(3.1403824085).epsilon(1e-10));
    CHECK(found["max_drift"].number() > 0);
    CHECK(found["max_drift"].number() < 1e-13);
}

TEST_CASE("the balance falls with the order of the method", "[run]")
{
    CHECK(order_of("driven_pendulum.toml", "rk4", "0.1", "0.05") == Approx(4).margin(0.2));
    CHECK(order_of("driven_top.toml", "gauss8", "0.4", "0.2") == Approx(8).margin(0.3));
}

TEST_CASE("the balance falls with the order of every kind of method", "[all]")
{
    CHECK(order_of("driven_pendulum.toml", "euler", "0.02", "0.01") == Approx(1).margin(0.2));
    CHECK(order_of("driven_top.toml", "gauss_lie4", "0.1", "0.05") == Approx(4).margin(0.2));
    CHECK(order_of("driven_top.toml", "radau5_fixed", "0.1", "0.05") == Approx(5).margin(0.2));
    CHECK(order_of("parametric_pendulum.toml", "leapfrog_kdk", "0.1", "0.05") == Approx(2).margin(0.1));
    CHECK(order_of("parametric_pendulum.toml", "kahanli8", "0.2", "0.1") == Approx(8).margin(0.5));
}

TEST_CASE("a balance that is lost is warned of, one that is kept is told in a line", "[run]")
{
    const Outcome kept = call({"run", "driven_pendulum.toml", "--method", "rk4", "--step", "0.05", "--t-end", "10"});
    CHECK_THAT(kept.err, Contains("\n  energy less work: -1 at the start, largest drift 1.47e-07 at t = "));
    CHECK_THAT(kept.err, !Contains("warning"));
    const Outcome lost = call({"run", "driven_pendulum.toml", "--method", "euler", "--step", "0.02", "--t-end", "10"});
    CHECK_THAT(lost.err, Contains("warning: energy less work should be constant and moved by 0.0607: "));
    // Without forces there is none.
    CHECK(call({"run", "pendulum.toml", "--format", "json"}).out.find("balance") == std::string::npos);
}

TEST_CASE("a run that an event ends has the work up to the event", "[run]")
{
    const Outcome outcome = done({"run", "driven_pendulum.toml", "--scene", "tumble", "--at", "0", "--format", "json"});
    const json::Value tumble = json::parse(outcome.out);
    CHECK(tumble["status"].text == "stopped_by_event");
    CHECK(std::abs(tumble["energy_balance"]["work"].number()) > 0.1);
    CHECK(tumble["energy_balance"]["max_drift"].number() < 1e-10);
}
