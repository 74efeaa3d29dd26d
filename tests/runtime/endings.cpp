// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run that cannot go on says: a step below the rounding of time, a state that is no number.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>

using namespace lagen;

namespace {

/// x'' = -1/x^2: from 1 at rest it arrives at 0 at t = pi/(2 sqrt 2).
struct Infall {
    using Scalar = double;
    using State = Eigen::Matrix<double, 2, 1>;
    static constexpr int dimension = 2;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = s[1];
        ds[1] = -1 / (s[0] * s[0]);
        return Status::ok;
    }
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};
    void jacobian_values(double, const State& s, std::array<double, 2>& values) const noexcept
    {
        values = {1, 2 / (s[0] * s[0] * s[0])};
    }
};

/// x' = rate x.
struct Growth {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    double rate = 1;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = rate * s[0];
        return Status::ok;
    }
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(double, const State&, std::array<double, 1>& values) const noexcept { values = {rate}; }
};

/// x' = 1 or 2, or no value, by the digits of x: nothing that a step could resolve.
struct Erratic {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    bool fails = false;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        std::uint64_t digits = std::bit_cast<std::uint64_t>(s[0]) * 0x9E3779B97F4A7C15u;
        digits = (digits ^ (digits >> 29)) * 0xBF58476D1CE4E5B9u;
        const bool odd = (digits >> 32) % 10 < 3;
        ds[0] = odd && !fails ? 2 : 1;
        return odd && fails ? Status::newton_diverged : Status::ok;
    }
};

/// x' = -1 or 1, which changes 20000 times in 20000 pi.
struct Switched {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    Status rhs(double t, const State&, State& ds) const noexcept
    {
        ds[0] = std::sin(t) < 0 ? 1 : -1;
        return Status::ok;
    }
};

} // namespace

TEST_CASE("A run whose rejected steps bring it nowhere ends with the reason of the last rejection")
{
    const auto check = [](const auto& model, const auto& method, Status reason) {
        const auto run = integrate(model, Erratic::State(0.1), {0.0, 1.0}, method);
        CHECK(run.status() == reason);
        CHECK(run.rejected >= 10'000);
        CHECK(run.rejected <= 20'000);
        CHECK(run.t > 0);
        CHECK(run.t < 1e-3);
        CHECK(run.failed_at > run.t);
        // Backwards too.
        const auto back = integrate(model, Erratic::State(0.1), {1.0, 0.0}, method);
        CHECK(back.status() == reason);
        CHECK(back.t > 0.99);
    };
    check(Erratic{.fails = true}, Dop853{.tolerance = 1e-9}, Status::newton_diverged);
    check(Erratic{.fails = false}, Dop853{.tolerance = 1e-12}, Status::step_too_small);
}

TEST_CASE("A tolerance below the rounding of the state is refused at once, whatever the method")
{
    const auto check = [](auto method, auto one) {
        using Real = decltype(one);
        using Model = problems::Pendulum<Real>;
        method.tolerance = double(std::numeric_limits<Real>::epsilon()) / 100;
        const auto run = integrate(Model{}, typename Model::State(one, one), {Real(0), one}, method);
        CHECK(run.status() == Status::step_too_small);
        CHECK(run.steps == 0);
        CHECK(run.t == 0);
        method.tolerance = double(std::numeric_limits<Real>::epsilon());
        CHECK(integrate(Model{}, typename Model::State(one, one), {Real(0), one}, method).steps > 0);
    };
    check(Tsit5{}, 1.0);
    check(Dop853{}, 1.0);
    check(Dop853{}, 1.0F);
    check(Dop853{}, 1.0L);
    check(Radau5{}, 1.0);
}

TEST_CASE("Ten thousand rejected steps that do bring a run on are no reason to end it")
{
    constexpr int turns = LAGEN_SANITIZED ? 2'000 : 20'000;
    const auto run = integrate(Switched{}, Switched::State(0.0), {0.0, turns * 3.14159265358979}, Dop853{});
    CHECK(run.status() == Status::ok);
    CHECK(run.rejected > turns * 3 / 2);
    CHECK(std::abs(run.state[0]) < 1e-3);
}

TEST_CASE("An infall that no step resolves ends as step_too_small, an overflow as non_finite, whatever the method")
{
    const auto check = [](const auto& method) {
        const auto fall = integrate(Infall{}, Infall::State(1.0, 0.0), {0.0, 2.0}, method);
        CHECK(fall.status() == Status::step_too_small);
        CHECK_THAT(fall.t, Catch::WithinAbs(1.1107207345395915, 1e-4));
        CHECK(fall.state.allFinite());
        const auto growth = integrate(Growth{}, Growth::State(1.0), {0.0, 1000.0}, method);
        CHECK(growth.status() == Status::non_finite);
        CHECK_THAT(growth.t, Catch::WithinAbs(709.78, 5.0));
        CHECK(growth.state.allFinite());
    };
    for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
        check(Dopri5{.tolerance = tolerance});
        check(Tsit5{.tolerance = tolerance});
        check(Dop853{.tolerance = tolerance});
        check(Radau5{.tolerance = tolerance});
    }
}

TEST_CASE("A fixed step that diverges ends as non_finite at the first state that is no number")
{
    const auto check = [](const auto& method, std::size_t steps) {
        const auto run = integrate(Growth{.rate = -100}, Growth::State(1.0), {0.0, 1000.0}, method);
        CHECK(run.status() == Status::non_finite);
        CHECK(run.steps == steps);
        CHECK(run.state.allFinite());
        CHECK(std::abs(run.state[0]) > 1e300);
        CHECK(run.failed_at == Approx(run.t + 1).epsilon(1e-12));
    };
    // |1 + z + .. | at z = -100: 99 for Euler, 4001 for the midpoint rule + 900, and so on: log 1.8e308 / log of it.
    check(Euler{.step = 1}, static_cast<std::size_t>(308.2547 / std::log10(99.0)));
    check(Midpoint{.step = 1}, static_cast<std::size_t>(308.2547 / std::log10(4901.0)));
    // Implicit methods damp it.
    const auto damped = integrate(Growth{.rate = -100}, Growth::State(1.0), {0.0, 1000.0}, Gauss2{.step = 1});
    CHECK(damped.status() == Status::ok);
    CHECK_THAT(std::abs(damped.state[0]), Catch::WithinRel(std::pow(49.0 / 51.0, 1000), 1e-9));
    const auto over = integrate(Growth{}, Growth::State(1.0), {0.0, 1000.0}, Gauss4{.step = 0.25});
    CHECK(over.status() == Status::non_finite);
    CHECK_THAT(over.t, Catch::WithinAbs(709.75, 0.5));
}
