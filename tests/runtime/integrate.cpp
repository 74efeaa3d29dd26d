// SPDX-License-Identifier: GPL-2.0-or-later
/// The march: statuses, times, rows, counts, observers.
#include "lagen/lagen.hpp"
#include "runtime/pendulum.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

using namespace lagen;
using Pendulum = problems::Pendulum<double>;
using State = Pendulum::State;

namespace {

/// x' = x^2: from 1 it is infinite at t = 1.
struct Explosion {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = s[0] * s[0];
        return Status::ok;
    }
};

/// x' = -1 with a status where x < 1/2.
struct Singular {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = -1;
        return s[0] < 0.5 ? Status::singular_mass_matrix : Status::ok;
    }
};

/// x' = -1 / (2 sqrt(x)), so x^(3/2) falls evenly: from 1 it is at the boundary x = 0 at t = 4/3.
struct Falling {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    bool root = true;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = root ? -0.5 / std::sqrt(s[0]) : -1;
        return Status::ok;
    }
    State domain(double, const State& s) const noexcept { return s; }
};

const State start(1.0, 0.0);

} // namespace

TEST_CASE("A run answers time, state and counts")
{
    const auto run = integrate(Pendulum{}, start, {0.0, 10.0}, Rk4{.step = 0.1});
    CHECK(run.status() == Status::ok);
    CHECK(static_cast<bool>(run));
    CHECK(run.t == 10.0);
    CHECK(run.failed_at == 10.0);
    CHECK(run.steps == 100);
    CHECK(run.rejected == 0);
    CHECK(run.rhs_calls == 400);
    CHECK(run.times.empty());
}

TEST_CASE(
    "Adaptive methods spend what they say: six and twelve calls a step, one at the start, one for the first length")
{
    const auto five = integrate(Pendulum{}, start, {0.0, 10.0}, Dopri5{.tolerance = 1e-8});
    CHECK(five.rhs_calls == 2 + 6 * (five.steps + five.rejected));
    const auto eight = integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{.tolerance = 1e-8});
    CHECK(eight.rhs_calls == 2 + 12 * eight.steps + 11 * eight.rejected);
    CHECK(eight.steps < five.steps);
}

TEST_CASE("The error follows the tolerance")
{
    const auto reference =
        integrate(problems::Pendulum<long double>{}, {1.0L, 0.0L}, {0.0L, 10.0L}, Dop853{.tolerance = 1e-17});
    const auto error = [&](const auto& method) {
        return (integrate(Pendulum{}, start, {0.0, 10.0}, method).state.template cast<long double>() - reference.state)
            .norm();
    };
    CHECK(reference.state.norm() > 0.5L);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        CHECK(error(Dopri5{.tolerance = tolerance}) < 20 * tolerance);
        CHECK(error(Tsit5{.tolerance = tolerance}) < 20 * tolerance);
        CHECK(error(Dop853{.tolerance = tolerance}) < 20 * tolerance);
        CHECK(error(Dopri5{.tolerance = tolerance}) > tolerance / 1e4);
    }
    CHECK(error(Dop853{.relative = 1e-10, .absolute = 1e-10}) == error(Dop853{.tolerance = 1e-10}));
}

TEST_CASE("The last fixed step is shortened to end on time")
{
    const auto run = integrate(Pendulum{}, start, {0.0, 1.05}, Rk4{.step = 0.1});
    CHECK(run.steps == 11);
    CHECK(run.t == 1.05);
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 0.1}).steps == 10);
}

TEST_CASE("An interval without length takes no step, and its row is the start")
{
    const std::array<double, 1> at{2.0};
    const auto run = integrate(Pendulum{}, start, {2.0, 2.0}, Dop853{}, {.at = at});
    CHECK(run.status() == Status::ok);
    CHECK(run.steps == 0);
    REQUIRE(run.states.size() == 1);
    CHECK(run.states[0] == start);
}

TEST_CASE("Forward and back returns to the start")
{
    const auto there = integrate(Pendulum{}, start, {0.0, 5.0}, Dop853{.tolerance = 1e-13});
    const auto back = integrate(Pendulum{}, there.state, {5.0, 0.0}, Dop853{.tolerance = 1e-13});
    CHECK((there.state - start).norm() > 0.1);
    CHECK(back.t == 0.0);
    CHECK((back.state - start).norm() < 1e-12);
    const auto fixed = integrate(Pendulum{}, integrate(Pendulum{}, start, {0.0, 5.0}, LeapfrogDkd{.step = 0.1}).state,
                                 {5.0, 0.0}, LeapfrogDkd{.step = 0.1});
    CHECK((fixed.state - start).norm() < tolerance::roundoff(1000));
}

