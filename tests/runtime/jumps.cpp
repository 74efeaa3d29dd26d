// SPDX-License-Identifier: GPL-2.0-or-later
/// Jumps at events: a ball on a floor against its closed form, by every method; which side of its zero a function is on
/// behind a jump; when jumps pile up.
#include "lagen/lagen.hpp"
#include "runtime/ball.hpp"
#include "runtime/pendulum.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::problems;

namespace {

/// (x, v) of two of them.
struct Two {
    using Scalar = double;
    using State = Eigen::Matrix<double, 4, 1>;
    static constexpr int dimension = 4;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double v = s[1], w = s[3];
        ds << v, -gravity, w, -gravity;
        return Status::ok;
    }
};

BallRequest bounce(double e, double floor = 0)
{
    return {.direction = Crossing::falling,
            .when = [floor](double, const BallState& s) { return s[0] - floor; },
            .jump = [e](double, const BallState& s) { return BallState(s[0], -e * s[1]); }};
}

/// Of a ball dropped from one metre: when it bounces for the (k + 1)-th time, and how fast it is then.
struct Bounces {
    double e, first = std::sqrt(2 / gravity);
    [[nodiscard]] double time(std::size_t k) const
    {
        return first * (1 + 2 * e * (1 - std::pow(e, static_cast<double>(k))) / (1 - e));
    }
    [[nodiscard]] double speed(std::size_t k) const { return gravity * first * std::pow(e, static_cast<double>(k)); }
    [[nodiscard]] double limit() const { return first * (1 + e) / (1 - e); }
};

template <class Method>
Run<Ball> dropped(const Method& method, double e, double end, double floor = 0)
{
    const std::array<BallRequest, 1> events{bounce(e, floor)};
    return integrate(Ball{}, BallState(1 + floor, 0), {0.0, end}, method, {.events = events});
}

} // namespace

TEST_CASE("a ball bounces at the times of its closed form, by every kind of method")
{
    const Bounces exact{0.9};
    const auto check = [&](const auto& method, double accuracy) {
        const Run<Ball> run = dropped(method, 0.9, 6);
        CHECK(run.status() == Status::ok);
        REQUIRE(run.events.size() == 11);
        for (std::size_t k = 0; k < 11; ++k) {
            CHECK_THAT(run.events[k].t, Catch::WithinAbs(exact.time(k), accuracy));
            CHECK_THAT(run.events[k].state[1], Catch::WithinAbs(-exact.speed(k), 10 * accuracy));
            CHECK(run.events[k].after == BallState(run.events[k].state[0], -0.9 * run.events[k].state[1]));
        }
        CHECK(run.t == 6);
    };
    check(Dop853{.tolerance = 1e-10}, 1e-12);
    check(Dop853{.tolerance = 0.1, .first_step = 5}, 1e-12); // a step is longer than a flight
    check(Dopri5{.tolerance = 1e-10}, 1e-12);
    check(Tsit5{.tolerance = 1e-6}, 1e-12);
    check(Verner98{.tolerance = 1e-10}, 1e-12);
    check(Rkn86{.tolerance = 1e-10}, 1e-12);
    check(Rk4{.step = 0.01}, 1e-12);
    check(Rk4{.step = 2}, 1e-12);
    check(Rk4{.step = 0.01, .compensated = true}, 1e-12);
    check(LeapfrogKdk{.step = 0.01}, 1e-12);
    check(KahanLi8{.step = 0.05}, 1e-12);
    check(Gauss4{.step = 0.05}, 1e-12);
    check(Gauss12{.step = 0.5}, 1e-12);
    check(Radau5{.tolerance = 1e-8}, 1e-12);
    check(Radau5Fixed{.step = 0.1}, 1e-12);
}

