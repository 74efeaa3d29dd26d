// SPDX-License-Identifier: GPL-2.0-or-later
/// lagen::Integrator: steps by hand, forwards and backwards, values inside them, failures.
#include "lagen/integrate.hpp"
#include "lagen/lanes/pack.hpp"
#include "runtime/pendulum.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace lagen;

namespace {

using Pendulum = problems::Pendulum<double>;
using State = Pendulum::State;
const State start(1, 0);

/// x' = -1 on x > 0; from t = 2 on the right-hand side has no solution.
struct Falling {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    double last = 2;
    Status rhs(double t, const State&, State& ds) const noexcept
    {
        ds[0] = -1;
        return t > last ? Status::singular_mass_matrix : Status::ok;
    }
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(double, const State&, std::array<double, 1>& values) const noexcept { values = {0}; }
    Eigen::Matrix<double, 1, 1> domain(double, const State& s) const noexcept { return s; }
};

/// f(method) for a method of every kind, all of order 4 at least.
template <class Function>
void for_methods(const Function& f)
{
    f(Rk4{.step = 0.01});
    f(Rk4{.step = 0.01, .compensated = true});
    f(Yoshida6{.step = 0.02});
    f(Gauss6{.step = 0.05});
    f(Dopri5{.tolerance = 1e-10});
    f(Tsit5{.tolerance = 1e-10});
    f(Dop853{.tolerance = 1e-11});
    f(Radau5{.tolerance = 1e-10});
}

template <class M>
typename M::State reference(const M& model, const typename M::State& s, double t0, double t1)
{
    return integrate(model, s, {t0, t1}, Dop853{.tolerance = 1e-14}).state;
}

} // namespace

TEST_CASE("advance_to makes the steps of integrate: the same state, steps and calls, bit for bit")
{
    const auto check = [](const auto& method, double end) {
        Integrator integrator(Pendulum{}, start, 0, method);
        CHECK(integrator.status() == Status::ok);
        CHECK(integrator.advance_to(end) == Status::ok);
        const auto run = integrate(Pendulum{}, start, {0.0, end}, method);
        CHECK(integrator.state() == run.state);
        CHECK(integrator.t() == end);
        CHECK(integrator.steps() == run.steps);
        CHECK(integrator.rejected() == run.rejected);
        CHECK(integrator.rhs_calls() == run.rhs_calls);
        CHECK(integrator.newton_iterations() == run.newton_iterations);
        CHECK((integrator.state() - start).norm() > 0.1);
    };
    for_methods([&](const auto& method) {
        check(method, 3.0);
        check(method, -3.0);
    });
    check(Euler{.step = 0.01}, 1);
    check(Midpoint{.step = 0.01}, 1);
    check(Radau3Fixed{.step = 0.01}, 1);
    check(LeapfrogDkd{.step = 0.01}, 1);
}

TEST_CASE("Many steps at once are the steps one by one, wherever the end lies")
{
    const auto check = [](const auto& model, const auto& s, auto t, auto end, const auto& method) {
        Integrator at_once(model, s, t, method), one_by_one(at_once);
        CHECK(at_once.advance_to(end) == Status::ok);
        while (one_by_one.t() != end) REQUIRE(one_by_one.step_towards(end) == Status::ok);
        CHECK(at_once.t() == end);
        CHECK(at_once.steps() == one_by_one.steps());
        CHECK(at_once.t_before() == one_by_one.t_before());
        CHECK(at_once.state() == one_by_one.state());
        CHECK(at_once.rhs_calls() == one_by_one.rhs_calls());
    };
    const State here(0.5, -0.25);
    for (const double h : {0.1, 0.01, 1.0 / 3})
        for (const double parts : {0.5, 1.0, 1.01, 2.0, 2.5, 3.0, 3.999999999999999, 4.0, 37.0, 100.25}) {
            check(Pendulum{}, here, 0.0, parts * h, Rk4{.step = h});
            check(Pendulum{}, here, 1e3, 1e3 - parts * h, Rk4{.step = h, .compensated = true});
        }
    // Steps of the size of the rounding of time.
    const double ulp = std::numeric_limits<double>::epsilon() * 1024;
    for (const double steps : {1.0, 2.0, 30.0, 31.5})
        check(Pendulum{}, here, 1024.0, 1024.0 + steps * ulp, Rk4{.step = ulp});
    check(problems::Pendulum<float>{}, problems::Pendulum<float>::State(1, 0), 0.f, 10.f, Rk4{.step = 0.01});
}

TEST_CASE("Many steps at once end before the one that fails")
{
    Integrator integrator(Falling{.last = 1}, Falling::State(3), 0, Rk4{.step = 0.125});
    CHECK(integrator.advance_to(10) == Status::singular_mass_matrix);
    CHECK(integrator.t() == 1);
    CHECK(integrator.steps() == 8);
    CHECK(integrator.state()[0] == 2);
    CHECK(integrator.t_before() == 1);
    CHECK(integrator.advance_to(0.5) == Status::ok);
    CHECK(integrator.state()[0] == 2.5);
    Integrator leaving(Falling{.last = 9}, Falling::State(1.5), 0, Rk4{.step = 0.25});
    CHECK(leaving.advance_to(10) == Status::left_domain);
    CHECK(leaving.t() == 1.25);
    CHECK(leaving.state()[0] == 0.25);
    CHECK(leaving.failed_at() == 1.5);
}

