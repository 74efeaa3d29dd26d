// SPDX-License-Identifier: GPL-2.0-or-later
/// What steps do to orbits in the long run: steps that are a function of their beginning, reversible ones, close
/// encounters, and round-off. Numbers that were computed elsewhere in quadruple precision, or laws.
#include "lagen/integrate.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

using Kepler = problems::Kepler<double>;

Kepler::State pericentre(double e)
{
    return {1 - e, 0, 0, std::sqrt((1 + e) / (1 - e))};
}

/// The largest |H - H_0| of Verlet's method over so many periods, steps of the length that the state where they begin
/// has, length(r).
template <class Length>
double worst_energy(double e, double periods, const Length& length)
{
    const Kepler kepler;
    Integrator orbit(kepler, pericentre(e), 0.0, LeapfrogKdk{.step = 1});
    double worst = 0;
    bool good = true;
    while (good && orbit.t() < 2 * M_PI * periods) {
        const Kepler::State s = orbit.state();
        good = orbit.advance_to(orbit.t() + length(std::hypot(s[0], s[1]))) == Status::ok;
        worst = std::max(worst, std::abs(kepler.energy(0, orbit.state()) + 0.5));
    }
    CHECK(good);
    return worst;
}

/// The same in proportion to |H_0|, of fixed steps over one period.
double encounter(double e, int steps)
{
    const Kepler kepler;
    Integrator orbit(kepler, pericentre(e), 0.0, LeapfrogKdk{.step = 2 * M_PI / steps});
    double worst = 0;
    bool good = true;
    for (int k = 0; k < steps; ++k) {
        good = good && orbit.step() == Status::ok;
        worst = std::max(worst, 2 * std::abs(kepler.energy(0, orbit.state()) + 0.5));
    }
    CHECK(good);
    return worst;
}

/// Root mean squares of what a pendulum of each of 64 amplitudes misses its start by, so many steps there and back.
struct Missed {
    double state, energy;
};

template <class Method>
Missed there_and_back(const Method& method, int steps)
{
    using Pendulum = problems::Pendulum<double>;
    const auto energy = [](const Pendulum::State& s) {
        return problems::Pendulum<long double>{}.energy(0, s.cast<long double>());
    };
    const auto moved = [&](const Pendulum::State& s) {
        Integrator integrator(Pendulum{}, s, 0.0, method);
        for (int k = 0; k < steps; ++k) static_cast<void>(integrator.step());
        return Pendulum::State(integrator.state()[0], -integrator.state()[1]);
    };
    double state = 0;
    long double squares = 0;
    constexpr int starts = 64;
    for (int k = 0; k < starts; ++k) {
        const Pendulum::State start(0.4 + 0.025 * k, 0.1), back = moved(moved(start));
        state += (back - start).squaredNorm() / starts;
        squares += (energy(back) - energy(start)) * (energy(back) - energy(start)) / starts;
    }
    return {std::sqrt(state), std::sqrt(static_cast<double>(squares))};
}

/// The exponents of time with which they grow from 1000 steps to so many times more.
template <class Method>
Missed growth(const Method& method, int times)
{
    const Missed few = there_and_back(method, 1000), many = there_and_back(method, 1000 * times);
    return {std::log(many.state / few.state) / std::log(times), std::log(many.energy / few.energy) / std::log(times)};
}

} // namespace

// What cures it, Reversible<LeapfrogKdk>, is measured in convergence: 8.921e-4 and 4.644e-3, after 100 periods and
// after 1000.
TEST_CASE("steps that are a function of their beginning make Verlet's method drift, constant ones do not")
{
    const auto by_distance = [](double r) { return 0.05 * r * std::sqrt(r); };
    CHECK(worst_energy(0.6, 100, by_distance) == Approx(2.273e-3).epsilon(1e-3));
    CHECK(worst_energy(0.6, 1000, by_distance) == Approx(2.523e-2).epsilon(1e-3));
    CHECK(worst_energy(0.9, 100, by_distance) == Approx(7.231e-2).epsilon(1e-3));
    CHECK(worst_energy(0.9, 1000, by_distance) == Approx(0.3985).epsilon(1e-3));
    const auto fixed = [](double h) { return [h](double) { return h; }; };
    CHECK(worst_energy(0.6, 100, fixed(0.025)) == Approx(2.323e-3).epsilon(3e-3));
    CHECK(worst_energy(0.6, 1000, fixed(0.025)) == Approx(2.323e-3).epsilon(3e-3));
    CHECK(worst_energy(0.9, 1000, fixed(0.01)) == Approx(0.1296).epsilon(3e-3));
}

TEST_CASE("a thousand steps of Verlet's method a period lose the energy of close encounters")
{
    CHECK(encounter(0, 1000) == Approx(3.9e-10).epsilon(2e-2));
    CHECK(encounter(0.3, 1000) == Approx(2.15e-5).epsilon(3e-3));
    CHECK(encounter(0.6, 1000) == Approx(2.93e-4).epsilon(3e-3));
    CHECK(encounter(0.9, 1000) == Approx(0.0999).epsilon(3e-3));
    CHECK(encounter(0.99, 1000) == Approx(1170).epsilon(5e-3));
    CHECK(encounter(0.999, 1000) == Approx(9.87e6).epsilon(3e-3));
    CHECK(encounter(0.3, 100'000) == Approx(2.15e-9).epsilon(3e-3));
    CHECK(encounter(0.9, 100'000) == Approx(9.85e-6).epsilon(3e-3));
    CHECK(encounter(0.99, 100'000) == Approx(0.106).epsilon(5e-3));
    CHECK(encounter(0.999, 100'000) == Approx(1950).epsilon(5e-3));
}

TEST_CASE("round-off of a symmetric method grows as Brouwer's law says, the error of RK4 by a power of time faster")
{
    // Of a symmetric method the way back undoes all but round-off.
    for (const Missed& found : {growth(LeapfrogKdk{.step = 0.1}, 30), growth(KahanLi8{.step = 0.1}, 30)}) {
        CHECK(found.energy == Approx(0.5).margin(0.15));
        CHECK(found.state == Approx(1.5).margin(0.2));
    }
    const Missed damped = growth(Rk4{.step = 0.1}, 10);
    CHECK(damped.energy == Approx(1).margin(0.05));
    CHECK(damped.state == Approx(2).margin(0.05));
    // The rounding errors of the sums, kept, are worth a factor of four and more.
    const Missed kept = there_and_back(LeapfrogKdk{.step = 0.1}, 10'000);
    const Missed dropped = there_and_back(LeapfrogKdk{.step = 0.1, .compensated = false}, 10'000);
    CHECK(dropped.energy > 4 * kept.energy);
    CHECK(dropped.state > 4 * kept.state);
}
