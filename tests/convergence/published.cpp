// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers that others published or that follow from closed forms: what the integrators must reproduce.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using problems::Arenstorf;
using problems::HeavyTop;
using Kepler = problems::Kepler<double>;

namespace {

template <class Method>
double kepler_energy_error(const Method& method)
{
    const auto run = integrate(Kepler{}, Kepler::State(0.4, 0, 0, 2), {0.0, 50.0}, method);
    REQUIRE(run.status() == Status::ok);
    return Kepler{}.energy(0, run.state) + 0.5;
}

auto like(double value, double relative)
{
    return Catch::WithinAbs(value, relative * std::abs(value));
}

/// x' = lambda x (dimension 1) or a rotation with rate lambda (dimension 2).
template <int n>
struct Linear {
    using Scalar = double;
    using State = Eigen::Matrix<double, n, 1>;
    static constexpr int dimension = n;
    double lambda = -1;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        if constexpr (n == 1) {
            ds = lambda * s;
        } else {
            const double x = s[0];
            ds[0] = -lambda * s[1];
            ds[1] = lambda * x;
        }
        return Status::ok;
    }
};

/// |R(z)| of one step of length 1.
template <int n, class Method>
double growth(double lambda)
{
    Method method{};
    if constexpr (requires { method.step; })
        method.step = 1;
    else
        method = Method{.tolerance = 1e12, .first_step = 1, .max_step = 1};
    using State = typename Linear<n>::State;
    const auto run = integrate(Linear<n>{lambda}, State(State::Unit(0)), {0.0, 1.0}, method);
    return run.state.norm();
}

} // namespace

TEST_CASE("Splitting methods reproduce the energy errors that SUNDIALS publishes for Kepler's problem")
{
    CHECK_THAT(kepler_energy_error(LeapfrogDkd{.step = 1e-3}), like(-1.0321183419037538e-07, 3e-6));
    CHECK_THAT(kepler_energy_error(LeapfrogDkd{.step = 5e-4}), like(-2.583236802244926e-08, 3e-6));
    CHECK_THAT(kepler_energy_error(LeapfrogKdk{.step = 1e-3}), like(3.21129917e-06, 3e-8));
    CHECK_THAT(kepler_energy_error(McLachlan4{.step = 0.1}), like(-5.3723049984188975e-06, 3e-8));
    CHECK_THAT(kepler_energy_error(McLachlan4{.step = 0.05}), like(-2.77646171387147e-07, 3e-7));
    CHECK_THAT(kepler_energy_error(Yoshida6{.step = 0.1}), like(0.00012681182276619296, 3e-8));
    CHECK_THAT(kepler_energy_error(Yoshida6{.step = 0.05}), like(2.0266123599288477e-06, 3e-8));
}

namespace {

/// Steps as long as r^(3/2) says.
struct PacedKepler : problems::Kepler<double> {
    [[nodiscard]] Eigen::Vector2d time_scale(double, const State& s) const noexcept
    {
        const double r = s.head<2>().norm(), root = std::sqrt(r);
        return {r * root, 1.5 * s.head<2>().dot(s.tail<2>()) / root};
    }
};

/// max|dH| over so many periods from the pericentre, and steps a period.
template <class Method>
std::pair<double, double> eccentric_orbit(double e, double periods, const Method& method)
{
    const PacedKepler kepler;
    const PacedKepler::State start(1 - e, 0, 0, std::sqrt((1 + e) / (1 - e)));
    double worst = 0;
    const auto watch = [&](double t, const PacedKepler::State& s) {
        worst = std::max(worst, std::abs(kepler.energy(t, s) - kepler.energy(0, start)));
    };
    const auto run = integrate(kepler, start, {0.0, 2 * M_PI * periods}, method, {}, watch);
    CHECK(run.status() == Status::ok);
    CHECK(run.rejected == 0);
    return {worst, static_cast<double>(run.steps) / periods};
}

} // namespace

// The numbers of a step that is a function of its beginning alone, 0.05 r^(3/2): 2.27e-3 after 100 periods and 2.52e-2
// after 1000 of e = 0.6, 7.2e-2 and 0.399 of e = 0.9.
TEST_CASE("Reversible steps keep the energy of eccentric orbits to the published errors, without drift")
{
    using Steps = Reversible<LeapfrogKdk>;
    for (const double periods : {100.0, 1000.0}) {
        const auto [error, steps] = eccentric_orbit(0.6, periods, Steps{.step = 0.05});
        CHECK_THAT(error, like(8.921e-4, 1e-4));
        CHECK_THAT(steps, like(136, 4e-3));
        const auto [large, many] = eccentric_orbit(0.9, periods, Steps{.step = 0.05});
        CHECK_THAT(large, like(4.644e-3, 2e-4));
        CHECK_THAT(many, like(168, 4e-3));
    }
    // A hundred times less with order 6 at as many evaluations, and no drift either.
    const auto [early, few] = eccentric_orbit(0.9, 20, Reversible<BlanesMoan6>{.step = 0.4});
    const auto [late, as_few] = eccentric_orbit(0.9, 400, Reversible<BlanesMoan6>{.step = 0.4});
    CHECK(late < 1.2 * early);
    CHECK(as_few < 30);
}

