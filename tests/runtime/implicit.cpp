// SPDX-License-Identifier: GPL-2.0-or-later
/// The implicit methods in the march: what they count, how they fail, what they keep to rounding, values inside steps.
#include "lagen/lagen.hpp"
#include "runtime/pendulum.hpp"
#include "support/sanitized.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <type_traits>

#ifdef LAGEN_ALL_TESTS
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#endif

using namespace lagen;
using Pendulum = problems::Pendulum<double>;
using Kepler = problems::Kepler<double>;

namespace {

/// x' = (rate - fall t) x + 1.
struct Line {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    double rate = 2, fall = 0;

    Status rhs(double t, const State& s, State& ds) const noexcept
    {
        ds[0] = (rate - fall * t) * s[0] + 1;
        return Status::ok;
    }
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(double t, const State&, std::array<double, 1>& values) const noexcept
    {
        values = {rate - fall * t};
    }
};

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
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(double, const State& s, std::array<double, 1>& values) const noexcept { values = {2 * s[0]}; }
};

/// x' = -1, with a status where x < 1/2.
struct Singular : Line {
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = -1;
        return s[0] < 0.5 ? Status::singular_mass_matrix : Status::ok;
    }
    void jacobian_values(double, const State&, std::array<double, 1>& values) const noexcept { values = {0}; }
};

/// A ring of n nonlinear oscillators, state (x, v).
template <int n>
struct Ring {
    using Scalar = double;
    using State = Eigen::Matrix<double, 2 * n, 1>;
    static constexpr int dimension = 2 * n;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        for (int i = 0; i < n; ++i) {
            ds[i] = s[n + i];
            ds[n + i] = s[(i + 1) % n] + s[(i + n - 1) % n] - 2 * s[i] - std::sin(s[i]);
        }
        return Status::ok;
    }
    static constexpr std::array<int, 4 * n> jacobian_rows = [] {
        std::array<int, 4 * n> rows{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(4 * n); ++i)
            rows[i] = static_cast<int>(i) < n ? static_cast<int>(i) : n + (static_cast<int>(i) - n) / 3;
        return rows;
    }();
    static constexpr std::array<int, 4 * n> jacobian_columns = [] {
        std::array<int, 4 * n> columns{};
        for (int i = 0; i < n; ++i) {
            const auto entry = static_cast<std::size_t>(n + 3 * i);
            columns[static_cast<std::size_t>(i)] = n + i;
            columns[entry] = i;
            columns[entry + 1] = (i + 1) % n;
            columns[entry + 2] = (i + n - 1) % n;
        }
        return columns;
    }();
    void jacobian_values(double, const State& s, std::array<double, 4 * n>& values) const noexcept
    {
        for (int i = 0; i < n; ++i) {
            const auto entry = static_cast<std::size_t>(n + 3 * i);
            values[static_cast<std::size_t>(i)] = 1;
            values[entry] = -2 - std::cos(s[i]);
            values[entry + 1] = values[entry + 2] = 1;
        }
    }
};

const Pendulum::State start(1.0, 0.0);

} // namespace

TEST_CASE("A fixed implicit step costs one decomposition and a few Newton iterations, each a call a stage")
{
    const auto check = [](const auto& method, std::size_t stages, std::size_t most) {
        const auto run = integrate(Pendulum{}, start, {0.0, 10.0}, method);
        CHECK(run.status() == Status::ok);
        CHECK(run.steps == 100);
        CHECK(run.decompositions == 100);
        CHECK(run.rhs_calls == stages * run.newton_iterations);
        CHECK(run.newton_iterations > 3 * run.steps);
        CHECK(run.newton_iterations < most * run.steps);
    };
    check(Gauss2{.step = 0.1}, 1, 8);
    check(Gauss4{.step = 0.1}, 2, 7);
    check(Gauss6{.step = 0.1}, 3, 7);
    check(Gauss8{.step = 0.1}, 4, 7);
    check(Radau3Fixed{.step = 0.1}, 2, 7);
    check(Radau5Fixed{.step = 0.1}, 3, 7);
    const auto explicit_run = integrate(Pendulum{}, start, {0.0, 10.0}, Rk4{.step = 0.1});
    CHECK(explicit_run.newton_iterations == 0);
    CHECK(explicit_run.decompositions == 0);
    const auto adaptive = integrate(Pendulum{}, start, {0.0, 10.0}, Radau5{.tolerance = 1e-8});
    CHECK(adaptive.newton_iterations > adaptive.steps);
    CHECK(adaptive.newton_iterations < 4 * adaptive.steps);
    CHECK(adaptive.decompositions <= adaptive.steps + adaptive.rejected);
}

