// SPDX-License-Identifier: GPL-2.0-or-later
/// Where methods fail, by numbers that were computed elsewhere in quadruple precision: windows of Galerkin's
/// variational integrators, resonances of the step with a motion and with fast forces, damping, and fixed-point
/// iteration.
#include "stability/scheme_limits.hpp"

#include "lagen/integrate.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

namespace {

constexpr double pi = std::numbers::pi;

struct Quadrature {
    std::vector<double> nodes, weights; ///< on [0, 1]
};

const double root3 = std::sqrt(3.0), root5 = std::sqrt(5.0), root15 = std::sqrt(15.0);
const Quadrature gauss1{{0.5}, {1}};
const Quadrature gauss2{{(3 - root3) / 6, (3 + root3) / 6}, {0.5, 0.5}};
const Quadrature gauss3{{(5 - root15) / 10, 0.5, (5 + root15) / 10}, {5.0 / 18, 4.0 / 9, 5.0 / 18}};
const Quadrature lobatto2{{0, 1}, {0.5, 0.5}};
const Quadrature lobatto3{{0, 0.5, 1}, {1.0 / 6, 2.0 / 3, 1.0 / 6}};
const Quadrature lobatto4{{0, (5 - root5) / 10, (5 + root5) / 10, 1}, {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12}};

/// Value and slope of Lagrange's polynomial i of even nodes k/s at x.
std::pair<double, double> lagrange(int s, int i, double x)
{
    double value = 1, slope = 0;
    for (int j = 0; j <= s; ++j) {
        if (j == i) continue;
        const double factor = (x * s - j) / (i - j);
        slope = slope * factor + value * s / (i - j);
        value *= factor;
    }
    return {value, slope};
}

/// Half the trace of a step of length 1 of the discrete Lagrangian of x'^2/2 - u x^2/2, u = (h omega)^2, polynomials of
/// degree s and this quadrature, the inner nodes eliminated: D_2 L_d + D_1 L_d = b x_(k-1) + 2 a x_k + b x_(k+1).
double half_trace(int s, const Quadrature& rule, double u)
{
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(s + 1, s + 1);
    for (std::size_t q = 0; q < rule.nodes.size(); ++q)
        for (int i = 0; i <= s; ++i)
            for (int j = 0; j <= s; ++j) {
                const auto [vi, di] = lagrange(s, i, rule.nodes[q]);
                const auto [vj, dj] = lagrange(s, j, rule.nodes[q]);
                form(i, j) += rule.weights[q] * (di * dj - u * vi * vj);
            }
    Eigen::Matrix2d ends;
    ends << form(0, 0), form(0, s), form(s, 0), form(s, s);
    if (s > 1) {
        Eigen::MatrixXd sides(s - 1, 2);
        sides << form.block(1, 0, s - 1, 1), form.block(1, s, s - 1, 1);
        ends -= sides.transpose() * form.block(1, 1, s - 1, s - 1).fullPivLu().solve(sides);
    }
    return -(ends(0, 0) + ends(1, 1)) / (2 * ends(0, 1));
}

/// Where stability changes for h omega below 9, to 1e-9.
std::vector<double> changes(int s, const Quadrature& rule)
{
    const auto stable = [&](double x) { return std::abs(half_trace(s, rule, x * x)) <= 1 + 1e-12; };
    std::vector<double> found;
    constexpr double apart = 1e-3;
    for (double x = 0.1003; x < 9; x += apart) {
        if (stable(x) == stable(x + apart)) continue;
        double low = x, high = x + apart;
        for (int k = 0; k < 40; ++k) {
            const double middle = (low + high) / 2;
            (stable(middle) == stable(x) ? low : high) = middle;
        }
        found.push_back(low);
    }
    return found;
}

void check_changes(int s, const Quadrature& rule, const std::vector<double>& expected, double margin)
{
    const std::vector<double> found = changes(s, rule);
    INFO("P" << s << " with " << rule.nodes.size() << " points");
    REQUIRE(found.size() >= expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) CHECK(found[k] == Approx(expected[k]).margin(margin));
}

/// x'' = -x.
struct Spring {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = {s[1], -s[0]};
        return lagen::Status::ok;
    }
};

/// x'' = -x - x^2.
struct Cubic {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2, base_dimension = 1;
    static constexpr auto second_order = lagen::SecondOrder::velocity_free;
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = {s[1], -s[0] - s[0] * s[0]};
        return lagen::Status::ok;
    }
    lagen::Status jacobian_values(double, const State& s, std::array<double, 2>& values) const noexcept
    {
        values = {1, -1 - 2 * s[0]};
        return lagen::Status::ok;
    }
};

