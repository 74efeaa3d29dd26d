// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs of control problems: angles in closed form, and stationary controls that are followed as long as they maximise
/// H.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

struct ControlRun {
    Outcome outcome;
    json::Value value;

    [[nodiscard]] std::string status() const { return value["status"].text; }
    [[nodiscard]] double t() const { return std::strtod(value["t"].text.c_str(), nullptr); }
    [[nodiscard]] double entry(std::size_t row, std::size_t column) const
    {
        return std::strtod(value["rows"][row][column].text.c_str(), nullptr);
    }
    [[nodiscard]] double last(std::size_t column) const { return entry(value["rows"].size() - 1, column); }
};

ControlRun run_of(const std::string& model, const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments{"run", model, "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = call(arguments);
    INFO(outcome.err);
    REQUIRE(!outcome.out.empty());
    json::Value value = json::parse(outcome.out);
    return {std::move(outcome), std::move(value)};
}

} // namespace

TEST_CASE("the cost of a control problem is an observable, and its integral a state where somebody names it", "[run]")
{
    const ControlRun run = run_of("regulator.toml");
    REQUIRE(run.value["rows"].size() == 5);
    for (std::size_t row = 0; row < 5; ++row) {
        const double x = 2 * std::exp(-2 * run.entry(row, 0));
        CHECK(run.entry(row, 1) == Approx(x).epsilon(1e-11));
        CHECK(run.entry(row, 2) == Approx(-x).epsilon(1e-11));
        CHECK(run.entry(row, 3) == Approx(2 * x * x).epsilon(1e-11));
        CHECK(run.entry(row, 4) == Approx((4 - x * x) / 2).epsilon(1e-11).margin(1e-12));
        CHECK(run.entry(row, 5) == Approx(2).epsilon(1e-11)); // paid and still to pay
    }
    const Outcome states = call({"run", "regulator.toml", "--scene", "state", "--at", "0"});
    CHECK(states.out == "t,x,p_v_x,u\r\n0,2,-2,-2\r\n");
    // (4 - x^2)/2 = 3/2 where x = 1.
    const ControlRun paid = run_of("regulator.toml", {"--scene", "paid"});
    CHECK(paid.status() == "stopped_by_event");
    CHECK(paid.t() == Approx(std::log(2.0) / 2).epsilon(1e-11));
}

TEST_CASE("the maximum of H is proved whatever states observe the cost")
{
    const std::string proved = "  maximum         1 proved\n";
    const std::string models = lagen::testing::models_folder() + "/";
    CHECK_THAT(call({"check", models + "regulator.toml"}).out, Catch::Contains(proved));
    const std::string folder = fresh_folder();
    for (const char* model : {"zermelo.toml", "double_integrator.toml", "regulator.toml"}) {
        std::string text = read_text(models + model);
        const std::size_t control = text.find("[control]");
        REQUIRE(control != std::string::npos);
        text.insert(control, "[states]\nJ = \"t\"\n[observables]\nprice = \"total_cost + cost + J\"\n");
        write_text(folder + "/model.toml", text);
        const Outcome outcome = call({"check", folder + "/model.toml"});
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.out, Catch::Contains(proved));
    }
}

TEST_CASE("a header carries the total cost where the model names it, and no other one does")
{
    CHECK_THAT(call({"generate", "double_integrator.toml"}).out, !Catch::Contains("total_cost"));
    CHECK_THAT(call({"generate", "regulator.toml"}).out, Catch::Contains("s[2] total_cost")); // by its event
    CHECK_THAT(call({"derive", "regulator.toml"}).out, !Catch::Contains("total_cost"));
}

TEST_CASE("Zermelo's boat reaches the origin, its heading counted from either direction", "[all]")
{
    for (const char* model : {"zermelo.toml", "zermelo_shifted.toml"}) {
        const ControlRun run = run_of(model);
        INFO(model << ": " << run.outcome.err);
        CHECK(run.outcome.code == 0);
        CHECK(run.status() == "ok");
        CHECK(std::abs(run.last(1)) < 1e-9);
        CHECK(std::abs(run.last(2)) < 1e-9);
        // The heading grows from 105 to 240 degrees, across 180; H = 0 all the way.
        CHECK(run.entry(0, 3) == Approx(105).epsilon(1e-12));
        CHECK(run.last(3) == Approx(240).epsilon(1e-12));
        for (std::size_t row = 0; row < run.value["rows"].size(); ++row) {
            if (row > 0) CHECK(run.entry(row, 3) > run.entry(row - 1, 3));
            CHECK(std::abs(run.entry(row, 4)) < 1e-12);
        }
    }
}