TEST_CASE("Rows lie at exactly the times asked for, and do not disturb the steps")
{
    const std::array<double, 6> at{-1.0, 0.0, 0.25, 1.0, 2.5, 3.0};
    const auto check = [&](const auto& method, double accuracy) {
        const auto plain = integrate(Pendulum{}, start, {0.0, 2.5}, method);
        const auto run = integrate(Pendulum{}, start, {0.0, 2.5}, method, {.at = at});
        CHECK(run.times == std::vector<double>{0.0, 0.25, 1.0, 2.5});
        CHECK(run.state == plain.state);
        CHECK(run.steps == plain.steps);
        CHECK(run.states.front() == start);
        CHECK(run.states.back() == run.state);
        for (std::size_t i = 1; i < 3; ++i) {
            const auto direct = integrate(Pendulum{}, start, {0.0, run.times[i]}, Dop853{.tolerance = 1e-14});
            CHECK((run.states[i] - direct.state).norm() < accuracy);
        }
    };
    check(Rk4{.step = 0.02}, 1e-7);
    check(Dopri5{.tolerance = 1e-9}, 1e-8);
    check(Tsit5{.tolerance = 1e-9}, 1e-8);
    check(Dop853{.tolerance = 1e-11}, 1e-10);
    check(Yoshida6{.step = 0.05}, 1e-8);
}

TEST_CASE("What makes no sense is refused: steps, tolerances, intervals, event numbers, the start")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = -0.1}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = nan}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {0.0, infinity}, Rk4{.step = 0.1}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {nan, 1.0}, Dop853{}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Dop853{.tolerance = 0}).status() == Status::invalid_input);
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Dop853{.tolerance = nan}).status() == Status::invalid_input);
    const std::array<EventRequest<double, State>, 1> wrong{{{.index = 2}}};
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Dop853{}, {.events = wrong}).status() == Status::invalid_input);
    const auto run = integrate(Pendulum{}, State(nan, 0), {0.0, 1.0}, Dop853{});
    CHECK(run.status() == Status::non_finite);
    CHECK(run.steps == 0);
}

TEST_CASE("A solution that becomes infinite ends as step_too_small or non_finite at its pole, with a finite state")
{
    const auto run = integrate(Explosion{}, Explosion::State(1.0), {0.0, 2.0}, Dop853{.tolerance = 1e-8});
    CHECK_FALSE(run);
    CHECK((run.status() == Status::step_too_small || run.status() == Status::non_finite));
    CHECK_THAT(run.t, Catch::WithinAbs(1.0, 1e-7));
    CHECK(run.state.allFinite());
    const auto fixed = integrate(Explosion{}, Explosion::State(1.0), {0.0, 2.0}, Rk4{.step = 0.125});
    CHECK(fixed.status() == Status::non_finite);
    CHECK(fixed.state.allFinite());
    CHECK(fixed.failed_at == fixed.t + 0.125);
}

TEST_CASE("A status of the model ends the run with it, and the state is the last good one")
{
    const auto fixed = integrate(Singular{}, Singular::State(1.0), {0.0, 1.0}, Rk4{.step = 0.125});
    CHECK(fixed.status() == Status::singular_mass_matrix);
    CHECK(fixed.t == 0.5);
    CHECK(fixed.state[0] == 0.5);
    CHECK(fixed.failed_at == 0.625);
    const auto adaptive = integrate(Singular{}, Singular::State(1.0), {0.0, 1.0}, Dopri5{});
    CHECK(adaptive.status() == Status::singular_mass_matrix);
    CHECK_THAT(adaptive.t, Catch::WithinAbs(0.5, 1e-12));
    CHECK(adaptive.state[0] >= 0.5);
}

