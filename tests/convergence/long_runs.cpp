// SPDX-License-Identifier: GPL-2.0-or-later
/// A million steps: what Gauss' methods keep of the rigid body, and symplectic methods of Kepler's problem and Henon
/// and Heiles' potential where their steps are short enough, they keep to rounding, and the rounding errors add up like
/// a random walk [Brouwer 1937]. Fewer steps under sanitizers.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace lagen;
using Body = problems::RigidBody<double>;

namespace {

constexpr std::size_t most_steps = 1'000'000;

/// Casimir and energy of a state, computed with more digits than they are tested to.
struct Kept {
    long double casimir, energy;
};

Kept kept(const Body::State& s)
{
    const long double a = s[0], b = s[1], c = s[2];
    return {a * a + b * b + c * c, (a * a / 2 + b * b + c * c * 3 / 2) / 2};
}

/// The largest errors, in units of the last place times the square root of the number of steps, after 10^3, 10^4, ..
/// steps of length 0.1.
template <class Method>
double largest_walk(const Method& method)
{
    const Body::State start(std::cos(1.1), 0, std::sin(1.1));
    const Kept begin = kept(start);
    std::size_t step = 0, next = 1000;
    long double largest = 0;
    const auto watch = [&](double, const Body::State& s) {
        if (step++ != next) return;
        const Kept now = kept(s);
        const long double error = std::max(std::abs(now.casimir - begin.casimir), std::abs(now.energy - begin.energy)) /
                                  std::numeric_limits<double>::epsilon();
        largest = std::max(largest, error / std::sqrt(static_cast<long double>(next)));
        next *= 10;
    };
    const double end = method.step * static_cast<double>(most_steps);
    const auto run = integrate(Body{}, start, {0.0, end}, method, {}, watch);
    CHECK(run.status() == Status::ok);
    CHECK(run.steps == most_steps);
    CHECK(run.decompositions == run.steps);
    CHECK(run.newton_iterations < 8 * run.steps);
    return static_cast<double>(largest);
}

template <class S>
struct Orbit : problems::Kepler<S> {
    static constexpr auto second_order = SecondOrder::velocity_free;
    static constexpr bool takes_packs = true;
};

template <class S>
struct Stars : problems::HenonHeiles<S> {
    static constexpr auto second_order = SecondOrder::velocity_free;
    static constexpr bool takes_packs = true;
};

/// The largest error of the energy, as above, of steps so short that the method's own error is less than rounding.
template <template <class> class Problem, class Method>
double largest_energy_walk(const Problem<double>& problem, const typename Problem<double>::State& start,
                           const Method& method)
{
    const auto energy = [](const auto& s) { return Problem<long double>{}.energy(0, s.template cast<long double>()); };
    const long double begin = energy(start);
    std::size_t step = 0, next = 1000;
    long double largest = 0;
    const auto watch = [&](double, const auto& s) {
        if (step++ != next) return;
        const long double error = std::abs(energy(s) - begin) / std::numeric_limits<double>::epsilon();
        largest = std::max(largest, error / std::sqrt(static_cast<long double>(next)));
        next *= 10;
    };
    const auto run = integrate(problem, start, {0.0, method.step * static_cast<double>(most_steps)}, method, {}, watch);
    CHECK(run.status() == Status::ok);
    CHECK(run.steps == most_steps);
    return static_cast<double>(largest);
}

template <class Method>
double orbit_walk(const Method& method)
{
    return largest_energy_walk(Orbit<double>{}, problems::Kepler<double>::exact(0.2, 0.5), method);
}

template <class Method>
double star_walk(const Method& method)
{
    return largest_energy_walk(Stars<double>{}, {0.1, 0.2, 0.3, 0.1}, method);
}

} // namespace

// A drift of 1e-4 units a step, which is what a product with 0.1 rounded to one side amounts to, would be 0.1 here.
TEST_CASE("Casimir and energy of a rigid body walk by less than 0.06 units of the last place per root of steps")
{
    CHECK(largest_walk(Gauss2{.step = 0.1}) < 0.06);
    CHECK(largest_walk(Gauss4{.step = 0.1}) < 0.06);
    CHECK(largest_walk(Gauss6{.step = 0.1}) < 0.06);
    CHECK(largest_walk(Gauss8{.step = 0.1}) < 0.06);
}

// By a drift of 1e-4 units a step it would be 0.1 at the end.
TEST_CASE("The energy of symplectic methods walks by less than 0.1 units of the last place per root of steps")
{
    CHECK(star_walk(Srkn6{.step = 0.02}) < 0.1);
    CHECK(orbit_walk(KahanLi8{.step = 0.02}) < 0.1);
    CHECK(star_walk(Gauss16{.step = 0.3}) < 0.1);
}

TEST_CASE("Without the compensation the walk is many times longer")
{
    CHECK(largest_walk(Gauss4{.step = 0.1, .compensated = false}) > 0.15);
    CHECK(orbit_walk(KahanLi8{.step = 0.02, .compensated = false}) > 0.15);
}