TEST_CASE("infinitely many bounces end a run with zeno where the closed form says")
{
    for (const double e : {0.1, 0.5, 0.9, 0.99})
        for (const double floor : {0.0, 0.25}) {
            INFO("e = " << e << ", floor = " << floor);
            const Run<Ball> run = dropped(Dop853{.tolerance = 1e-10}, e, 1000, floor);
            CHECK(run.status() == Status::zeno);
            CHECK(!run);
            // where heights are rounded, bounces below the root of their rounding are not told apart
            const double accuracy = floor == 0 ? 1e-11 : 1e-7 / (1 - e);
            CHECK_THAT(run.t, Catch::WithinAbs(Bounces{e}.limit(), accuracy * Bounces{e}.limit()));
            CHECK(run.failed_at == run.t);
            CHECK(std::abs(run.state[0] - floor) < 1e-12);
            CHECK(std::abs(run.state[1]) < 1e-5);
        }
    const auto check = [](const auto& method, double e) {
        const Run<Ball> run = dropped(method, e, 1000);
        CHECK(run.status() == Status::zeno);
        CHECK_THAT(run.t, Catch::WithinAbs(Bounces{e}.limit(), 1e-12 * Bounces{e}.limit()));
    };
    check(Verner98{.tolerance = 1e-10}, 0.9);
    check(Rk4{.step = 0.01}, 0.9);
    check(Rk4{.step = 0.1}, 0.99);
    check(Gauss4{.step = 0.1}, 0.9);
}

TEST_CASE("a ball that loses all its speed lies on the floor, which is zeno at its first bounce")
{
    const auto check = [](const auto& method) {
        const Run<Ball> run = dropped(method, 0, 10);
        CHECK(run.status() == Status::zeno);
        CHECK_THAT(run.t, Catch::WithinAbs(Bounces{0}.first, 1e-12));
        CHECK(std::abs(run.state[0]) < 1e-12);
    };
    check(Dop853{.tolerance = 1e-10});
    check(Rk4{.step = 0.01});
}

TEST_CASE("a ball thrown from the floor comes back, also within one step")
{
    const std::array<BallRequest, 1> events{bounce(0.5)};
    for (const double v : {5.0, 1e-3}) {
        const auto run =
            integrate(Ball{}, BallState(0, v), {0.0, 2.5 * v / gravity}, Rk4{.step = 1}, {.events = events});
        REQUIRE(run.events.size() == 1);
        CHECK_THAT(run.events[0].t, Catch::WithinAbs(2 * v / gravity, 1e-14));
        CHECK(run.status() == Status::ok);
    }
}

TEST_CASE("a request that stops the run stops it before its jump, at the crossing that it counts to")
{
    std::array<BallRequest, 1> events{bounce(0.9)};
    events[0].stop = true;
    events[0].count = 3;
    const auto run = integrate(Ball{}, BallState(1, 0), {0.0, 9.0}, Dop853{.tolerance = 1e-10}, {.events = events});
    CHECK(run.status() == Status::stopped_by_event);
    REQUIRE(run.events.size() == 3);
    CHECK_THAT(run.t, Catch::WithinAbs(Bounces{0.9}.time(2), 1e-12));
    CHECK(run.state[1] < 0);
    CHECK(run.events[2].after == run.events[2].state);
}

TEST_CASE("rows, also those at events, and the solution have the state before a jump at its time; observers see both")
{
    std::array<BallRequest, 1> events{bounce(0.9)};
    const auto once = integrate(Ball{}, BallState(1, 0), {0.0, 1.0}, Dop853{.tolerance = 1e-10}, {.events = events});
    REQUIRE(once.events.size() == 1);
    const double t = once.events[0].t;
    events[0].row = true;
    const std::array<double, 3> at{0.25, t, 0.75};
    std::vector<std::pair<double, double>> seen;
    const auto run = integrate(Ball{}, BallState(1, 0), {0.0, 1.0}, Dop853{.tolerance = 1e-10},
                               {.at = at, .events = events, .dense = true});
    CHECK(run.times == std::vector<double>{0.25, t, t, 0.75});
    CHECK(run.states[1][1] < 0);
    CHECK(run.states[2][1] < 0);
    CHECK(run.states[3][1] > 0);
    CHECK(run.solution(t)[1] < 0);
    CHECK(run.solution(std::nextafter(t, 1))[1] > 0);
    CHECK_THAT(run.solution(0.25)[1], Catch::WithinAbs(-0.25 * gravity, 1e-13));
    CHECK_THAT(run.solution(0.75)[0], Catch::WithinAbs(run.states[3][0], 1e-13));
    struct Observer {
        std::vector<double> velocities{};
        int jumps = 0;
        void operator()(double, const BallState& s) { velocities.push_back(s[1]); }
        void jump(double, const BallState& from, const BallState& to)
        {
            ++jumps;
            CHECK(to[1] == -0.9 * from[1]);
            CHECK(velocities.back() == from[1]);
        }
    } observer;
    const auto watched =
        integrate(Ball{}, BallState(1, 0), {0.0, 1.0}, Dop853{.tolerance = 1e-10}, {.events = events}, observer);
    CHECK(watched.states.size() == 1); // of the event
    CHECK(observer.jumps == 1);
    CHECK(std::count_if(observer.velocities.begin(), observer.velocities.end(), [](double v) { return v > 0; }) >= 1);
}

