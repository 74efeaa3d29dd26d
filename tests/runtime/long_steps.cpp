// SPDX-License-Identifier: GPL-2.0-or-later
/// Gauss' methods with steps so long that Newton's method converges slowly: their equations are solved to rounding all
/// the same, or the step fails.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace lagen;

namespace {

using Body = problems::RigidBody<double>;
using Wide = Eigen::Matrix<long double, 3, 1>;

/// |s1 - s - h f((s + s1)/2)| of the midpoint rule, computed with more digits.
long double residual(const Body::State& s, const Body::State& s1, double h)
{
    const Wide from = s.cast<long double>(), to = s1.cast<long double>(), middle = (from + to) / 2;
    Wide slope;
    CHECK(problems::RigidBody<long double>{}.rhs(0, middle, slope) == Status::ok);
    return (to - from - static_cast<long double>(h) * slope).cwiseAbs().maxCoeff();
}

/// Every state of a run.
template <class Method>
std::vector<Body::State> states_of(const Method& method, std::size_t steps, Status expected)
{
    std::vector<Body::State> states;
    const auto watch = [&](double, const Body::State& s) { states.push_back(s); };
    const double end = method.step * static_cast<double>(steps);
    const auto run = integrate(Body{}, Body::State(1.1, 0.3, -0.9), {0.0, end}, method, {}, watch);
    CHECK(run.status() == expected);
    return states;
}

double energy(const Body::State& s)
{
    return (s[0] * s[0] / 2 + s[1] * s[1] + 1.5 * s[2] * s[2]) / 2;
}

} // namespace

TEST_CASE("Every step of the midpoint rule solves its equation to rounding, however long it is")
{
    // Steps of few binary digits, whose multiples are exact.
    for (const double h : {0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 2.8125}) {
        const auto states = states_of(Gauss2{.step = h, .compensated = false}, 2000, Status::ok);
        REQUIRE(states.size() == 2001);
        long double worst = 0;
        for (std::size_t k = 1; k < states.size(); ++k) worst = std::max(worst, residual(states[k - 1], states[k], h));
        CHECK(worst > 0);
        CHECK(worst < 1e-14L);
    }
}

TEST_CASE("Casimir and energy of a rigid body are kept by long steps too, of every Gauss method")
{
    const auto check = [](const auto& method) {
        const auto states = states_of(method, 1000, Status::ok);
        const double casimir = states[0].squaredNorm(), first = energy(states[0]);
        double worst = 0, farthest = 0;
        for (const auto& s : states) {
            worst = std::max({worst, std::abs(s.squaredNorm() - casimir), std::abs(energy(s) - first)});
            farthest = std::max(farthest, (s - states.front()).norm());
        }
        CHECK(worst < 5e-14);
        CHECK(farthest > 1);
    };
    for (const double h : {1.0, 1.5, 2.0}) {
        check(Gauss2{.step = h});
        check(Gauss4{.step = h});
        check(Gauss6{.step = h});
        check(Gauss8{.step = h});
    }
}

TEST_CASE("A step that is too long for Newton's method fails, and the steps before it kept the Casimir")
{
    const auto states = states_of(Gauss2{.step = 16}, 1000, Status::newton_diverged);
    for (const auto& s : states) CHECK(std::abs(s.squaredNorm() - states[0].squaredNorm()) < 5e-14);
}

TEST_CASE("A slow convergence gets a better Jacobian, a fast one none")
{
    const auto decompositions = [](double h) {
        const auto run = integrate(Body{}, Body::State(1.1, 0.3, -0.9), {0.0, 100 * h}, Gauss2{.step = h});
        CHECK(run.status() == Status::ok);
        CHECK(run.newton_iterations < 30 * run.steps);
        return run.decompositions;
    };
    CHECK(decompositions(0.5) == 100);
    CHECK(decompositions(2.5) > 110);
    CHECK(decompositions(2.5) < 400);
}
