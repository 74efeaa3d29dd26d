// SPDX-License-Identifier: GPL-2.0-or-later
/// Events of an instant: at a start, behind another event's jump, on a plateau, at a touch; round by round.
#include "lagen/lagen.hpp"
#include "runtime/ball.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::problems;

namespace {

double height(double, const BallState& s)
{
    return s[0];
}

BallRequest floor_that_throws_back(double e)
{
    return {.direction = Crossing::falling, .when = height, .jump = [e](double, const BallState& s) {
                return BallState(s[0], -e * s[1]);
            }};
}

const BallRequest floor_that_stops{.direction = Crossing::falling, .stop = true, .when = height};

Run<Ball> thrown(double x, double v, const std::vector<BallRequest>& events, double end = 0.1)
{
    return integrate(Ball{}, BallState(x, v), {0.0, end}, Dop853{.tolerance = 1e-10}, {.events = events});
}

/// Three balls on a line, each with a place and a velocity, which nothing accelerates.
struct Cradle {
    using Scalar = double;
    using State = Eigen::Matrix<double, 6, 1>;
    static constexpr int dimension = 6;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double u = s[3], v = s[4], w = s[5];
        ds << u, v, w, 0, 0, 0;
        return Status::ok;
    }
};
using CradleRequest = EventRequest<double, Cradle::State>;

/// Balls k and k + 1 hit each other, elastically.
CradleRequest hit(int k, double mass, double next_mass)
{
    return {.direction = Crossing::falling,
            .when = [k](double, const Cradle::State& s) { return s[k + 1] - s[k]; },
            .jump =
                [=](double, const Cradle::State& s) {
                    Cradle::State after = s;
                    const double centre = (mass * s[k + 3] + next_mass * s[k + 4]) / (mass + next_mass);
                    after[k + 3] = 2 * centre - s[k + 3];
                    after[k + 4] = 2 * centre - s[k + 4];
                    return after;
                }};
}

/// Times of the events of a function of time alone, by any method.
template <class Method>
std::vector<double> times_of(double (*when)(double), Crossing direction, const Method& method, double end = 2)
{
    const std::array<BallRequest, 1> events{
        {{.direction = direction, .when = [when](double t, const BallState&) { return when(t); }}}};
    std::vector<double> times;
    for (const auto& found :
         integrate(Ball{}, BallState(0, 0), {end < 0 ? -end : 0.0, end < 0 ? 0.0 : end}, method, {.events = events})
             .events)
        times.push_back(found.t);
    return times;
}

template <class Check>
void with_every_method(const Check& check)
{
    check(Dop853{.tolerance = 1e-10});
    check(Dopri5{.tolerance = 1e-8});
    check(Rk4{.step = 0.25});
    check(Rk4{.step = 0.01});
    check(Gauss4{.step = 0.1});
    check(Radau5{.tolerance = 1e-8});
}

} // namespace

TEST_CASE("a ball that starts on its floor and falls is thrown back there")
{
    for (const double x : {0.0, -1e-11}) {
        const auto run = thrown(x, -1, {floor_that_throws_back(0.9)});
        CHECK(run.status() == Status::ok);
        REQUIRE(run.events.size() == 1);
        CHECK(run.events[0].t == 0);
        CHECK(run.events[0].state == BallState(x, -1));
        CHECK(run.events[0].after == BallState(x, 0.9));
        CHECK_THAT(run.state[0], Catch::WithinAbs(x + 0.09 - gravity * 0.005, 1e-14));
        CHECK(run.starts_on.empty());
    }
    CHECK(thrown(0, 1, {floor_that_throws_back(0.9)}).events.empty());
    CHECK(thrown(0, 1, {floor_that_throws_back(0.9)}).starts_on.empty());
    const auto back = integrate(Ball{}, BallState(0, 1), {0.0, -0.1}, Rk4{.step = 0.01},
                                {.events = std::array<BallRequest, 1>{floor_that_throws_back(1)}});
    REQUIRE(back.events.size() == 1);
    CHECK(back.state[0] > 0);
}

TEST_CASE("a ball at rest on its floor has a first change, which is down: zeno at the start")
{
    const auto run = thrown(0, 0, {floor_that_throws_back(0.9)});
    CHECK(run.status() == Status::zeno);
    CHECK(run.t < 1e-12);
    CHECK(std::abs(run.state[0]) < 1e-15);
}

TEST_CASE("events without a jump, or of any direction, do not happen at a start, and the run says on which it starts")
{
    for (const double x : {0.0, -1e-18}) {
        const auto run = thrown(x, -1, {floor_that_stops, {.when = height}});
        CHECK(run.status() == Status::ok);
        CHECK(run.events.empty());
        CHECK(run.starts_on == std::vector<std::size_t>{0, 1});
    }
    CHECK(thrown(-0.5, -1, {floor_that_throws_back(0.9)}).starts_on == std::vector<std::size_t>{0});
    CHECK(thrown(0.5, -1, {floor_that_stops}).starts_on.empty());
}