TEST_CASE("step() by step() goes forwards; fixed steps have their length, and values inside lie on the solution")
{
    for_methods([](const auto& method) {
        Integrator integrator(Pendulum{}, start, 0.5, method);
        for (int k = 0; k < 25; ++k) {
            REQUIRE(integrator.step() == Status::ok);
            REQUIRE(integrator.t() > integrator.t_before());
        }
        CHECK(integrator.steps() == 25);
        if constexpr (requires { method.step; })
            CHECK_THAT(integrator.t(), Catch::WithinAbs(0.5 + 25 * method.step, 1e-14));
        const double a = integrator.t_before(), b = integrator.t();
        CHECK((integrator.state() - reference(Pendulum{}, start, 0.5, b)).norm() < 1e-8);
        for (const double theta : {0.1, 0.5, 0.9}) {
            const double t = a + theta * (b - a);
            CHECK((integrator.at(t) - reference(Pendulum{}, start, 0.5, t)).norm() < 1e-8);
        }
        CHECK(integrator.at(b) == integrator.state());
        CHECK(integrator.at(b + 0.1).array().isNaN().all());
        CHECK(integrator.at(a - 0.1).array().isNaN().all());
    });
}

TEST_CASE("Values inside a step do not disturb the steps")
{
    for_methods([](const auto& method) {
        Integrator quiet(Pendulum{}, start, 0, method), asked(Pendulum{}, start, 0, method);
        for (int k = 0; k < 10; ++k) {
            REQUIRE(quiet.step() == Status::ok);
            REQUIRE(asked.step() == Status::ok);
            const double middle = (asked.t_before() + asked.t()) / 2;
            CHECK(asked.at(middle) == asked.at(middle));
        }
        CHECK(asked.state() == quiet.state());
        CHECK(asked.t() == quiet.t());
    });
}

TEST_CASE("A run may turn round: back at the start, the state is there")
{
    for_methods([](const auto& method) {
        Integrator integrator(Pendulum{}, start, 0, method);
        CHECK(integrator.advance_to(2) == Status::ok);
        CHECK((integrator.state() - start).norm() > 0.1);
        CHECK(integrator.advance_to(-1) == Status::ok);
        CHECK((integrator.state() - reference(Pendulum{}, start, 0, -1)).norm() < 1e-8);
        REQUIRE(integrator.step() == Status::ok);
        CHECK(integrator.t() < -1);
        CHECK(integrator.advance_to(0) == Status::ok);
        CHECK(integrator.t() == 0);
        CHECK((integrator.state() - start).norm() < 1e-8);
        CHECK(integrator.advance_to(0) == Status::ok);
    });
}

TEST_CASE("A move of no length leaves the direction as it is")
{
    for_methods([](const auto& method) {
        Integrator integrator(Pendulum{}, start, 0, method);
        REQUIRE(integrator.advance_to(-0.5) == Status::ok);
        REQUIRE(integrator.advance_to(integrator.t()) == Status::ok);
        REQUIRE(integrator.step() == Status::ok);
        CHECK(integrator.t() < -0.5);
    });
}

TEST_CASE("A time that overflows ends the steps")
{
    Integrator integrator(Pendulum{}, Pendulum::State(0, 0), 0, Euler{.step = 1e308});
    REQUIRE(integrator.step() == Status::ok);
    CHECK(integrator.step() == Status::non_finite);
    CHECK(integrator.t() == 1e308);
    CHECK(integrator.state() == Pendulum::State(0, 0));
}

TEST_CASE("A step cut short by advance_to leaves the length of the next ones alone")
{
    Integrator integrator(Pendulum{}, start, 0, Dop853{.tolerance = 1e-8});
    REQUIRE(integrator.advance_to(5) == Status::ok);
    REQUIRE(integrator.step() == Status::ok);
    const double length = integrator.t() - integrator.t_before();
    REQUIRE(integrator.advance_to(integrator.t() + length / 1000) == Status::ok);
    REQUIRE(integrator.step() == Status::ok);
    CHECK(integrator.t() - integrator.t_before() > length / 4);
    REQUIRE(integrator.step_towards(100) == Status::ok);
    CHECK(integrator.t() < 100);
}

