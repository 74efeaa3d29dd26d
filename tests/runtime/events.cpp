// SPDX-License-Identifier: GPL-2.0-or-later
/// Events: location, direction, count, stop, order, own functions.
#include "lagen/lagen.hpp"
#include "runtime/pendulum.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Pendulum = problems::Pendulum<double>;
using State = Pendulum::State;
using Request = EventRequest<double, State>;

namespace {

/// Period of the pendulum released at rest at th = 1: 4 K(sin^2(1/2)) by the arithmetic-geometric mean.
double period()
{
    long double a = 1, b = std::cos(0.5L);
    while (a - b > 1e-19L * a) {
        const long double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return static_cast<double>(2 * std::acos(-1.0L) / a);
}

const State start(1.0, 0.0);

/// x' = 1: in steps of 1/4 every value is exact.
struct Line {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    Status rhs(double, const State&, State& ds) const noexcept
    {
        ds[0] = 1;
        return Status::ok;
    }
};

} // namespace

TEST_CASE("Crossings of the pendulum are found to 1e-12 with every dense output")
{
    const std::array<Request, 1> bottom{{{.index = 0}}};
    const auto check = [&](const auto& method, double accuracy) {
        const auto run = integrate(Pendulum{}, start, {0.0, 10.0}, method, {.events = bottom});
        REQUIRE(run.events.size() == 3);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK_THAT(run.events[k].t, Catch::WithinAbs(period() * (2 * static_cast<double>(k) + 1) / 4, accuracy));
            CHECK(std::abs(run.events[k].state[0]) < 1e-14);
        }
    };
    check(Dop853{.tolerance = 1e-14}, 1e-12);
    check(Dopri5{.tolerance = 1e-14, .max_step = 1e-3}, 1e-12);
    check(Tsit5{.tolerance = 1e-14, .max_step = 1e-3}, 1e-12);
    check(Yoshida6{.step = 0.005}, 1e-12);
    check(Rk4{.step = 0.0005}, 1e-12);
    check(Gauss2{.step = 2e-5}, 1e-9);
    check(Gauss6{.step = 0.02}, 1e-12);
    check(Gauss8{.step = 0.1}, 1e-12);
    check(Radau3Fixed{.step = 0.002}, 1e-8);
    check(Radau5Fixed{.step = 0.002}, 1e-12);
    check(Radau5{.tolerance = 1e-13, .max_step = 1e-3}, 1e-12);
}

TEST_CASE("Direction and count choose crossings; stop ends the run there")
{
    const std::array<Request, 1> rising{{{.index = 0, .direction = Crossing::rising}}};
    const auto one = integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{.tolerance = 1e-13}, {.events = rising});
    REQUIRE(one.events.size() == 1);
    CHECK_THAT(one.events[0].t, Catch::WithinAbs(period() * 0.75, 1e-11));
    CHECK(one.status() == Status::ok);

    const std::array<Request, 1> second{{{.index = 0, .direction = Crossing::falling, .stop = true, .count = 2}}};
    const std::array<double, 3> at{1.0, 5.0, 9.0};
    const auto stopped =
        integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{.tolerance = 1e-13}, {.at = at, .events = second});
    CHECK(stopped.status() == Status::stopped_by_event);
    CHECK(static_cast<bool>(stopped));
    CHECK(stopped.events.size() == 2);
    CHECK_THAT(stopped.t, Catch::WithinAbs(period() * 1.25, 1e-11));
    CHECK(stopped.state == stopped.events[1].state);
    CHECK(stopped.times == std::vector<double>{1.0, 5.0});
}

TEST_CASE("Two events in one step are both found, in order of time")
{
    // th = 1/2 is passed before th = 1/4; the requests have them the other way round.
    const std::array<Request, 2> both{{
        {.when = [](double, const State& s) { return s[0] - 0.25; }},
        {.when = [](double, const State& s) { return s[0] - 0.5; }},
    }};
    const auto run = integrate(Pendulum{}, start, {0.0, 2.0}, Rk4{.step = 2.0}, {.events = both});
    CHECK(run.steps == 1);
    REQUIRE(run.events.size() == 2);
    CHECK(run.events[0].request == 1);
    CHECK(run.events[1].request == 0);
    CHECK(run.events[0].t < run.events[1].t);
}

TEST_CASE("There and back within one adaptive step counts as two crossings")
{
    // An event function of time alone, with both zeros inside the only step.
    const std::array<Request, 1> bump{{{.when = [](double t, const State&) { return (t - 0.2) * (t - 0.6); }}}};
    const auto run = integrate(Pendulum{}, State(0.1, 0), {0.0, 1.0},
                               Dop853{.tolerance = 1e9, .first_step = 1, .max_step = 1}, {.events = bump});
    CHECK(run.steps == 1);
    REQUIRE(run.events.size() == 2);
    CHECK_THAT(run.events[0].t, Catch::WithinAbs(0.2, 1e-15));
    CHECK_THAT(run.events[1].t, Catch::WithinAbs(0.6, 1e-15));
}

TEST_CASE("Events of a run backward in time are found with the directions of the run")
{
    const std::array<Request, 1> falling{{{.index = 0, .direction = Crossing::falling, .stop = true}}};
    const auto run = integrate(Pendulum{}, start, {0.0, -10.0}, Dop853{.tolerance = 1e-13}, {.events = falling});
    CHECK(run.status() == Status::stopped_by_event);
    CHECK_THAT(run.t, Catch::WithinAbs(-period() / 4, 1e-11));
}