/// x'' = x.
struct Hill {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2;
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = {s[1], s[0]};
        return lagen::Status::ok;
    }
    lagen::Status jacobian_values(double, const State&, std::array<double, 2>& values) const noexcept
    {
        values = {1, 1};
        return lagen::Status::ok;
    }
};

template <class Method>
bool stays(double step, double amplitude, int steps)
{
    lagen::Integrator integrator(Cubic(), Eigen::Vector2d(amplitude, 0), 0.0, Method{.step = step});
    for (int k = 0; k < steps; ++k)
        if (integrator.step() != lagen::Status::ok || !(std::abs(integrator.state()[0]) < 3)) return false;
    return true;
}

/// The first start, in steps of 0.004, that leaves.
template <class Method>
double stable_amplitude(double step, int steps)
{
    for (double x = 0.004; x < 0.7; x += 0.004)
        if (!stays<Method>(step, x, steps)) return x - 0.004;
    return 0.7;
}

} // namespace

TEST_CASE("Galerkin variational integrators have windows of instability where the quadrature is not Gauss' own")
{
    for (const auto& [scheme, degree, rule] :
         {std::tuple{"trapezoidal", 1, lobatto2}, {"lobatto:3", 2, lobatto3}, {"lobatto:4", 3, lobatto4}})
        check_changes(degree, rule, {lagen::scheme_limits(scheme).value().imaginary}, 1e-8); // exact
    for (const char* scheme : {"midpoint", "gauss:1", "gauss:2", "gauss:3", "gauss:4"})
        CHECK(lagen::scheme_limits(scheme).value().imaginary == lagen::no_limit);
    CHECK(lagen::scheme_limits("lobatto:3").value().imaginary == Approx(std::sqrt(8.0)).epsilon(1e-15));
    CHECK(lagen::scheme_limits("left").value().imaginary == 2);
    CHECK_FALSE(lagen::scheme_limits("gauss:5"));
    check_changes(1, lobatto2, {2}, 1e-8); // Verlet
    check_changes(1, gauss2, {std::sqrt(12.0)}, 1e-8);
    check_changes(2, lobatto3, {std::sqrt(8.0), std::sqrt(12.0), std::sqrt(24.0)}, 1e-8);
    check_changes(2, gauss3, {3.162, 3.464, 7.75}, 5e-3);
    check_changes(3, lobatto4, {3.11, std::sqrt(10.0), std::sqrt(30.0), 7.75}, 5e-3);
    CHECK(changes(1, gauss1).empty());
    CHECK(changes(2, gauss2).empty());
    CHECK(changes(3, gauss3).empty());
}

TEST_CASE("steps that resonate with a motion shrink what is stable, far inside the linear limit")
{
    constexpr int steps = 20000;
    using Verlet = lagen::LeapfrogKdk;
    CHECK(stable_amplitude<Verlet>(0.1, steps) == Approx(0.492).margin(0.02));
    CHECK(stable_amplitude<Verlet>(1, steps) == Approx(0.502).margin(0.03));
    CHECK(stable_amplitude<Verlet>(1.43, steps) == Approx(0.103).margin(0.02)); // behind 4:1 at sqrt 2
    CHECK(stable_amplitude<Verlet>(1.6, steps) == Approx(0.256).margin(0.02));
    CHECK(stable_amplitude<Verlet>(std::sqrt(3.0), steps) <= 0.012);          // 3:1
    CHECK(stable_amplitude<lagen::Gauss2>(2 * std::sqrt(3.0), 4000) <= 0.02); // the same, of an A-stable method
    CHECK(stable_amplitude<lagen::Gauss2>(2, 2000) > 0.4);
}