TEST_CASE("Reversible steps back from the pericentre are the mirror image of those forwards")
{
    const PacedKepler::State start(0.1, 0, 0, std::sqrt(19.0));
    Integrator there(PacedKepler{}, start, 0.0, Reversible<KahanLi8>{.step = 0.2});
    Integrator back = there;
    while (there.t() < 4) REQUIRE(there.step() == Status::ok);
    REQUIRE(back.advance_to(-there.t()) == Status::ok);
    CHECK(there.steps() == back.steps());
    CHECK(there.steps() > 10);
    const PacedKepler::State mirrored(back.state()[0], -back.state()[1], -back.state()[2], back.state()[3]);
    CHECK((there.state() - mirrored).norm() < 1e-12);
    CHECK((there.state() - start).norm() > 1);
}

TEST_CASE("The Arenstorf orbit closes after one period")
{
    const Arenstorf::State start(0.994, 0, 0, -2.00158510637908252240537862224);
    const double period = 17.0652165601579625588917206249;
    const auto run = integrate(Arenstorf{}, start, {0.0, period}, Dop853{.tolerance = 1e-14});
    REQUIRE(run.status() == Status::ok);
    CHECK((run.state - start).cwiseAbs().maxCoeff() < 3e-7);
    // Half a period away the orbit is elsewhere: closing is not standing still.
    const auto half = integrate(Arenstorf{}, start, {0.0, period / 2}, Dop853{.tolerance = 1e-14});
    CHECK((half.state - start).norm() > 1);
}

TEST_CASE("RK4 keeps the heavy top's transverse oscillation bounded at h = 0.0194 and not at 0.0196")
{
    const auto survives = integrate(HeavyTop{}, HeavyTop::start(), {0.0, 20.0}, Rk4{.step = 0.0194});
    CHECK(survives.status() == Status::ok);
    CHECK(survives.state.tail<3>().cwiseAbs().maxCoeff() < 1000);
    const auto blows = integrate(HeavyTop{}, HeavyTop::start(), {0.0, 20.0}, Rk4{.step = 0.0196});
    CHECK(blows.status() == Status::non_finite);
    CHECK_THAT(blows.t, Catch::WithinAbs(2.352, 1e-9));
    CHECK(blows.state.allFinite());
    const auto sooner = integrate(HeavyTop{}, HeavyTop::start(), {0.0, 20.0}, Rk4{.step = 0.02});
    CHECK_THAT(sooner.t, Catch::WithinAbs(0.94, 1e-9));
    const auto norm = [](double h) {
        return integrate(HeavyTop{}, HeavyTop::start(), {0.0, 20.0}, Rk4{.step = h}).state.head<4>().norm();
    };
    CHECK_THAT(norm(0.005), Catch::WithinAbs(0.9265, 5e-5));
    CHECK_THAT(norm(0.01), Catch::WithinAbs(0.100, 5e-4));
    CHECK_THAT(norm(0.015), Catch::WithinAbs(1.1e-7, 5e-9));
}

TEST_CASE("DOP853 follows the heavy top to the published states at t = 1 and 2")
{
    const std::array<double, 2> at{1.0, 2.0};
    const auto run = integrate(HeavyTop{}, HeavyTop::start(), {0.0, 2.0}, Dop853{.tolerance = 1e-13}, {.at = at});
    REQUIRE(run.states.size() == 2);
    const HeavyTop::State& one = run.states[0];
    // q and -q are the same attitude.
    CHECK_THAT(std::abs(one[0]), Catch::WithinAbs(0.732943980679663718, 1e-10));
    CHECK_THAT(one[4], Catch::WithinAbs(-0.822078101682704456, 1e-9));
    CHECK_THAT(one[6], Catch::WithinAbs(-5.92329134811733619, 1e-9));
    CHECK_THAT(std::abs(run.states[1][3]), Catch::WithinAbs(0.787986887550485669, 1e-10));
}