TEST_CASE("The collocation polynomial of the last step saves Newton iterations of the next")
{
    const auto whole = integrate(Pendulum{}, start, {0.0, 5.0}, Gauss8{.step = 0.05});
    std::size_t apart = 0;
    Pendulum::State s = start;
    for (int step = 0; step < 100; ++step) {
        const auto one = integrate(Pendulum{}, s, {0.0, 0.05}, Gauss8{.step = 0.05});
        apart += one.newton_iterations;
        s = one.state;
    }
    CHECK(whole.newton_iterations + 100 < apart);
    CHECK((s - whole.state).norm() < tolerance::roundoff(100));
}

TEST_CASE("A singular Newton matrix fails with newton_diverged and leaves the state; its middle is tried before")
{
    // 1 - h/2 J = 0 at h = 1, J = 2.
    const auto run = integrate(Line{}, Line::State(0.25), {0.0, 3.0}, Gauss2{.step = 1});
    CHECK(run.status() == Status::newton_diverged);
    CHECK(run.t == 0);
    CHECK(run.state[0] == 0.25);
    CHECK(run.failed_at == 1);
    CHECK(run.steps == 0);
    // J = 2 - 4 t is 0 in the middle of the step: x1 = x0 + 1.
    const auto again = integrate(Line{2, 4}, Line::State(0.25), {0.0, 1.0}, Gauss2{.step = 1});
    CHECK(again.status() == Status::ok);
    CHECK(again.state[0] == 1.25);
    CHECK(again.decompositions == 3);
}

TEST_CASE("A step over Kepler's pericentre that is too long fails with newton_diverged, the state is the one before it")
{
    const auto check = [](const auto& method) {
        const auto run = integrate(Kepler{}, Kepler::State(1.9, 0, 0, std::sqrt(0.1 / 1.9)), {0.0, 20.0}, method);
        CHECK(run.status() == Status::newton_diverged);
        CHECK(run.steps > 2);
        CHECK(run.failed_at > run.t);
        CHECK(run.state.allFinite());
        const auto before = integrate(Kepler{}, Kepler::State(1.9, 0, 0, std::sqrt(0.1 / 1.9)), {0.0, 20.0}, method,
                                      {.max_steps = run.steps});
        CHECK(before.state == run.state);
    };
    check(Gauss4{.step = 0.5});
    check(Gauss6{.step = 0.5});
    check(Gauss8{.step = 0.5});
}

TEST_CASE("A status of the model in a stage is the status of the run, with the last good state")
{
    const auto fixed = integrate(Singular{}, Singular::State(1.0), {0.0, 1.0}, Gauss6{.step = 0.125});
    CHECK(fixed.status() == Status::singular_mass_matrix);
    CHECK(fixed.t == 0.5);
    CHECK(fixed.state[0] == 0.5);
    const auto adaptive = integrate(Singular{}, Singular::State(1.0), {0.0, 1.0}, Radau5{});
    CHECK(adaptive.status() == Status::singular_mass_matrix);
    CHECK_THAT(adaptive.t, Catch::WithinAbs(0.5, 1e-9));
    CHECK(adaptive.state[0] >= 0.5);
}

TEST_CASE("At a pole implicit methods stop before it with a finite state")
{
    const auto fixed = integrate(Explosion{}, Explosion::State(1.0), {0.0, 2.0}, Gauss4{.step = 0.0625});
    CHECK(fixed.status() == Status::newton_diverged);
    CHECK(fixed.t < 1);
    CHECK(fixed.t > 0.8);
    CHECK(fixed.state.allFinite());
    const auto adaptive = integrate(Explosion{}, Explosion::State(1.0), {0.0, 2.0}, Radau5{.tolerance = 1e-8});
    CHECK_FALSE(adaptive);
    CHECK_THAT(adaptive.t, Catch::WithinAbs(1, 1e-7));
    CHECK(adaptive.state.allFinite());
}