TEST_CASE("The boundary of the domain is found, whether or not the right-hand side exists beyond it")
{
    const auto linear = integrate(Falling{false}, Falling::State(1.0), {0.0, 3.0}, Dop853{});
    CHECK(linear.status() == Status::left_domain);
    CHECK_THAT(linear.t, Catch::WithinAbs(1.0, 1e-14));
    CHECK(linear.state[0] > 0);
    const auto root = integrate(Falling{}, Falling::State(1.0), {0.0, 3.0}, Dop853{.tolerance = 1e-10});
    CHECK(root.status() == Status::left_domain);
    CHECK_THAT(root.t, Catch::WithinAbs(4.0 / 3.0, 1e-8));
    CHECK(root.state[0] > 0);
    const auto fixed = integrate(Falling{false}, Falling::State(1.0), {0.0, 3.0}, Rk4{.step = 0.3});
    CHECK(fixed.status() == Status::left_domain);
    CHECK_THAT(fixed.t, Catch::WithinAbs(1.0, 1e-14));
    const auto outside = integrate(Falling{}, Falling::State(-1.0), {0.0, 3.0}, Dop853{});
    CHECK(outside.status() == Status::left_domain);
    CHECK(outside.steps == 0);
}

TEST_CASE("max_steps, a cancellation flag and a signal flag end a run")
{
    const auto many = integrate(Pendulum{}, start, {0.0, 10.0}, Rk4{.step = 0.01}, {.max_steps = 7});
    CHECK(many.status() == Status::too_many_steps);
    CHECK(many.steps == 7);
    CHECK_THAT(many.t, Catch::WithinAbs(0.07, 1e-15));
    CHECK(many.failed_at == many.t);
    const auto fewer = integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{}, {.max_steps = 7});
    CHECK(fewer.status() == Status::too_many_steps);
    CHECK(fewer.t > 0);
    CHECK(fewer.failed_at == fewer.t);
    const std::atomic<bool> cancel = true;
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Dop853{}, {.cancel = &cancel}).status() == Status::interrupted);
    const volatile std::sig_atomic_t signal = 1;
    CHECK(integrate(Pendulum{}, start, {0.0, 1.0}, Dop853{}, {.signal = &signal}).status() == Status::interrupted);
}

TEST_CASE("An observer sees the start and every step, or the rows")
{
    std::vector<double> seen;
    auto observer = [&](double t, const State&) { seen.push_back(t); };
    const auto run = integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 0.25}, {}, observer);
    CHECK(run);
    CHECK(seen == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
    struct Rows {
        std::vector<double> times;
        void row(double t, const State&) { times.push_back(t); }
    } rows;
    const std::array<double, 2> at{0.1, 0.7};
    const auto streamed = integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 0.25}, {.at = at}, rows);
    CHECK(streamed.times.empty());
    CHECK(rows.times == std::vector<double>{0.1, 0.7});
    std::vector<double> fractions;
    const auto told = integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 1.0 / 1024},
                                {.progress = [&](double done) { fractions.push_back(done); }});
    CHECK(told);
    CHECK(fractions == std::vector<double>{255.0 / 1024, 511.0 / 1024, 767.0 / 1024, 1023.0 / 1024});
}

TEST_CASE("Ten thousand float steps of 0.01 end at 100, and compensated sums of the state lose less energy")
{
    using Rotor = problems::Kepler<float>;
    const auto plain = integrate(Rotor{}, Rotor::State(1, 0, 0, 1), {0.0f, 100.0f}, Yoshida6{.step = 0.01});
    CHECK(plain.steps == 10000);
    // Of one start, chance may leave little.
    const auto drift = [](bool compensated) {
        double sum = 0;
        for (const float speed : {0.8f, 0.9f, 1.0f, 1.1f, 1.2f}) {
            const Rotor::State s(1, 0, 0, speed);
            const auto run = integrate(Rotor{}, s, {0.0f, 100.0f}, Rk4{.step = 0.01, .compensated = compensated});
            sum += std::abs(static_cast<double>(Rotor{}.energy(0, run.state) - Rotor{}.energy(0, s)));
        }
        return sum;
    };
    CHECK(drift(false) > 2e-6);
    CHECK(drift(true) < drift(false) / 4);
}

TEST_CASE("A partitioned method refuses a system that is not separable")
{
    struct Damped : Pendulum {
        Status rhs(double t, const State& s, State& ds) const noexcept
        {
            const Status status = Pendulum::rhs(t, s, ds);
            ds[1] -= 0.1 * s[1];
            return status;
        }
    };
    struct Sheared : Pendulum {
        Status rhs(double t, const State& s, State& ds) const noexcept
        {
            const Status status = Pendulum::rhs(t, s, ds);
            ds[0] += 0.1 * s[0];
            return status;
        }
    };
    CHECK(integrate(Damped{}, State(1, 0.5), {0.0, 1.0}, LeapfrogKdk{.step = 0.1}).status() == Status::not_separable);
    CHECK(integrate(Sheared{}, State(1, 0.5), {0.0, 1.0}, KahanLi8{.step = 0.1}).status() == Status::not_separable);
    CHECK(integrate(Pendulum{}, State(1, 0.5), {0.0, 1.0}, LeapfrogKdk{.step = 0.1}).status() == Status::ok);
}