TEST_CASE("an integrator that is restarted goes on as a new one")
{
    const auto check = [](const auto& method) {
        Integrator integrator(Ball{}, BallState(1, 0), 0.0, method);
        REQUIRE(integrator.advance_to(0.3) == Status::ok);
        const std::size_t before = integrator.rhs_calls();
        REQUIRE(integrator.restart(BallState(0.2, 3), 0.5) == Status::ok);
        REQUIRE(integrator.advance_to(1) == Status::ok);
        Integrator fresh(Ball{}, BallState(0.2, 3), 0.5, method);
        REQUIRE(fresh.advance_to(1) == Status::ok);
        CHECK(integrator.state() == fresh.state());
        CHECK(integrator.rhs_calls() == before + fresh.rhs_calls());
        CHECK(integrator.restart(BallState(std::nan(""), 0), 1) == Status::non_finite);
    };
    check(Dop853{.tolerance = 1e-10});
    check(Rk4{.step = 0.01});
    check(Gauss8{.step = 0.1});
    check(Radau5{.tolerance = 1e-8});
}

TEST_CASE("a jump that lets the motion through leaves it on the other side: light that is broken")
{
    // Half the speed below x = 0: 0.2 seconds later it is at -sqrt(2 g)/2 0.2 - g/2 0.2^2, and crosses nothing more.
    const std::array<BallRequest, 1> surface{
        {{.when = [](double, const BallState& s) { return s[0]; },
          .jump = [](double, const BallState& s) { return BallState(s[0], s[1] * (s[1] < 0 ? 0.5 : 2)); }}}};
    const double t = std::sqrt(2 / gravity), beyond = 0.2;
    for (const double tolerance : {1e-10, 1.0}) {
        const auto run =
            integrate(Ball{}, BallState(1, 0), {0.0, t + beyond}, Dop853{.tolerance = tolerance}, {.events = surface});
        CHECK(run.status() == Status::ok);
        CHECK(run.events.size() == 1);
        const double x = -gravity * beyond * (t + beyond) / 2;
        CHECK_THAT(run.state[0], Catch::WithinAbs(x, 1e-13));
    }
}

TEST_CASE("two balls that bounce at one instant both bounce, the requests in their order")
{
    using TwoRequest = EventRequest<double, Two::State>;
    const auto ball = [](int k, double floor) {
        return TwoRequest{.direction = Crossing::falling,
                          .when = [k, floor](double, const Two::State& s) { return s[k] - floor; },
                          .jump =
                              [k](double, const Two::State& s) {
                                  Two::State after = s;
                                  after[k + 1] *= -0.8;
                                  return after;
                              }};
    };
    for (const double floor : {0.0, 0.1, 1 / 3.0, 7.0}) {
        const std::array<TwoRequest, 2> events{ball(0, 0), ball(2, floor)};
        const auto run = integrate(Two{}, Two::State(1, 0, 1 + floor, 0), {0.0, 3.5}, Dop853{.tolerance = 1e-10},
                                   {.events = events});
        INFO(floor);
        CHECK(run.status() == Status::ok);
        CHECK(run.events.size() % 2 == 0);
        CHECK(run.events.size() >= 16);
        CHECK_THAT(run.state[0], Catch::WithinAbs(run.state[2] - floor, 1e-9));
        CHECK(run.state[2] > floor);
    }
}