TEST_CASE("impulses resonate with what is fast: pi - 2 atan(h / 2 omega) < h omega < pi")
{
    for (const auto& [omega, width, growth] : {std::tuple{50.0, 1.2566e-3, 6.284e-4}, {10.0, 3.141e-2, 1.575e-2}}) {
        // Kick by h, flow of x'' = -omega^2 x: half of the trace of a step.
        const auto excess = [omega = omega](double x) {
            return std::abs(std::cos(x) - x / (omega * omega) / 2 * std::sin(x)) - 1;
        };
        double low = pi - 2 * width, high = pi - width / 2, most = 0;
        REQUIRE((excess(low) < 0 && excess(high) > 0));
        for (int k = 0; k < 60; ++k) (excess((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
        for (int k = 1; k < 1000; ++k) most = std::max(most, excess(low + (pi - low) * k / 1000));
        CHECK(2 * std::atan(pi / omega / (2 * omega)) == Approx(width).epsilon(1e-3)); // h at the upper end
        CHECK(pi - low == Approx(width).epsilon(0.011));
        CHECK(low == Approx(pi - 2 * std::atan(low / omega / (2 * omega))).epsilon(1e-12));
        CHECK(std::acosh(1 + most) == Approx(growth).epsilon(0.01));
        CHECK(excess(pi + 1e-6) < 0);
    }
}

// `lagen run` finds these arrows by a way of its own (commands, "a discrete body turns by asin(h Omega)").
TEST_CASE("Newton's method for Moser and Veselov's step takes 3, 4, 6, 7, 9, 22 iterations up to h Omega = 1")
{
    // J W - W^T J = h hat(mu) about a principal axis, in the rotation by theta: I sin(theta) = I h Omega, from 1 on.
    const auto iterations = [](double speed) {
        double theta = 0;
        for (int k = 0; k < 100; ++k) {
            const double residual = speed - std::sin(theta);
            if (std::abs(residual) < 1e-13) return k;
            theta += residual / std::cos(theta);
        }
        return -1;
    };
    CHECK(iterations(0.1) == 3);
    CHECK(iterations(0.5) == 4);
    CHECK(iterations(0.9) == 6);
    CHECK(iterations(0.99) == 7);
    CHECK(iterations(0.999) == 9);
    CHECK(iterations(1) == 22);
    CHECK(iterations(1.001) == -1);
}

TEST_CASE("a million steps of RK4 damp an oscillation by (1 - y^6/72 + y^8/576)^(10^6)")
{
    lagen::Integrator integrator(Spring(), Eigen::Vector2d(1, 0), 0.0, lagen::Rk4{.step = 0.1});
    bool good = true;
    for (int k = 0; k < 1'000'000; ++k) good = good && integrator.step() == lagen::Status::ok;
    REQUIRE(good);
    CHECK(integrator.state().squaredNorm() == Approx(0.9862242384).margin(2e-10));
}

TEST_CASE("fixed-point iteration of Gauss' methods converges for h omega below the least pole of R")
{
    const auto least = []<std::size_t s>() {
        double modulus = 1e9;
        for (const auto& start : lagen::detail::GaussScheme<s>::poles) {
            const auto z = lagen::detail::pole<lagen::detail::GaussScheme<s>, double>(start);
            modulus = std::min(modulus, std::hypot(z.re, z.im));
        }
        return modulus;
    };
    CHECK(least.operator()<1>() == Approx(2).epsilon(1e-12));
    CHECK(least.operator()<2>() == Approx(3.464102).margin(1e-6));
    CHECK(least.operator()<3>() == Approx(4.644371).margin(1e-6));
    CHECK(least.operator()<4>() == Approx(6.04653).margin(1e-5));
    CHECK(least.operator()<6>() == Approx(8.672054).margin(1e-6));
    CHECK(least.operator()<8>() == Approx(11.309682).margin(1e-6));
}

TEST_CASE("gauss2 multiplies e^t by (1 + h/2)/(1 - h/2) on both sides of its pole, and says where it cannot")
{
    int found = 0, refused = 0;
    for (int digits = 1; digits <= 16; ++digits)
        for (const double sign : {-1.0, 1.0, 0.0}) {
            const double h = 2 + sign * std::pow(10, -digits), distance = std::abs(1 - h / 2);
            const auto run = lagen::integrate(Hill(), Eigen::Vector2d(1, 0), {0.0, h}, lagen::Gauss2{.step = h});
            INFO("h - 2 = " << h - 2);
            if (run) {
                const double up = (1 + h / 2) / (1 - h / 2), down = 1 / up, epsilon = 2.2e-16;
                for (const double value : {run.state[0] / ((up + down) / 2), run.state[1] / ((up - down) / 2)})
                    CHECK(std::abs(value - 1) < 8 * epsilon / distance);
                ++found;
            } else {
                CHECK(run.status() == lagen::Status::newton_diverged);
                CHECK(distance < 1e-5);
                CHECK((run.t == 0 && run.state == Eigen::Vector2d(1, 0)));
                ++refused;
            }
        }
    CHECK((found >= 10 && refused >= 16)); // at the pole itself always
}
