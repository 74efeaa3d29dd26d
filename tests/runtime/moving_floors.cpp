// SPDX-License-Identifier: GPL-2.0-or-later
/// Jumps at surfaces that move, where an event function is small by cancellation: zeno against closed forms.
#include "lagen/lagen.hpp"
#include "runtime/ball.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::problems;

namespace {

/// A floor at `height(t)` with the velocity `speed(t)`, which throws a ball back with e of the relative speed.
template <class Height, class Speed>
BallRequest moving_floor(double e, const Height& height, const Speed& speed)
{
    return {
        .direction = Crossing::falling,
        .when = [height](double t, const BallState& s) { return s[0] - height(t); },
        .jump = [e, speed](double t, const BallState& s) { return BallState(s[0], speed(t) - e * (s[1] - speed(t))); }};
}

BallRequest rising_floor(double e, double speed)
{
    return moving_floor(
        e, [speed](double t) { return speed * t; }, [speed](double) { return speed; });
}

/// A ball that is dropped from 0.1 metres onto that floor.
template <class Method>
Run<Ball> dropped_on(const BallRequest& floor, const Method& method, double end = 5)
{
    const std::array<BallRequest, 1> events{floor};
    return integrate(Ball{}, BallState(0.1, 0), {0.0, end}, method, {.events = events});
}

} // namespace

TEST_CASE("bounces on a floor that moves end where the closed form says, and no earlier by rounding errors")
{
    for (const double speed : {-0.4, 0.01, 0.1, 0.3, 0.99, 30.0})
        for (const double e : {0.0, 0.1, 0.5, 0.7, 0.9}) {
            const double u = std::sqrt(speed * speed + 0.2 * gravity), first = 0.2 / (u + speed);
            const double limit = first + 2 * e * u / (gravity * (1 - e));
            // flights lower than the rounding of their heights are not told apart
            const double lost = e > 0 ? 2e-7 * std::sqrt(std::abs(speed) * limit) / (1 - e) : 0;
            INFO("e = " << e << ", speed = " << speed);
            const auto check = [&](const auto& method) {
                const Run<Ball> run = dropped_on(rising_floor(e, speed), method, 100);
                CHECK(run.status() == Status::zeno);
                CHECK_THAT(run.t, Catch::WithinAbs(limit, 1e-12 * (1 + limit) + lost));
            };
            check(Dop853{.tolerance = 1e-10});
            check(Tsit5{.tolerance = 1e-8});
            check(Rk4{.step = 0.01});
        }
}

TEST_CASE("elastic bounces on a floor that moves never end, however low they are")
{
    const std::array<BallRequest, 1> events{rising_floor(1, 0.3)};
    const auto check = [&](const auto& method) {
        const auto run = integrate(Ball{}, BallState(1e-5, 0.3), {0.0, 1.0}, method, {.events = events});
        CHECK(run.status() == Status::ok);
        const double flight = 2 * std::sqrt(2e-5 / gravity);
        REQUIRE(run.events.size() == static_cast<std::size_t>(1 / flight + 0.5));
        for (std::size_t k = 0; k < run.events.size(); ++k)
            CHECK_THAT(run.events[k].t, Catch::WithinAbs((static_cast<double>(k) + 0.5) * flight, 1e-9));
    };
    check(Dop853{.tolerance = 1e-10});
    check(Tsit5{.tolerance = 1e-8});
    check(Rk4{.step = 0.01});
}

TEST_CASE("a ball that loses all its speed against a table that shakes lies on it, or is thrown up where it goes down")
{
    // The table comes up and goes down again within one step of most of these methods.
    const auto check = [](double amplitude, double frequency, double phase, const auto& method) {
        const auto height = [=](double t) { return amplitude * std::sin(frequency * t + phase); };
        const auto speed = [=](double t) { return frequency * amplitude * std::cos(frequency * t + phase); };
        const Run<Ball> run = dropped_on(moving_floor(0, height, speed), method, 3);
        INFO("frequency " << frequency << ", phase " << phase << ", end " << run.t);
        for (const auto& bounce : run.events) {
            const bool last = &bounce == &run.events.back(), ends = last && run.status() == Status::zeno;
            const double lift = frequency * frequency * height(bounce.t) - gravity;
            CHECK(std::abs(bounce.state[0] - height(bounce.t)) < 1e-13);
            if (ends) {
                CHECK(lift < 1e-3);
                REQUIRE(run.events.size() > 1);
                CHECK_THAT(bounce.t, Catch::WithinAbs(run.events[run.events.size() - 2].t, 1e-12));
            } else if (&bounce + 1 != &run.events.back() || run.status() == Status::ok) {
                CHECK(lift > -1e-3);
            }
        }
        CHECK((run.status() == Status::zeno || run.t == 3));
        CHECK(run.state[0] - height(run.t) > -1e-13);
        return run.status();
    };
    int rests = 0, runs = 0;
    for (const double frequency : {25.0, 60.0})
        for (double phase = 0; phase < 6; phase += 0.5) {
            for (const Status status : {check(0.02, frequency, phase, Dop853{.tolerance = 1e-10}),
                                        check(0.02, frequency, phase, Dopri5{.tolerance = 1e-8}),
                                        check(0.02, frequency, phase, Rk4{.step = 0.01})})
                ++runs, rests += status == Status::zeno;
        }
    CHECK(rests > runs / 2);
    CHECK(check(0.02, 25, 0, Dop853{.tolerance = 1e-10}) == Status::zeno);
    CHECK(check(0.001, 25, 0, Tsit5{.tolerance = 1e-8}) == Status::zeno);
}
