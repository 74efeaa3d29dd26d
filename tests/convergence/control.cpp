// SPDX-License-Identifier: GPL-2.0-or-later
/// What step control makes of the pairs: errors that follow the tolerance, few rejected steps, and work that grows as
/// the order says.
#include "lagen/integrate.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

/// Kepler, e = 0.6, as a system of second order, over about three revolutions.
struct Kepler : lagen::problems::Kepler<long double> {
    static constexpr auto second_order = lagen::SecondOrder::velocity_free;
};
constexpr long double eccentricity = 0.6L, end = 20;

struct Effort {
    double error, calls, rejected;
};

template <class Method>
Effort effort(double tolerance)
{
    const auto run =
        lagen::integrate(Kepler{}, Kepler::exact(eccentricity, 0), {0, end}, Method{.tolerance = tolerance});
    REQUIRE(run.status() == lagen::Status::ok);
    return {static_cast<double>((run.state - Kepler::exact(eccentricity, end)).norm()),
            static_cast<double>(run.rhs_calls), static_cast<double>(run.rejected) / static_cast<double>(run.steps)};
}

/// A tenth of the tolerance makes steps 10^(1 / order) times as short, `order` being that of the estimate in h.
template <class Method>
void check_control(double order, double slack = 0.2)
{
    const Effort coarse = effort<Method>(1e-9), fine = effort<Method>(1e-15);
    for (const auto& [effort, tolerance] : {std::pair{coarse, 1e-9}, {fine, 1e-15}}) {
        CHECK(effort.error < 1000 * tolerance);
        CHECK(effort.error > tolerance / 1000);
        CHECK(effort.rejected < 0.35);
    }
    INFO(order << ": " << coarse.calls << " and " << fine.calls << " calls, " << coarse.error << " and " << fine.error);
    CHECK_THAT(std::log10(fine.calls / coarse.calls) * order / 6, Catch::WithinAbs(1, slack));
}

/// The fewest calls over a ladder of tolerances for an error below 1e-12.
template <class Method>
double calls_for_small_error()
{
    double calls = 1e9;
    for (double tolerance = 1e-8; tolerance > 1e-17; tolerance /= 2) {
        const Effort found = effort<Method>(tolerance);
        if (found.error < 1e-12) calls = std::min(calls, found.calls);
    }
    return calls;
}

} // namespace

TEST_CASE("Errors of the pairs follow the tolerance, their work goes with its root of the order of the estimate")
{
    check_control<lagen::Dopri5>(5);
    check_control<lagen::Tsit5>(5);
    check_control<lagen::Verner65>(6);
    check_control<lagen::Verner76>(7);
    check_control<lagen::Verner87>(8);
    check_control<lagen::Verner98>(9);
    check_control<lagen::Rkn64>(5);
    check_control<lagen::Rkn86>(7);
    check_control<lagen::Rkn1210>(11, 0.35); // 23 steps a revolution: many are rejected at the pericentre
    check_control<lagen::Rkng54>(5);
}

TEST_CASE("For a small error a pair of high order takes fewer calls, and one for x'' = f(t, x) fewer than others")
{
    const double verner65 = calls_for_small_error<lagen::Verner65>(),
                 verner98 = calls_for_small_error<lagen::Verner98>();
    const double dop853 = calls_for_small_error<lagen::Dop853>(), rkn86 = calls_for_small_error<lagen::Rkn86>();
    const double rkn1210 = calls_for_small_error<lagen::Rkn1210>();
    INFO(verner65 << " " << verner98 << " " << dop853 << " " << rkn86 << " " << rkn1210);
    CHECK(verner98 < 0.8 * verner65);
    CHECK(verner98 < dop853);
    CHECK(rkn86 < 0.8 * dop853);
    CHECK(rkn1210 < 0.8 * rkn86);
}
