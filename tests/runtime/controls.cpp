// SPDX-License-Identifier: GPL-2.0-or-later
/// Angles in closed form, the watch over maxima that are not proved, and runs of models that follow their controls.
#include <lagen/controls.hpp>
#include <lagen/integrate.hpp>
#include <lagen/lanes/pack.hpp>
#include <lagen/newton.hpp>
#include <lagen/tangents.hpp>

#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

double angle_near(double b, double c, double u)
{
    std::array<double, 1> z{u};
    REQUIRE(nearest_angles<double, 1>({b}, {c}, z) == Status::ok);
    return z[0];
}

/// H = p u - cost(t, u) on a line, x' = u and p' = 0, where the stationary point nearest to the guess is found by
/// Newton's method: what a generated class does.
template <class Cost>
struct Line {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2;
    struct {
        double u = not_a_number;
    } guess;

    [[nodiscard]] Status solve_controls(double t, const State& s, std::array<double, 1>& z) const noexcept
    {
        z[0] = number_or<double>(guess.u, Cost::start);
        return newton(z, [&](const std::array<double, 1>& u, std::array<double, 1>& slope,
                             std::array<double, 1>& curvature) noexcept {
            slope[0] = s[1] - Cost::slope(t, u[0]);
            curvature[0] = -Cost::curvature(t, u[0]);
        });
    }
    [[nodiscard]] Status rhs(double t, const State& s, State& ds) const noexcept
    {
        std::array<double, 1> u;
        const Status status = solve_controls(t, s, u);
        ds = {u[0], 0.0};
        return status;
    }
    [[nodiscard]] Status follow(double t, const State& s) noexcept
    {
        std::array<double, 1> u;
        auto status = solve_controls(t, s, u);
        const bool same = is_same_maximum(std::array<double, 1>{guess.u}, u,
                                          [&](const std::array<double, 1>& at, std::array<double, 1>& matrix) noexcept {
                                              matrix[0] = -Cost::curvature(t, at[0]);
                                          });
        StatusOf<double>::fail(status, !same, Status::not_a_maximum);
        if (same) guess.u = u[0];
        return status;
    }
};

/// (1 - t) u^2/2 + u^4/4: u = 0 is a maximum of H at p = 0 until t = 1.
struct Fork {
    static constexpr double start = 0;
    static double slope(double t, double u) { return (1 - t) * u + u * u * u; }
    static double curvature(double t, double u) { return 1 - t + 3 * u * u; }
};

/// u^3/3 - (1 - t) u: the maximum sqrt(1 - t) meets a minimum at t = 1.
struct Fold {
    static constexpr double start = 1;
    static double slope(double t, double u) { return u * u - (1 - t); }
    static double curvature(double, double u) { return 2 * u; }
};

/// u^4/4 + 2 u^3/3 - u^2/2 - (1/2 - t) u: the hill of H at u > 0 goes at u = (sqrt(7) - 2)/3, one at u < -1 stays.
struct TwoHills {
    static constexpr double start = 1;
    static double slope(double t, double u) { return u * u * u + 2 * u * u - u - (0.5 - t); }
    static double curvature(double, double u) { return 3 * u * u + 4 * u - 1; }
};

template <class Cost, class Method>
void loses_its_maximum(double when, double slack, const Method& method)
{
    const Line<Cost> model;
    const auto run = integrate(model, Eigen::Vector2d(0, 0), {0.0, 3.0}, method);
    CHECK(run.status() == Status::not_a_maximum);
    CHECK(run.failed_at >= when - slack);
    CHECK(run.failed_at <= when + slack);
    CHECK(run.t <= run.failed_at);
    CHECK(run.t >= when - slack);
    CHECK(std::isnan(model.guess.u)); // the caller's own model is as it was
}

} // namespace

