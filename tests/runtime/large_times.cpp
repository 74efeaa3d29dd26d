// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs at large times: rows, solutions, values inside steps and events are as precise as at small ones, since their
/// places in a step rest on the compensated time.
#include "lagen/lagen.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

/// x'' = -w^2 x with the period 1.
struct Clock {
    using Scalar = double;
    using State = Eigen::Matrix<double, 2, 1>;
    static constexpr int dimension = 2;
    static constexpr double w = 6.283185307179586;
    static constexpr std::array<int, 2> jacobian_rows = {1, 0}, jacobian_columns = {0, 1};
    void jacobian_values(double, const State&, std::array<double, 2>& values) const noexcept { values = {-w * w, 1}; }
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double x = s[0];
        ds[0] = s[1];
        ds[1] = -w * w * x;
        return Status::ok;
    }
};

Clock::State exact(double t)
{
    return {std::cos(Clock::w * t), -Clock::w * std::sin(Clock::w * t)};
}

} // namespace

TEST_CASE("rows and dense solutions far from t = 0 are as precise as near it")
{
    const auto check = [](const auto& method, double accuracy) {
        for (const double start : {0.0, 1.7e9, -1.7e9, 2.1e11}) {
            std::vector<double> at;
            for (int k = 0; k <= 40; ++k) at.push_back(start + 0.25 * k);
            const auto run =
                integrate(Clock{}, Clock::State(1, 0), {start, start + 10}, method, {.at = at, .dense = true});
            REQUIRE(run.times == at);
            double worst = 0;
            for (std::size_t k = 0; k < at.size(); ++k) {
                worst = std::max(worst, (run.states[k] - exact(at[k] - start)).norm());
                worst = std::max(worst, (run.solution(at[k]) - exact(at[k] - start)).norm());
            }
            INFO(start);
            CHECK(worst < accuracy);
        }
    };
    check(Dop853{.tolerance = 1e-11}, 1e-8);
    check(Tsit5{.tolerance = 1e-10}, 1e-7);
    check(Rk4{.step = 0.001}, 1e-7);
    check(Gauss8{.step = 0.03}, 1e-9);
}

TEST_CASE("values inside the steps of an integrator far from t = 0 are those of the steps")
{
    const double start = 1.7e9;
    Integrator integrator(Clock{}, Clock::State(1, 0), start, Dop853{.tolerance = 1e-11});
    double worst = 0;
    for (int k = 0; k < 100; ++k) {
        REQUIRE(integrator.step() == Status::ok);
        const double t = integrator.t_before() + 0.5 * (integrator.t() - integrator.t_before());
        worst = std::max(worst, (integrator.at(t) - exact(t - start)).norm());
    }
    CHECK(worst < 1e-8);
    CHECK(integrator.at(integrator.t()) == integrator.state());
}

TEST_CASE("events far from t = 0 have states on their zeros, and jumps lose no time")
{
    using Request = EventRequest<double, Clock::State>;
    const std::array<Request, 2> events{
        {{.direction = Crossing::falling, .when = [](double, const Clock::State& s) { return s[0]; }},
         {.direction = Crossing::rising,
          .when = [](double, const Clock::State& s) { return s[0] - 0.5; },
          .jump = [](double, const Clock::State& s) { return Clock::State(s[0], -s[1]); }}}};
    const auto check = [&](const auto& method) {
        const auto near = integrate(Clock{}, Clock::State(1, 0), {0.0, 10.0}, method, {.events = events});
        const auto far = integrate(Clock{}, Clock::State(1, 0), {1.7e9, 1.7e9 + 10}, method, {.events = events});
        REQUIRE(near.events.size() == far.events.size());
        REQUIRE(near.events.size() > 5);
        for (std::size_t k = 0; k < near.events.size(); ++k) {
            CHECK(std::abs(far.events[k].t - 1.7e9 - near.events[k].t) < 2.5e-7);
            CHECK((far.events[k].state - near.events[k].state).norm() < 1e-9);
        }
        CHECK((far.state - near.state).norm() < 1e-8);
    };
    check(Dop853{.tolerance = 1e-11});
    check(Rk4{.step = 0.005});
}

TEST_CASE("a first step is longer than the rounding of time")
{
    for (const double end : {1e12 + 10, 1e12 - 10}) {
        const auto run = integrate(Clock{}, Clock::State(1, 0), {1e12, end}, Radau5{.tolerance = 1e-9});
        CHECK(run.status() == Status::ok);
        CHECK((run.state - Clock::State(1, 0)).norm() < 1e-5);
    }
}