TEST_CASE("the brachistochrone reaches its end, with its heading found in closed form or followed", "[run]")
{
    for (const char* model : {"brachistochrone.toml", "bent_brachistochrone.toml"}) {
        const ControlRun run = run_of(model);
        INFO(model << ": " << run.outcome.err);
        CHECK(run.outcome.code == 0);
        CHECK(std::abs(run.last(1) - 2) < 1e-9);
        CHECK(std::abs(run.last(2) - 2) < 1e-9);
        CHECK(std::abs(run.last(3) - std::sqrt(2 * 9.8 * 2)) < 1e-9);
        CHECK(std::abs(run.last(6)) < 1e-9);
    }
}

TEST_CASE("a search for controls that finds none at the start says where it could begin", "[run]")
{
    const ControlRun run = run_of("lost_brachistochrone.toml");
    CHECK(run.outcome.code == 1);
    CHECK(run.status() == "newton_diverged");
    CHECK(run.t() == 0);
    const Outcome told = call({"run", "lost_brachistochrone.toml"});
    CHECK_THAT(told.err, Catch::EndsWith(
                             "hint: the search for the controls found no maximum of H at the start: `guess = { u = .. "
                             "}` in [control] says where it begins\n"));
}

TEST_CASE("thrust of constant size turns through the left, and ends as theory says", "[run]")
{
    const ControlRun run = run_of("thrust.toml");
    INFO(run.outcome.err);
    CHECK(run.outcome.code == 0);
    CHECK(run.status() == "stopped_by_event");
    CHECK(run.last(3) == Approx(-45).epsilon(1e-12));
    CHECK(std::abs(run.last(2) - 5) < 1e-9);
    CHECK(std::abs(run.last(4)) < 1e-9);
    // The two ends are mirror images: the angles add up to a whole turn.
    constexpr double turn = 6.283185307179586;
    CHECK(run.last(5) + run.entry(0, 5) == Approx(turn).epsilon(1e-10));
    CHECK(std::tan(run.entry(0, 5)) == Approx(0.0081539417005043346337 / -0.0057890616463099163995).epsilon(1e-12));
    for (std::size_t row = 1; row < run.value["rows"].size(); ++row) CHECK(run.entry(row, 5) > run.entry(row - 1, 5));
}

TEST_CASE("an angle on which H does not depend ends a run", "[run]")
{
    const Outcome outcome = call({"run", "thrust.toml", "--scene", "coasting"});
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err,
               Catch::Contains("thrust, scene coasting: singular_control at t = 0;") &&
                   Catch::Contains("\n  H does not depend on a control: b = c = 0 in a + b cos u + c sin u\n"
                                   "  the last good state is at t = 0: x = 0, y = 0, vx = 1, "));
}

TEST_CASE("a maximum that is lost ends the run at its time", "[run]")
{
    const double u = (std::sqrt(7.0) - 2) / 3; // where d2H/du2 vanishes on the hill of two_hills.toml
    const std::pair<const char*, double> models[] = {
        {"fork.toml", 1}, {"fold.toml", 1}, {"two_hills.toml", 0.5 + u - 2 * u * u - u * u * u}};
    for (const auto& [model, when] : models) {
        const ControlRun run = run_of(model);
        INFO(model << ": " << run.outcome.err);
        CHECK(run.outcome.code == 1);
        CHECK(run.status() == "not_a_maximum");
        CHECK(run.t() == Approx(when).epsilon(1e-6));
        CHECK(run.value["state"].keys == std::vector<std::string>{"x", "p"});
        CHECK(run.value["state"]["p"].text == "0");
    }
    const Outcome told = call({"run", "fork.toml"});
    CHECK_THAT(told.err, Catch::Contains("fork, scene default: not_a_maximum at t = 1; ") &&
                             Catch::Contains(
                                 "\n  no maximum of H is found from the controls before, or from the guess: d2H/du2 is "
                                 "not negative definite\n  the last good state is at t = 1: x = 0.5, p = 0\n"));
    const ControlRun late = run_of("fork.toml", {"--scene", "late"});
    CHECK(late.outcome.code == 1);
    CHECK(late.status() == "not_a_maximum");
    CHECK(late.t() == 2);
    CHECK(late.value["rows"].size() == 0);
}

TEST_CASE("fixed steps and implicit methods follow the controls too", "[all]")
{
    const ControlRun fixed = run_of("zermelo.toml", {"--method", "rk4", "--step", "0.005"});
    INFO(fixed.outcome.err);
    CHECK(std::abs(fixed.last(1)) < 1e-7);
    CHECK(fixed.last(3) == Approx(240).epsilon(1e-9));
    const ControlRun implicit = run_of("bent_brachistochrone.toml", {"--method", "gauss6", "--step", "0.01"});
    INFO(implicit.outcome.err);
    CHECK(std::abs(implicit.last(1) - 2) < 1e-8);
}