TEST_CASE("A step that fails answers why and leaves time and state; a shorter one may follow")
{
    const auto check = [](const auto& method) {
        Integrator integrator(Falling{0.25}, Falling::State(1.0), 0, method);
        REQUIRE(integrator.advance_to(0.2) == Status::ok);
        const Status status = integrator.advance_to(0.5);
        CHECK(status == Status::singular_mass_matrix);
        const double t = integrator.t(), x = integrator.state()[0];
        CHECK(t <= 0.26);
        CHECK(t >= 0.2);
        CHECK_THAT(x, Catch::WithinAbs(1 - t, tolerance::roundoff(10)));
        CHECK(integrator.step() == Status::singular_mass_matrix);
        CHECK(integrator.t() == t);
        CHECK(integrator.state()[0] == x);
        CHECK(integrator.failed_at() > t);
        CHECK(integrator.at(t)[0] == x);
        CHECK(std::isnan(integrator.at(t - 0.01)[0]));
        // Back to where it can be evaluated.
        CHECK(integrator.advance_to(0.1) == Status::ok);
        CHECK_THAT(integrator.state()[0], Catch::WithinAbs(0.9, tolerance::roundoff(10)));
    };
    check(Rk4{.step = 0.1});
    check(Gauss4{.step = 0.1});
    check(Dopri5{.max_step = 0.1});
    check(Dop853{.max_step = 0.1});
    check(Radau5{.max_step = 0.1});
}

TEST_CASE("A step out of the domain is none")
{
    const auto check = [](const auto& method) {
        Integrator integrator(Falling{}, Falling::State(1.0), 0, method);
        Status status = Status::ok;
        std::size_t accepted = 0;
        while (status == Status::ok) {
            status = integrator.step();
            if (status == Status::ok) ++accepted;
        }
        CHECK(status == Status::left_domain);
        CHECK(integrator.steps() == accepted);
        CHECK(integrator.state()[0] > 0);
        CHECK_THAT(integrator.state()[0], Catch::WithinAbs(1 - integrator.t(), tolerance::roundoff(10)));
        CHECK(integrator.failed_at() >= 1);
        const double t = integrator.t();
        CHECK(integrator.step() == Status::left_domain);
        CHECK(integrator.t() == t);
        CHECK(integrator.advance_to(0.999) == Status::ok);
        CHECK_THAT(integrator.state()[0], Catch::WithinAbs(0.001, tolerance::roundoff(10)));
    };
    check(Rk4{.step = 0.3});
    check(Gauss4{.step = 0.3});
    check(Dopri5{.first_step = 0.3, .max_step = 0.3});
    check(Dop853{.first_step = 0.3, .max_step = 0.3});
    check(Radau5{.first_step = 0.3, .max_step = 0.3});
}

TEST_CASE("A start that makes no sense is refused, and so is every step from it")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Integrator no_length(Pendulum{}, start, 0, Rk4{});
    CHECK(no_length.status() == Status::invalid_input);
    CHECK(no_length.step() == Status::invalid_input);
    CHECK(no_length.advance_to(1) == Status::invalid_input);
    CHECK(no_length.state() == start);
    Integrator no_number(Pendulum{}, State(nan, 0), 0, Dop853{});
    CHECK(no_number.step() == Status::non_finite);
    Integrator outside(Falling{}, Falling::State(-1.0), 0, Dop853{});
    CHECK(outside.step() == Status::left_domain);
    Integrator endless(Pendulum{}, start, 1, Rk4{.step = 1e-300});
    CHECK(endless.advance_to(2) == Status::too_many_steps);
    CHECK(endless.t() == 1);
    Integrator good(Pendulum{}, start, 0, Dop853{});
    CHECK(good.advance_to(nan) == Status::invalid_input);
    CHECK(good.step_towards(std::numeric_limits<double>::infinity()) == Status::invalid_input);
    CHECK(good.t() == 0);
    CHECK(good.step() == Status::ok);
}

TEST_CASE("A copy of an integrator goes its own way")
{
    for_methods([](const auto& method) {
        Integrator first(Pendulum{}, start, 0, method);
        REQUIRE(first.advance_to(0.5) == Status::ok);
        Integrator second = first;
        REQUIRE(first.advance_to(1) == Status::ok);
        CHECK(second.t() == 0.5);
        REQUIRE(second.advance_to(1) == Status::ok);
        CHECK(second.state() == first.state());
        second = first;
        CHECK(second.steps() == first.steps());
    });
}

TEST_CASE("Lanes of a pack step together, each as its scalar does")
{
    using Lanes = Pack<double, 4>;
    using Several = problems::Pendulum<Lanes>;
    Several::State s;
    for (int lane = 0; lane < 4; ++lane) {
        s[0].set(lane, 0.5 + 0.5 * lane);
        s[1].set(lane, 0);
    }
    Integrator all(Several{}, s, 0, Rk4{.step = 0.01});
    for (int k = 0; k < 50; ++k) REQUIRE(all.step() == Status::ok);
    for (int lane = 0; lane < 4; ++lane) {
        Integrator one(Pendulum{}, State(0.5 + 0.5 * lane, 0), 0, Rk4{.step = 0.01});
        for (int k = 0; k < 50; ++k) REQUIRE(one.step() == Status::ok);
        CHECK(all.state()[0][lane] == one.state()[0]);
        CHECK(all.state()[1][lane] == one.state()[1]);
        CHECK(all.at(0.495)[0][lane] == one.at(0.495)[0]);
    }
    CHECK(all.lanes() == StatusOf<Lanes>::good());
}
