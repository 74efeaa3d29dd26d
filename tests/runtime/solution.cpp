// SPDX-License-Identifier: GPL-2.0-or-later
/// Dense solutions: integrate(.., {.dense = true}).
#include "lagen/integrate.hpp"
#include "runtime/pendulum.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace lagen;

namespace {

using Pendulum = problems::Pendulum<double>;
using State = Pendulum::State;
const State start(1, 0);

State reference(double t)
{
    return integrate(Pendulum{}, start, {0.0, t}, Dop853{.tolerance = 1e-14}).state;
}

} // namespace

TEST_CASE("A dense solution is the solution at every time, for every method, forwards and backwards")
{
    const auto check = [](const auto& method, double accuracy) {
        for (const double end : {3.0, -3.0}) {
            const auto plain = integrate(Pendulum{}, start, {0.0, end}, method);
            const auto run = integrate(Pendulum{}, start, {0.0, end}, method, {.dense = true});
            CHECK(run.state == plain.state);
            CHECK(run.steps == plain.steps);
            CHECK(run.solution.times().size() == run.steps + 1);
            CHECK(run.solution.start() == 0);
            CHECK(run.solution.end() == end);
            CHECK(run.solution(0) == start);
            CHECK(run.solution(end) == run.state);
            double worst = 0;
            for (int k = 1; k < 40; ++k) {
                const double t = end * k / 40;
                worst = std::max(worst, (run.solution(t) - reference(t)).norm());
                CHECK(run(t) == run.solution(t));
            }
            CHECK(worst < accuracy);
            CHECK(run.solution(end * 1.01).array().isNaN().all());
            CHECK(run.solution(-end * 0.01).array().isNaN().all());
        }
    };
    check(Euler{.step = 0.001}, 5e-3);
    check(Rk4{.step = 0.01}, 1e-8);
    check(Yoshida6{.step = 0.05}, 1e-7);
    check(Gauss8{.step = 0.1}, 1e-11);
    check(Radau5Fixed{.step = 0.02}, 1e-9);
    check(Dopri5{.tolerance = 1e-10}, 1e-8);
    check(Tsit5{.tolerance = 1e-10}, 1e-8);
    check(Dop853{.tolerance = 1e-12}, 1e-10);
    check(Radau5{.tolerance = 1e-10}, 1e-7);
}

TEST_CASE("Where the method has an interpolant, the dense solution is that polynomial")
{
    const auto check = [](const auto& method) {
        std::vector<double> times;
        for (int k = 0; k <= 100; ++k) times.push_back(0.05 * k);
        const auto run = integrate(Pendulum{}, start, {0.0, 5.0}, method, {.at = times, .dense = true});
        REQUIRE(run.states.size() == times.size());
        double worst = 0;
        for (std::size_t k = 0; k < times.size(); ++k)
            worst = std::max(worst, (run.solution(times[k]) - run.states[k]).norm());
        CHECK(worst < tolerance::roundoff(100));
        CHECK(run.steps < 60);
    };
    check(Dopri5{.tolerance = 1e-6});
    check(Tsit5{.tolerance = 1e-6});
    check(Dop853{.tolerance = 1e-6});
    check(Radau5{.tolerance = 1e-6});
}

TEST_CASE("A dense solution ends where the run ends: at an event, at the boundary of the domain, at a failure")
{
    const std::array<EventRequest<double, State>, 1> bottom{{{.index = 0, .stop = true}}};
    const auto stopped = integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{}, {.events = bottom, .dense = true});
    CHECK(stopped.status() == Status::stopped_by_event);
    CHECK(stopped.solution.end() == stopped.t);
    CHECK(stopped.solution(stopped.t) == stopped.state);
    CHECK((stopped.solution(stopped.t / 2) - reference(stopped.t / 2)).norm() < 1e-8);
    const auto cut = integrate(Pendulum{}, start, {0.0, 10.0}, Rk4{.step = 0.1}, {.max_steps = 7, .dense = true});
    CHECK(cut.status() == Status::too_many_steps);
    CHECK(cut.solution.end() == cut.t);
    const auto none = integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 0.1});
    CHECK(none.solution.empty());
    CHECK(none.solution(0.5).array().isNaN().all());
    const auto still = integrate(Pendulum{}, start, {2.0, 2.0}, Rk4{.step = 0.1}, {.dense = true});
    CHECK(still.solution.start() == 2);
    CHECK(still.solution(2) == start);
}