TEST_CASE("Gauss' methods run back to where they came from, to rounding")
{
    const auto check = [](const auto& method, double allowed) {
        const Kepler::State s = Kepler::exact(0.6, 0.5);
        const auto there = integrate(Kepler{}, s, {0.0, 20.0}, method);
        const auto back = integrate(Kepler{}, there.state, {20.0, 0.0}, method);
        CHECK((there.state - s).norm() > 0.1);
        CHECK((back.state - s).norm() < allowed);
    };
    check(Gauss2{.step = 0.0625}, 1e-12);
    check(Gauss4{.step = 0.0625}, 1e-12);
    check(Gauss6{.step = 0.0625}, 1e-12);
    check(Gauss8{.step = 0.0625}, 1e-12);
    check(Gauss16{.step = 0.0625}, 1e-12);
    // Radau IIA is not symmetric.
    const auto there = integrate(Kepler{}, Kepler::exact(0.6, 0.5), {0.0, 20.0}, Radau5Fixed{.step = 0.0625});
    const auto back = integrate(Kepler{}, there.state, {20.0, 0.0}, Radau5Fixed{.step = 0.0625});
    CHECK((back.state - Kepler::exact(0.6, 0.5)).norm() > 1e-6);
}

TEST_CASE("The Casimir of a rigid body is kept to the rounding of every scalar")
{
    const auto check = []<class S>(S) {
        using Body = problems::RigidBody<S>;
        const typename Body::State s(S(3) / S(5), S(1) / S(10), S(4) / S(5));
        const S before = s.squaredNorm();
        const auto lost = [&](const auto& method) {
            const auto run = integrate(Body{}, s, {S(0), S(20)}, method);
            CHECK(run.status() == Status::ok);
            CHECK(run.steps == 80);
            CHECK((run.state - s).squaredNorm() > S(0.01));
            const S change = run.state.squaredNorm() - before;
            return static_cast<double>(S(change / std::numeric_limits<S>::epsilon()));
        };
        CHECK(std::abs(lost(Gauss4{.step = 0.25})) < 4);
        CHECK(std::abs(lost(Gauss8{.step = 0.25})) < 4);
        if constexpr (std::is_same_v<S, double>) { // what the others keep by, collocation.cpp shows in every scalar
            CHECK(std::abs(lost(Gauss2{.step = 0.25})) < 4);
            CHECK(std::abs(lost(Gauss6{.step = 0.25})) < 4);
            CHECK(std::abs(lost(Gauss12{.step = 0.25})) < 4);
            CHECK(std::abs(lost(Gauss16{.step = 0.25})) < 4);
            CHECK(std::abs(lost(Radau5Fixed{.step = 0.25})) > 100); // it damps, by more than is rounding
        }
    };
    check(0.0);
#if defined(LAGEN_ALL_TESTS) && !LAGEN_SANITIZED // it takes minutes to compile these with sanitizers
    namespace mp = boost::multiprecision;
    check(0.0f);
    check(0.0L);
    check(mp::number<mp::cpp_bin_float<50>, mp::et_off>(0));
    using Lazy = mp::number<mp::cpp_bin_float<50>, mp::et_on>; // of another type than its sums and products
    const problems::RigidBody<Lazy>::State s(Lazy(3) / 5, Lazy(1) / 10, Lazy(4) / 5);
    const auto run = integrate(problems::RigidBody<Lazy>{}, s, {Lazy(0), Lazy(20)}, Gauss4{.step = 0.25});
    CHECK(run.status() == Status::ok);
    CHECK(abs(Lazy(run.state.squaredNorm() - s.squaredNorm())) < 4 * std::numeric_limits<Lazy>::epsilon());
#endif
}