TEST_CASE("an angle is found in the direction of (b, c), as near as can be to the one before", "[controls]")
{
    for (const double from : {0.0, 1.0, -40.0, 7.0, 300.0})
        for (const double turn : {0.0, 0.5, -2.0, 3.0}) {
            const double u = angle_near(2.5 * std::cos(from + turn), 2.5 * std::sin(from + turn), from);
            CHECK(u == Approx(from + turn).epsilon(tolerance::roundoff(8)).margin(tolerance::roundoff(8)));
        }
    CHECK(angle_near(-1, 1e-9, 3) == Approx(pi).epsilon(1e-8));
    CHECK(angle_near(-1, -1e-9, 3) == Approx(pi).epsilon(1e-8));
    CHECK(angle_near(-1, -1e-9, -3) == Approx(-pi).epsilon(1e-8));
    CHECK(angle_near(0, 1e-300, 0) == Approx(pi / 2));
    double u = 0;
    for (int k = 1; k <= 100; ++k) u = angle_near(std::cos(0.7 * k), std::sin(0.7 * k), u);
    CHECK(u == Approx(70).epsilon(tolerance::roundoff(64)));
}

TEST_CASE("an angle on which H does not depend is singular", "[controls]")
{
    std::array<double, 2> z{0.5, 0.25};
    CHECK(nearest_angles<double, 2>({1.0, 0.0}, {0.0, 0.0}, z) == Status::singular_control);
    CHECK(std::abs(z[0]) <= tolerance::roundoff(1));
    CHECK(std::isnan(z[1]));
    CHECK(std::string(to_text(Status::singular_control)) == "singular_control");
    CHECK(std::string(to_text(Status::not_a_maximum)) == "not_a_maximum");
}

TEST_CASE("lanes of a pack have angles of their own", "[controls]")
{
    using P = Pack<double, 4>;
    P b(0), c(0), u(0);
    const double angles[] = {0.25, 3.5, -6.0, 0.0};
    for (int lane = 0; lane < 4; ++lane) {
        b.set(lane, lane == 3 ? 0 : std::cos(angles[lane]));
        c.set(lane, lane == 3 ? 0 : std::sin(angles[lane]));
        u.set(lane, angles[lane] + 0.125);
    }
    std::array<P, 1> z{u};
    const auto status = nearest_angles<P, 1>({b}, {c}, z);
    for (int lane = 0; lane < 3; ++lane) {
        CHECK(status[lane] == Status::ok);
        CHECK(z[0][lane] == Approx(angles[lane]).epsilon(tolerance::roundoff(16)));
    }
    CHECK(status[3] == Status::singular_control);
    CHECK(std::isnan(z[0][3]));
    P guess(not_a_number);
    guess.set(1, 2.0);
    const P start = number_or<P>(guess, P(5));
    CHECK(start[0] == 5);
    CHECK(start[1] == 2);
}

TEST_CASE("a matrix is negative definite where all its pivots are negative", "[controls]")
{
    CHECK(is_negative_definite<double, 1>(std::array<double, 1>{-1e-300}));
    CHECK_FALSE(is_negative_definite<double, 1>(std::array<double, 1>{0.0}));
    CHECK_FALSE(is_negative_definite<double, 1>(std::array<double, 1>{not_a_number}));
    CHECK(is_negative_definite<double, 2>(std::array<double, 4>{-1, 0.5, 0.5, -1}));
    CHECK_FALSE(is_negative_definite<double, 2>(std::array<double, 4>{-1, 1, 1, -1}));
    CHECK_FALSE(is_negative_definite<double, 2>(std::array<double, 4>{-1, 2, 2, -1}));
    CHECK_FALSE(is_negative_definite<double, 2>(std::array<double, 4>{0, 1, 1, -1}));
    CHECK(is_negative_definite<double, 3>(std::array<double, 9>{-2, 1, 0, 1, -2, 1, 0, 1, -2}));
    CHECK_FALSE(is_negative_definite<double, 3>(std::array<double, 9>{-1, 1, 0, 1, -1, 1, 0, 1, -2}));
}