TEST_CASE("A status prints its name")
{
    std::ostringstream out;
    out << integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{}).status() << ' ' << Status::left_domain;
    CHECK(out.str() == "invalid_input left_domain");
}

// tests/runtime/every_scalar.cpp has every method in float and double, tests/convergence/orders.cpp in long double.
TEST_CASE("Dop853 has the digits of float, double and long double")
{
    const auto check = []<class S>(S, double tolerance, double accuracy) {
        using Model = problems::Kepler<S>;
        const auto run = integrate(Model{}, Model::exact(S(0.2), S(0)), {S(0), S(3)}, Dop853{.tolerance = tolerance});
        CHECK(run.status() == Status::ok);
        CHECK(static_cast<double>((run.state - Model::exact(S(0.2), S(3))).norm()) < accuracy);
    };
    check(0.0f, 1e-6, 1e-4);
    check(0.0, 1e-14, 1e-12);
    check(0.0L, 1e-18, 1e-16);
}

TEST_CASE("Rows that run against the run, or are no numbers, are refused; equal rows are repeated")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto status = [](std::vector<double> at, double end) {
        return integrate(Pendulum{}, start, {0.0, end}, Dop853{}, {.at = at}).status();
    };
    CHECK(status({0.5, 0.25}, 1) == Status::invalid_input);
    CHECK(status({0.25, 0.5}, -1) == Status::invalid_input);
    CHECK(status({0.25, nan}, 1) == Status::invalid_input);
    CHECK(status({-0.25, -0.5}, -1) == Status::ok);
    const std::array<double, 3> twice{0.5, 0.5, 1};
    const auto run = integrate(Pendulum{}, start, {0.0, 1.0}, Rk4{.step = 0.3}, {.at = twice});
    REQUIRE(run.states.size() == 3);
    CHECK(run.states[0] == run.states[1]);
}

TEST_CASE("max_step is a cap also for the last step, and a first step beyond the interval is cut to it")
{
    std::vector<double> seen;
    auto observer = [&](double t, const State&) { seen.push_back(t); };
    const auto run = integrate(Pendulum{}, start, {0.0, 1.005},
                               Dop853{.tolerance = 1e9, .first_step = 1, .max_step = 1}, {}, observer);
    CHECK(run.steps == 2);
    for (std::size_t k = 1; k < seen.size(); ++k) CHECK(seen[k] - seen[k - 1] <= 1);
    const auto one = integrate(Pendulum{}, start, {0.0, 0.1}, Dop853{.tolerance = 1e9, .first_step = 50});
    CHECK(one.steps == 1);
    CHECK(one.t == 0.1);
    CHECK(integrate(Pendulum{}, start, {0.0, 0.1}, Rk4{.step = 50}).steps == 1);
}

TEST_CASE("One of the two tolerances may be zero, and rows do not count as steps")
{
    const auto relative = integrate(Pendulum{}, start, {0.0, 5.0}, Dop853{.relative = 1e-10, .absolute = 0});
    const auto absolute = integrate(Pendulum{}, start, {0.0, 5.0}, Dop853{.relative = 0, .absolute = 1e-10});
    CHECK(relative.status() == Status::ok);
    CHECK(absolute.status() == Status::ok);
    CHECK((relative.state - absolute.state).norm() < 1e-8);
    CHECK(relative.state != absolute.state);
    std::vector<double> many;
    for (int k = 0; k <= 1000; ++k) many.push_back(k * 5e-3);
    const auto rows = integrate(Pendulum{}, start, {0.0, 5.0}, Rk4{.step = 1}, {.at = many, .max_steps = 5});
    CHECK(rows.status() == Status::ok);
    CHECK(rows.states.size() == 1001);
}

TEST_CASE("Steps that are lost in the rounding of time end with the cap on steps and the start as state")
{
    const auto run = integrate(Pendulum{}, start, {1.0, 2.0}, Rk4{.step = 1e-300}, {.max_steps = 1000});
    CHECK(run.status() == Status::too_many_steps);
    CHECK(run.t == 1.0);
    CHECK((run.state - start).norm() < 1e-12);
}