TEST_CASE("an event on whose surface another one's jump lands happens where the motion goes on through it")
{
    const BallRequest lift{.direction = Crossing::rising,
                           .when = [](double t, const BallState&) { return t - 0.5; },
                           .jump = [](double, const BallState& s) { return BallState(0, s[1]); }};
    for (const bool first : {true, false}) {
        const std::vector<BallRequest> events =
            first ? std::vector{lift, floor_that_throws_back(0.5)} : std::vector{floor_that_throws_back(0.5), lift};
        const auto run = thrown(9, 0, events, 0.6);
        REQUIRE(run.events.size() == 2);
        CHECK(run.events[1].state == BallState(0, run.events[0].state[1]));
        CHECK_THAT(run.events[1].after[1], Catch::WithinAbs(0.25 * gravity, 1e-13));
        CHECK(run.events[0].after == run.events[1].after);
        CHECK(run.state[0] > 0);
    }
    const auto stopped = thrown(9, 0, {floor_that_stops, lift}, 0.6);
    CHECK(stopped.status() == Status::stopped_by_event);
    CHECK(stopped.state[0] == 0);
    CHECK_THAT(stopped.t, Catch::WithinAbs(0.5, 1e-15));
}

TEST_CASE("a function that another event's jump takes from one side to the other has crossed")
{
    const BallRequest mirror{.direction = Crossing::rising,
                             .when = [](double t, const BallState&) { return t - 0.25; },
                             .jump = [](double, const BallState& s) { return BallState(-s[0], s[1]); }};
    const auto run = thrown(9, 0,
                            {mirror,
                             {.direction = Crossing::falling, .when = height},
                             {.when = height},
                             {.direction = Crossing::rising, .when = height}},
                            0.5);
    REQUIRE(run.events.size() == 3);
    CHECK(run.events[1].request == 1);
    CHECK(run.events[2].request == 2);
    CHECK(run.events[2].t == run.events[0].t);
}

TEST_CASE("Newton's cradle: a hit goes on through balls that touch, in any order of the requests")
{
    Cradle::State s;
    s << -1, 0, 0, 1, 0, 0;
    for (const bool in_order : {true, false})
        for (const double start : {-1.0, 0.0}) {
            s[0] = start;
            const std::array<CradleRequest, 2> events{hit(in_order ? 0 : 1, 1, 1), hit(in_order ? 1 : 0, 1, 1)};
            const auto run = integrate(Cradle{}, s, {0.0, 2.0}, Rk4{.step = 0.3}, {.events = events});
            CHECK(run.status() == Status::ok);
            REQUIRE(run.events.size() == 2);
            CHECK_THAT(run.state[5], Catch::WithinAbs(1, 1e-14));
            CHECK(run.state[3] == 0);
            CHECK_THAT(run.state[2], Catch::WithinAbs(2 + start, 1e-12));
        }
    // The last one has three times the mass: half of the speed comes back through the middle one.
    s[0] = -1;
    const std::array<CradleRequest, 2> heavy{hit(0, 1, 1), hit(1, 1, 3)};
    const auto run = integrate(Cradle{}, s, {0.0, 2.0}, Rk4{.step = 0.3}, {.events = heavy});
    REQUIRE(run.events.size() == 3);
    CHECK(run.events[2].request == 0);
    CHECK_THAT(run.state[3], Catch::WithinAbs(-0.5, 1e-14));
    CHECK_THAT(run.state[5], Catch::WithinAbs(0.5, 1e-14));
}

TEST_CASE("two events that drive each other without end are zeno after 1000 rounds, in the state before the first")
{
    const BallRequest up{.direction = Crossing::falling, .when = height, .jump = [](double, const BallState&) {
                             return BallState(0, 1);
                         }};
    const BallRequest down{.direction = Crossing::rising, .when = height, .jump = [](double, const BallState&) {
                               return BallState(0, -1);
                           }};
    const auto run = thrown(1, 0, {up, down}, 9);
    CHECK(run.status() == Status::zeno);
    CHECK_THAT(run.t, Catch::WithinAbs(std::sqrt(2 / gravity), 1e-13));
    CHECK_THAT(run.state[1], Catch::WithinAbs(-std::sqrt(2 * gravity), 1e-12));
    CHECK(run.events.size() == 1);
    CHECK(run.events[0].after == run.state);
}

TEST_CASE("a touch that does not change the sign is no event, by any method, and a crossing that begins like one is")
{
    with_every_method([](const auto& method) {
        for (const Crossing direction : {Crossing::falling, Crossing::rising, Crossing::any}) {
            CHECK(times_of([](double t) { return (t - 1) * (t - 1); }, direction, method).empty());
            CHECK(times_of([](double t) { return -(t - 0.7) * (t - 0.7); }, direction, method).empty());
            CHECK(times_of([](double t) { return 0.5 - (t - t * t / 2); }, direction, method).empty());
            CHECK(times_of([](double t) { return (t - 1) * (t - 1); }, direction, method, -2).empty());
        }
        const auto cubic = times_of([](double t) { return (1 - t) * (1 - t) * (1 - t); }, Crossing::falling, method);
        REQUIRE(cubic.size() == 1);
        CHECK_THAT(cubic[0], Catch::WithinAbs(1, 1e-3));
        const auto line = times_of([](double t) { return 1 - t; }, Crossing::any, method);
        REQUIRE(line.size() == 1);
        CHECK_THAT(line[0], Catch::WithinAbs(1, 1e-14));
        const auto at_end = times_of([](double t) { return 2 - t; }, Crossing::any, method);
        CHECK(at_end.size() == 1);
    });
}