TEST_CASE("A start on an event is not a crossing")
{
    const std::array<Request, 1> bottom{{{.index = 0, .stop = true}}};
    const auto run = integrate(Pendulum{}, State(0, 1), {0.0, 1.0}, Dop853{}, {.events = bottom});
    CHECK(run.status() == Status::ok);
    CHECK(run.events.empty());
    CHECK(run.starts_on == std::vector<std::size_t>{0});
}

TEST_CASE("A gap where an event's function is not a number hides no crossing")
{
    // -1 until t = 1.1, 1 from t = 2.3 on; a gap to begin with hides nothing either
    const auto gap = [](double t, const Line::State&) {
        return t < 1.1 ? -1.0 : t < 2.3 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    };
    const auto late = [](double t, const Line::State&) { return std::sqrt(t - 0.5) - 1; };
    const std::array<EventRequest<double, Line::State>, 2> requests{
        {{.direction = Crossing::rising, .when = gap}, {.when = late}}};
    const auto run = integrate(Line{}, Line::State(0), {0.0, 4.0}, Rk4{.step = 0.25}, {.events = requests});
    CHECK(run.status() == Status::ok);
    REQUIRE(run.events.size() == 2);
    CHECK(run.events[0].request == 1);
    CHECK_THAT(run.events[0].t, Catch::WithinAbs(1.5, 1e-12));
    CHECK(run.events[1].request == 0);
    CHECK_THAT(run.events[1].t, Catch::WithinAbs(2.3, 1e-12));
}

TEST_CASE("A crossing before a gap is found where it is, with steps of any length")
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    using When = EventRequest<double, Line::State>;
    const auto root = [](double t, const Line::State&) { return std::sqrt(1 - t) - 0.3; };      // 0.91
    const auto logarithm = [](double t, const Line::State&) { return std::log(1.05 - t) + 1; }; // 0.682..
    const auto step = [](double t, const Line::State&) { return t < 1.1 ? -1.0 : t < 1.2 || t > 1.4 ? 1.0 : nan; };
    const auto twice = [](double t, const Line::State&) {
        return t < 1.05 ? -1.0 : t < 1.3 ? 1.0 : t < 1.6 ? nan : -1.0;
    };
    const std::array<When, 4> requests{{{.when = root}, {.when = logarithm}, {.when = step}, {.when = twice}}};
    for (const double h : {0.125, 0.25, 0.5}) {
        INFO(h);
        const auto run = integrate(Line{}, Line::State(0), {0.0, 2.0}, Rk4{.step = h}, {.events = requests});
        std::array<std::vector<double>, 4> found;
        for (const auto& event : run.events) found[event.request].push_back(event.t);
        CHECK_THAT(found[0], Catch::Approx(std::vector{0.91}).margin(1e-12));
        CHECK_THAT(found[1], Catch::Approx(std::vector{1.05 - std::exp(-1.0)}).margin(1e-12));
        CHECK_THAT(found[2], Catch::Approx(std::vector{1.1}).margin(1e-12));
        CHECK_THAT(found[3], Catch::Approx(std::vector{1.05, 1.6}).margin(1e-12));
    }
    for (const double h : {1.0, 2.0}) {
        const auto run =
            integrate(Line{}, Line::State(0), {0.0, 2.0}, Rk4{.step = h}, {.events = std::span(requests).first(3)});
        REQUIRE(run.events.size() == 3);
        CHECK_THAT(run.events[1].t, Catch::WithinAbs(0.91, 1e-12));
        CHECK_THAT(run.events[2].t, Catch::WithinAbs(1.1, 1e-12));
    }
}

TEST_CASE("Events of one instant are all reported, in the order of the requests, also where one of them stops the run")
{
    const auto half = [](double, const State& s) { return s[0] - 0.5; };
    const auto quarter = [](double, const State& s) { return s[0] - 0.25; };
    const std::array<Request, 4> requests{{
        {.stop = true, .when = half},
        {.when = quarter},
        {.when = half},
        {.stop = true, .count = 1, .when = half},
    }};
    const auto check = [&](const auto& method) {
        const auto run = integrate(Pendulum{}, start, {0.0, 9.0}, method, {.events = requests});
        CHECK(run.status() == Status::stopped_by_event);
        REQUIRE(run.events.size() == 3);
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
            CHECK(run.events[k].t == run.t);
            CHECK(run.events[k].state == run.state);
        }
        CHECK(run.events[1].request == 2);
        CHECK(run.events[2].request == 3);
    };
    check(Dop853{.tolerance = 1e-10});
    check(Rk4{.step = 0.01});
    check(Rk4{.step = 2});
}

TEST_CASE(
    "Arriving at zero at the end of a step is one crossing, leaving it none, touching it from above none in between")
{
    using LineRequest = EventRequest<double, Line::State>;
    const auto count = [](auto function) {
        const std::array<LineRequest, 1> request{{{.when = function}}};
        return integrate(Line{}, Line::State(0.0), {0.0, 2.0}, Rk4{.step = 0.25}, {.events = request}).events.size();
    };
    CHECK(count([](double t, const Line::State&) { return t - 0.5; }) == 1);
    CHECK(count([](double t, const Line::State&) { return t; }) == 0);
    CHECK(count([](double t, const Line::State&) { return (t - 0.6) * (t - 0.6); }) == 0);
    CHECK(count([](double t, const Line::State&) { return (t - 0.6) * (t - 0.7); }) == 0); // both in one fixed step
    CHECK(count([](double t, const Line::State&) { return (t - 0.6) * (t - 0.8); }) == 2);
    CHECK(count([](double, const Line::State&) { return std::nan(""); }) == 0);
}