TEST_CASE("Stability ends where the stability polynomial says")
{
    // x' = -x with growth 1 at the end of the real interval; rotations at the end of the imaginary one.
    CHECK_THAT((growth<1, Rk4>(-2.785293563405348)), Catch::WithinAbs(1, 1e-12));
    CHECK((growth<1, Rk4>(-2.7853)) > 1);
    CHECK_THAT((growth<2, Rk4>(2.8284271247461903)), Catch::WithinAbs(1, 1e-12));
    CHECK((growth<2, Rk4>(2.83)) > 1);
    CHECK_THAT((growth<1, Dopri5>(-3.3065678926)), Catch::WithinAbs(1, 1e-9));
    CHECK_THAT((growth<2, Dopri5>(0.9971890088)), Catch::WithinAbs(1, 1e-10));
    CHECK_THAT((growth<2, Dopri5>(1.0)) - 1, like(1.39e-6, 5e-3));
    CHECK_THAT((growth<1, Dop853>(-6.3936515229)), Catch::WithinAbs(1, 1e-9));
    CHECK_THAT((growth<2, Dop853>(5.9603598117)), Catch::WithinAbs(1, 1e-9));
}

TEST_CASE("RK4 shrinks a quaternion's norm as |R(iy)| says: 0.9862242384 in square after 1e6 steps of y = 0.1")
{
    const auto run = integrate(Linear<2>{0.1}, Eigen::Vector2d(1, 0), {0.0, 1e6}, Rk4{.step = 1});
    CHECK(run.steps == 1000000);
    CHECK_THAT(run.state.squaredNorm(), Catch::WithinAbs(0.9862242384, 5e-11));
}

TEST_CASE("RK4 loses a rigid body's Casimir |Pi|^2 in proportion to time and to the fifth power of the step")
{
    using Body = problems::RigidBody<double>;
    const auto drift = [](double h, double end) {
        const auto run = integrate(Body{}, Body::State(std::cos(1.1), 0, std::sin(1.1)), {0.0, end}, Rk4{.step = h});
        return run.state.squaredNorm() - 1;
    };
    // The published digits are all that is compared: half a unit of the last.
    CHECK_THAT(drift(0.2, 100), Catch::WithinAbs(-7.23e-6, 0.5e-8));
    CHECK_THAT(drift(0.2, 1000), Catch::WithinAbs(-6.59e-5, 0.5e-7));
    CHECK_THAT(drift(0.1, 100), Catch::WithinAbs(-2.49e-7, 0.5e-9));
    CHECK_THAT(drift(0.1, 1000), Catch::WithinAbs(-2.087e-6, 0.5e-9));
    CHECK_THAT(drift(0.05, 1000), Catch::WithinAbs(-6.67e-8, 0.5e-10));
    CHECK_THAT(drift(0.1, 1000) / drift(0.05, 1000), Catch::WithinAbs(32, 1));
}

TEST_CASE("Dopri5 takes the steps of Hairer's dopri5 on Arenstorf's orbit: 240 steps, 216 accepted, 1442 calls")
{
    // The Fortran driver prints fcn= 1442 step= 240 accpt= 216 for rtol = atol = 1e-7.
    const Arenstorf::State start(0.994, 0, 0, -2.00158510637908252240537862224);
    const auto run = integrate(Arenstorf{}, start, {0.0, 17.0652165601579625588917206249}, Dopri5{.tolerance = 1e-7});
    CHECK(run.steps == 216);
    CHECK(run.steps + run.rejected == 240);
    CHECK(run.rhs_calls == 1442);
}

TEST_CASE("Dop853 rejects few steps on an eccentric orbit")
{
    const double e = 0.99;
    const Kepler::State start(1 - e, 0, 0, std::sqrt((1 + e) / (1 - e)));
    const double turns = 4 * std::acos(-1.0);
    const auto run = integrate(Kepler{}, start, {0.0, turns}, Dop853{.tolerance = 1e-12});
    const auto bold = integrate(Kepler{}, start, {0.0, turns}, Dop853{.tolerance = 1e-12, .safety = 0.9});
    CHECK(run.rejected * 20 < run.steps);
    CHECK(bold.rejected * 20 > bold.steps);
    CHECK(run.rhs_calls < bold.rhs_calls);
}

TEST_CASE("The rigid body returns after its period")
{
    using Body = problems::RigidBody<double>;
    const Body::State start(std::cos(1.1), 0, std::sin(1.1));
    const auto run = integrate(Body{}, start, {0.0, 10.7314652348828038}, Tsit5{.tolerance = 1e-12});
    CHECK((run.state - start).cwiseAbs().maxCoeff() < 1e-11);
}