TEST_CASE("a function that stays at zero for a while crosses where it goes on, and not where it goes back")
{
    with_every_method([](const auto& method) {
        const auto through = [](double t) { return t < 0.6 ? 0.6 - t : t < 1.1 ? 0.0 : 1.1 - t; };
        for (const Crossing direction : {Crossing::falling, Crossing::any}) {
            const auto times = times_of(through, direction, method);
            REQUIRE(times.size() == 1);
            CHECK_THAT(times[0], Catch::WithinAbs(1.1, 1e-12));
        }
        const auto back = [](double t) { return t < 0.6 ? 0.6 - t : t < 1.1 ? 0.0 : t - 1.1; };
        for (const Crossing direction : {Crossing::falling, Crossing::rising, Crossing::any})
            CHECK(times_of(back, direction, method).empty());
    });
}

TEST_CASE("a function that is zero for a while from a start or a jump on crosses where it leaves zero")
{
    const BallRequest below{.direction = Crossing::falling,
                            .when = [](double, const BallState& s) { return std::min(s[0], 0.0); },
                            .jump = [](double, const BallState& s) { return BallState(s[0], -s[1] / 2); }};
    const BallRequest lift{.direction = Crossing::rising,
                           .when = [](double t, const BallState&) { return t - 0.3; },
                           .jump = [](double, const BallState&) { return BallState(0.5, -1); }};
    const BallRequest clock{.when = [](double t, const BallState&) { return t - 0.4; }};
    const double fall = (std::sqrt(1 + gravity) - 1) / gravity, flight = std::sqrt(1 + gravity) / gravity;
    with_every_method([&](const auto& method) {
        const auto times = [&](const BallState& start, const std::vector<BallRequest>& events, double end) {
            std::vector<double> found;
            const auto run = integrate(Ball{}, start, {0.0, end}, method, {.events = events});
            CHECK(run.status() == Status::ok);
            for (const auto& each : run.events) found.push_back(each.t);
            return found;
        };
        const auto thrown_down = times(BallState(0.5, -1), {below, clock}, 0.6);
        REQUIRE(thrown_down.size() == 3);
        CHECK_THAT(thrown_down[0], Catch::WithinAbs(fall, 1e-9));
        CHECK_THAT(thrown_down[2], Catch::WithinAbs(fall + flight, 1e-9));
        const auto lifted = times(BallState(0.8, 0), {below, lift, clock}, 0.6);
        REQUIRE(lifted.size() == 3);
        CHECK_THAT(lifted[2], Catch::WithinAbs(0.3 + fall, 1e-9));
    });
}

TEST_CASE("jumps at multiple zeros: a motion that goes on has crossed once, one that turns back crosses again")
{
    with_every_method([](const auto& method) {
        const auto cubic = [](double t, const BallState&) { return (t - 1) * (t - 1) * (t - 1); };
        const auto stop = [](double, const BallState& s) { return BallState(s[0], 0); };
        const std::array<BallRequest, 1> once{{{.direction = Crossing::rising, .when = cubic, .jump = stop}}};
        const auto through = integrate(Ball{}, BallState(0, 0), {0.0, 2.0}, method, {.events = once});
        CHECK(through.status() == Status::ok);
        CHECK(through.events.size() == 1);
        for (const int power : {3, 5}) {
            const auto high = [power](double, const BallState& s) { return std::pow(s[0] - 0.25, power); };
            const auto turn = [](double, const BallState& s) { return BallState(s[0], -s[1] / 2); };
            const std::array<BallRequest, 1> floor{{{.direction = Crossing::falling, .when = high, .jump = turn}}};
            const auto back = integrate(Ball{}, BallState(1.25, 0), {0.0, 1.0}, method, {.events = floor});
            const double fall = std::sqrt(2 / gravity);
            CHECK(back.status() == Status::ok);
            REQUIRE(back.events.size() == 2);
            // Its time is known as well as the function may be told from zero: (1e-10)^(1/5) = 0.01.
            CHECK_THAT(back.events[1].t, Catch::WithinAbs(2 * fall, 3e-3));
        }
    });
    // One that loses its speed falls through the zero.
    const auto high = [](double, const BallState& s) { return s[0] * s[0] * s[0]; };
    const auto lost = [](double, const BallState& s) { return BallState(s[0], 0); };
    CHECK(thrown(1, 0, {{.direction = Crossing::falling, .when = high, .jump = lost}}, 1).status() == Status::zeno);
}