TEST_CASE("a jump may lead onto the zero of another event, which the motion then leaves")
{
    // From x = 1 on the way up to x = 0: behind it the ball rises from there, and it falls back through x = 0.
    const std::array<BallRequest, 2> events{
        {{.direction = Crossing::rising,
          .stop = false,
          .when = [](double, const BallState& s) { return s[0] - 1; },
          .jump = [](double, const BallState& s) { return BallState(0, s[1] / 4); }},
         {.direction = Crossing::falling, .stop = true, .when = [](double, const BallState& s) { return s[0]; }}}};
    for (const double h : {0.01, 0.5}) {
        const auto run = integrate(Ball{}, BallState(0.5, 4), {0.0, 9.0}, Rk4{.step = h}, {.events = events});
        CHECK(run.status() == Status::stopped_by_event);
        REQUIRE(run.events.size() == 2);
        CHECK_THAT(run.t - run.events[0].t, Catch::WithinAbs(2 * run.events[0].after[1] / gravity, 1e-14));
    }
}

TEST_CASE("a crossing there and back between two looks of an adaptive step is found at its turning point")
{
    // The only step, in four pieces: the dip of width 0.04 lies inside one of them.
    const std::array<BallRequest, 2> dips{
        {{.when = [](double t, const BallState&) { return (t - 0.6) * (t - 0.64); }},
         {.when = [](double t, const BallState&) { return (t - 0.6) * (t - 0.6) + 1e-9; }}}};
    const auto run = integrate(Ball{}, BallState(0.1, 0), {0.0, 1.0},
                               Dop853{.tolerance = 1e9, .first_step = 1, .max_step = 1}, {.events = dips});
    CHECK(run.steps == 1);
    REQUIRE(run.events.size() == 2);
    CHECK_THAT(run.events[0].t, Catch::WithinAbs(0.6, 1e-15));
    CHECK_THAT(run.events[1].t, Catch::WithinAbs(0.64, 1e-15));
}

TEST_CASE("a pendulum that hits a wall keeps e times its speed, as precisely as its method integrates")
{
    // From rest at th = 1 to a wall at th = -1/2 and back: w^2/2 = cos(1/2) - cos(1) there.
    using Pendulum = problems::Pendulum<double>;
    using State = Pendulum::State;
    const std::array<EventRequest<double, State>, 1> wall{
        {{.direction = Crossing::falling,
          .when = [](double, const State& s) { return s[0] + 0.5; },
          .jump = [](double, const State& s) { return State(s[0], -s[1]); }}}};
    const double w = std::sqrt(2 * (std::cos(0.5) - std::cos(1.0)));
    const auto run = integrate(Pendulum{}, State(1, 0), {0.0, 100.0}, Dop853{.tolerance = 1e-12}, {.events = wall});
    REQUIRE(run.events.size() > 15);
    const double period = run.events[1].t - run.events[0].t;
    for (std::size_t k = 0; k < run.events.size(); ++k) {
        CHECK_THAT(run.events[k].state[1], Catch::WithinAbs(-w, 1e-9));
        CHECK_THAT(run.events[k].t, Catch::WithinAbs((static_cast<double>(k) + 0.5) * period, 1e-8));
    }
}

TEST_CASE("jumps are bounded, and a state behind one that is no number ends the run before it")
{
    const std::array<BallRequest, 1> elastic{bounce(1)};
    const auto many = integrate(Ball{}, BallState(1, 0), {0.0, 1e9}, Dop853{.tolerance = 1e-10},
                                {.events = elastic, .max_jumps = 100});
    CHECK(many.status() == Status::too_many_steps);
    CHECK(many.events.size() == 101);
    const std::array<BallRequest, 1> broken{bounce(std::nan(""))};
    const auto none = integrate(Ball{}, BallState(1, 0), {0.0, 9.0}, Dop853{}, {.events = broken});
    CHECK(none.status() == Status::non_finite);
    CHECK(none.state == none.events.at(0).state);
}