TEST_CASE("Rows do not disturb an implicit run, and have the order of the method")
{
    const auto check = [](const auto& method, double accuracy) {
        const std::array<double, 3> at{0.013, 1.23, 4.001};
        const auto plain = integrate(Pendulum{}, start, {0.0, 5.0}, method);
        const auto run = integrate(Pendulum{}, start, {0.0, 5.0}, method, {.at = at});
        CHECK(run.state == plain.state);
        CHECK(run.steps == plain.steps);
        REQUIRE(run.states.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto direct = integrate(Pendulum{}, start, {0.0, at[i]}, Dop853{.tolerance = 1e-14});
            CHECK((run.states[i] - direct.state).norm() < accuracy);
        }
    };
    check(Gauss4{.step = 0.02}, 1e-8);
    check(Gauss6{.step = 0.05}, 1e-10);
    check(Gauss8{.step = 0.1}, 1e-11);
    check(Gauss16{.step = 0.5}, 1e-11);
    check(Radau3Fixed{.step = 0.01}, 1e-6);
    check(Radau5Fixed{.step = 0.01}, 1e-11);
    check(Radau5{.tolerance = 1e-10}, 1e-8);
}

TEST_CASE("Rows and events leave every step as it is, also where Newton's method is slow")
{
    std::vector<double> at;
    for (int k = 1; k < 400; ++k) at.push_back(0.025 * k);
    const auto check = [&at](const auto& method, const Pendulum::State& s) {
        const std::array<EventRequest<double, Pendulum::State>, 1> often{
            {{.when = [](double, const Pendulum::State& x) { return std::sin(x[0]) - 0.3; }}}};
        const auto plain = integrate(Pendulum{}, s, {0.0, 10.0}, method);
        const auto rows = integrate(Pendulum{}, s, {0.0, 10.0}, method, {.at = at});
        const auto events = integrate(Pendulum{}, s, {0.0, 10.0}, method, {.events = often});
        for (const auto& run : {rows, events}) {
            CHECK(run.status() == plain.status());
            CHECK(run.steps == plain.steps);
            CHECK(run.state == plain.state);
        }
    };
    for (const Pendulum::State& s : {Pendulum::State(1, 0), Pendulum::State(0.4, 2.5), Pendulum::State(-2, 4)})
        for (const double step : {0.5, 1.1, 1.7}) {
            INFO(s.transpose() << " " << step);
            check(Gauss2{.step = step}, s);
            check(Gauss4{.step = step}, s);
            check(Gauss6{.step = step}, s);
            check(Gauss8{.step = step}, s);
            check(Gauss16{.step = step}, s);
            check(Radau3Fixed{.step = step}, s);
            check(Radau5Fixed{.step = step}, s);
            check(Rk4{.step = step, .compensated = true}, s);
            check(Yoshida6{.step = step}, s);
            check(Dop853{.tolerance = step / 100}, s);
            check(Tsit5{.tolerance = step / 100}, s);
            check(Radau5{.tolerance = step / 100}, s);
        }
}

TEST_CASE("A lane that rests, or rests but for dust, does not keep Newton's method from ending")
{
    for (const double dust : {0.0, 1e-40, 1e-310}) {
        using Body = problems::RigidBody<double>;
        const auto run = integrate(Body{}, Body::State(1, dust, 0), {0.0, 10.0}, Gauss6{.step = 0.1});
        CHECK(run.status() == Status::ok);
        CHECK(run.newton_iterations <= 6 * run.steps);
        CHECK(run.state[0] == 1);
    }
}

TEST_CASE("Matrices beyond the size that lies on the stack give the same steps")
{
    const auto check = []<int n>(Ring<n>) {
        typename Ring<n>::State s;
        for (int i = 0; i < 2 * n; ++i) s[i] = std::sin(0.7 * i);
        const auto exact = integrate(Ring<n>{}, s, {0.0, 1.0}, Dop853{.tolerance = 1e-13});
        const auto gauss = integrate(Ring<n>{}, s, {0.0, 1.0}, Gauss8{.step = 0.05});
        const auto radau = integrate(Ring<n>{}, s, {0.0, 1.0}, Radau5{.tolerance = 1e-9});
        CHECK(gauss.newton_iterations < 8 * gauss.steps);
        CHECK((gauss.state - exact.state).norm() < 1e-11);
        CHECK((radau.state - exact.state).norm() < 1e-8);
    };
    check(Ring<4>{});
    check(Ring<40>{});
}
