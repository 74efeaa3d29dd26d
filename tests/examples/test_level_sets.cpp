// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on level sets against equations in one angle, which know no constraint.
#include "cartesian_pendulum.hpp"
#include "four_bar.hpp"
#include "lagen/lagen.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

using Pendulum = models::cartesian_pendulum<double>;
using Linkage = models::four_bar<double>;

/// Positions and rates of the linkage whose crank is at th, for a rate 1 of the crank.
struct Closed {
    double ph, ps, ph_rate, ps_rate;
};

/// The end B of the coupler lies where the circles of coupler and rocker meet, to the left of the way from the end A of
/// the crank to the pivot D of the rocker.
Closed closed_at(double th, const Linkage::Parameters& p)
{
    const double Ax = p.a * std::cos(th), Ay = p.a * std::sin(th);
    const double ux = p.d - Ax, uy = -Ay, s = std::hypot(ux, uy);
    const double along = (s * s + p.b * p.b - p.c * p.c) / (2 * s), across = std::sqrt(p.b * p.b - along * along);
    const double Bx = Ax + (along * ux - across * uy) / s, By = Ay + (along * uy + across * ux) / s;
    Closed q{std::atan2(By - Ay, Bx - Ax), std::atan2(By, Bx - p.d), 0, 0};
    // The velocity of B is at right angles to the rocker, and its part along the coupler is that of A.
    q.ps_rate = p.a * std::sin(th - q.ph) / (p.c * std::sin(q.ps - q.ph));
    q.ph_rate = p.a * std::sin(th - q.ps) / (p.b * std::sin(q.ps - q.ph));
    return q;
}

/// Twice the kinetic energy for a rate 1 of the crank, by the moments of the bars.
double inertia_at(double th, const Linkage::Parameters& p)
{
    const Closed q = closed_at(th, p);
    const double middle =
        p.a * p.a + p.a * p.b * q.ph_rate * std::cos(th - q.ph) + p.b * p.b * q.ph_rate * q.ph_rate / 4;
    return p.m_a * p.a * p.a / 3 + p.m_b * middle + p.m_b * p.b * p.b * q.ph_rate * q.ph_rate / 12 +
           p.m_c * p.c * p.c * q.ps_rate * q.ps_rate / 3;
}

double height_at(double th, const Linkage::Parameters& p)
{
    const Closed q = closed_at(th, p);
    return p.g * (p.m_a * p.a * std::sin(th) / 2 + p.m_b * (p.a * std::sin(th) + p.b * std::sin(q.ph) / 2) +
                  p.m_c * p.c * std::sin(q.ps) / 2);
}

} // namespace

TEST_CASE("the pendulum in Cartesian coordinates moves like its angle, swinging and over the top")
{
    const Pendulum model;
    const double l = model.parameters.l, g = model.parameters.g;
    const auto by_angle = ode<2>([=](double, const auto& s, auto& ds) {
        ds[0] = s[1];
        ds[1] = -g / l * std::sin(s[0]);
    });
    for (const auto& [angle, rate] : {std::pair{2.4, 0.3}, {0.0, 6.0}}) {
        const auto start = Pendulum::state({.x = l * std::sin(angle), .y = -l * std::cos(angle)}, {.w = rate});
        const auto run = integrate(model, start, {0.0, 8.0}, Dop853{.tolerance = 1e-13});
        const auto known = integrate(by_angle, Eigen::Vector2d(angle, rate), {0.0, 8.0}, Dop853{.tolerance = 1e-13});
        REQUIRE(run);
        REQUIRE(known);
        CHECK(std::abs(known.state[0] - angle) > 0.5);
        CHECK(run.state[0] == Approx(l * std::sin(known.state[0])).margin(1e-10));
        CHECK(run.state[1] == Approx(-l * std::cos(known.state[0])).margin(1e-10));
        CHECK(run.state[2] == Approx(known.state[1]).margin(1e-10));
        CHECK(std::abs(model.constraints(0, run.state)[0]) < 1e-11);
        CHECK(model.energy(0, run.state) == Approx(model.energy(0, start)).epsilon(1e-11));
    }
}

TEST_CASE("the four-bar linkage turns like its crank, whose rate follows from the energy alone")
{
    const Linkage model;
    const Linkage::Parameters& p = model.parameters;
    const Closed q = closed_at(0, p);
    const auto start = Linkage::state({.th = 0, .ph = q.ph, .ps = q.ps}, {.v_th = 9});
    CHECK(model.constraints(0, start).norm() < 1e-14);
    const double energy = inertia_at(0, p) * 81 / 2 + height_at(0, p);
    CHECK(model.energy(0, start) == Approx(energy).epsilon(1e-14));
    const auto rate_at = [&](double th) { return std::sqrt(2 * (energy - height_at(th, p)) / inertia_at(th, p)); };
    const auto by_crank = ode<1>([&](double, const auto& s, auto& ds) { ds[0] = rate_at(s[0]); });

    const auto run = integrate(model, start, {0.0, 4.0}, Dop853{.tolerance = 1e-13});
    const auto known = integrate(by_crank, Eigen::Matrix<double, 1, 1>(0.0), {0.0, 4.0}, Dop853{.tolerance = 1e-13});
    REQUIRE(run);
    REQUIRE(known);
    const double th = known.state[0];
    CHECK(th > 40); // several turns
    const Closed there = closed_at(th, p);
    CHECK(run.state[0] == Approx(th).margin(1e-9));
    CHECK(run.state[1] == Approx(there.ph).margin(1e-9));
    CHECK(run.state[2] == Approx(there.ps).margin(1e-9));
    CHECK(run.state[3] == Approx(rate_at(th)).margin(1e-8));
    CHECK(model.constraints(0, run.state).norm() < 1e-11);
    CHECK(model.energy(0, run.state) == Approx(energy).epsilon(1e-11));
}