TEST_CASE("a maximum beyond a valley is another one", "[controls]")
{
    // H = cos(u): maxima at 0 and 2 pi.
    const auto curvature = [](const std::array<double, 1>& u, std::array<double, 1>& matrix) noexcept {
        matrix[0] = -std::cos(u[0]);
    };
    const auto same = [&](double from, double to) {
        return is_same_maximum(std::array<double, 1>{from}, std::array<double, 1>{to}, curvature);
    };
    CHECK(same(1.5, 0));
    CHECK(same(not_a_number, 0));
    CHECK_FALSE(same(0, 2 * pi));
    CHECK_FALSE(same(not_a_number, pi));
    CHECK_FALSE(same(pi, pi));
    CHECK_FALSE(same(0, not_a_number));
}

TEST_CASE("a run whose controls are no maximum any more ends there", "[controls]")
{
    loses_its_maximum<Fork>(1, 1e-9, Dop853{.tolerance = 1e-10});
    loses_its_maximum<Fork>(1, 1e-9, Dopri5{.tolerance = 1e-8});
    loses_its_maximum<Fork>(1, 0.02, Rk4{.step = 0.01});
    loses_its_maximum<Fold>(1, 1e-6, Dop853{.tolerance = 1e-10});
    loses_its_maximum<Fold>(1, 1e-4, Tsit5{.tolerance = 1e-8});
    const double u = (std::sqrt(7.0) - 2) / 3, gone = 0.5 + u - 2 * u * u - u * u * u;
    loses_its_maximum<TwoHills>(gone, 1e-6, Dop853{.tolerance = 1e-10});
    loses_its_maximum<TwoHills>(gone, 0.02, Rk4{.step = 0.01});
}

TEST_CASE("a run that starts at a minimum of H does not leave its start", "[controls]")
{
    const auto run = integrate(Line<Fork>{}, Eigen::Vector2d(0, 0), {2.0, 3.0}, Dop853{.tolerance = 1e-10});
    CHECK(run.status() == Status::not_a_maximum);
    CHECK(run.t == 2);
    CHECK(run.steps == 0);
}

TEST_CASE("the branch of the start is followed as long as it is a maximum", "[controls]")
{
    // x' = sqrt(1 - t) up to t = 0.9, forwards and backwards again.
    const auto there = integrate(Line<Fold>{}, Eigen::Vector2d(0, 0), {0.0, 0.9}, Dop853{.tolerance = 1e-12});
    REQUIRE(there.status() == Status::ok);
    CHECK(there.state[0] == Approx((1 - std::pow(0.1, 1.5)) / 1.5).epsilon(1e-10));
    const auto back = integrate(Line<Fold>{}, there.state, {0.9, -3.0}, Dop853{.tolerance = 1e-12});
    REQUIRE(back.status() == Status::ok);
    CHECK(back.state[0] == Approx((1 - std::pow(4.0, 1.5)) / 1.5).epsilon(1e-10));
}

TEST_CASE("a model with tangents follows the controls of its model", "[controls]")
{
    using Plain = Line<Fold>;
    struct Linear : Plain {
        Status variational(double, const Eigen::Vector2d&, const Eigen::Vector2d&, Eigen::Vector2d& dv) const noexcept
        {
            dv.setZero();
            return Status::ok;
        }
    };
    using Tangents = WithTangents<Linear, 1>;
    static_assert(Follows<Plain> && Follows<Tangents>);
    const auto all = Tangents::state(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0));
    const auto run = integrate(Tangents{}, all, {0.0, 0.9}, Dop853{.tolerance = 1e-12});
    REQUIRE(run.status() == Status::ok);
    CHECK(run.state[0] == Approx((1 - std::pow(0.1, 1.5)) / 1.5).epsilon(1e-10));
    CHECK(integrate(Tangents{}, all, {0.0, 3.0}, Dop853{.tolerance = 1e-10}).status() == Status::not_a_maximum);
}
