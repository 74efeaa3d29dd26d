// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method for the unknowns of kernels: what it calls converged, and what not.
#include "lagen/newton.hpp"
#include "lagen/lanes/pack.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;

namespace {

/// p = m u / sqrt(1 - |u|^2) in the plane, m = 6/5, whose solution is u = p / sqrt(m^2 + |p|^2).
template <class S>
struct Relativistic {
    S p, q;

    void operator()(const std::array<S, 2>& z, std::array<S, 2>& F, std::array<S, 4>& dF) const noexcept
    {
        using std::sqrt;
        const S u = z[0], v = z[1], room = S(1) - u * u - v * v, mass = S(1.2f) / sqrt(room);
        F = {S(u * mass - p), S(v * mass - q)};
        const S mixed = mass * u * v / room;
        dF = {S(mass + mass * u * u / room), mixed, mixed, S(mass + mass * v * v / room)};
    }
};

struct Solved {
    long double error; ///< the largest one of an unknown
    int calls;
};

template <class S>
Solved relativistic(long double size, long double angle)
{
    const Relativistic<S> equations{S(size * std::cos(angle)), S(size * std::sin(angle))};
    int calls = 0;
    std::array<S, 2> z{};
    const Status status = newton(z, [&](const auto& at, auto& F, auto& dF) noexcept {
        ++calls;
        equations(at, F, dF);
    });
    CHECK(status == Status::ok);
    const long double p = equations.p, q = equations.q, m = S(1.2f), all = std::sqrt(m * m + p * p + q * q);
    return {std::max(std::abs(z[0] - p / all), std::abs(z[1] - q / all)), calls};
}

/// The roots of one equation from 0: NaN with newton_diverged.
template <class Function>
double root(const Function& function, Status expected)
{
    std::array<double, 1> z{0};
    CHECK(newton(z, [&](const std::array<double, 1>& x, std::array<double, 1>& F, std::array<double, 1>& dF) noexcept {
              function(x[0], F[0], dF[0]);
          }) == expected);
    CHECK(std::isnan(z[0]) == (expected != Status::ok));
    return z[0];
}

/// a = p, b + b^3 = 2 with unknowns of different sizes.
template <class S>
std::array<S, 2> apart(S p)
{
    std::array<S, 2> z{};
    CHECK(newton(z, [&](const auto& x, auto& F, auto& dF) noexcept {
              F = {S(x[0] - p), S(x[1] * (x[1] * x[1] + S(1)) - S(2))};
              dF = {S(1), S(0), S(0), S(S(1) + S(3) * x[1] * x[1])};
          }) == Status::ok);
    return z;
}

/// The same, coupled: the second equation has a share of the first.
std::array<double, 2> coupled(double p)
{
    std::array<double, 2> z{};
    CHECK(newton(z, [&](const auto& x, auto& F, auto& dF) noexcept {
              F = {x[0] - p + 3 * x[1], x[1] * (x[1] * x[1] + 1) - 2};
              dF = {1, 3, 0, 1 + 3 * x[1] * x[1]};
          }) == Status::ok);
    return z;
}

} // namespace

TEST_CASE("An unknown converges to its own last places beside one that is larger by any factor")
{
    for (const float p : {1.0f, 1e3f, 1e5f, 1e6f, 1e7f, 1e8f, 1e10f, 1e30f})
        CHECK(apart(p) == std::array<float, 2>{p, 1});
    for (const double p : {1.0, 1e10, 1e14, 1e15, 1e16, 1e18, 1e20, 1e100, 1e300})
        CHECK(apart(p) == std::array<double, 2>{p, 1});
    for (const double p : {1.0, 1e10, 1e15, 1e20}) {
        const auto z = coupled(p);
        CHECK(z[1] == 1);
        CHECK(std::abs(z[0] - (p - 3)) <= tolerance::roundoff(1) * p);
    }
}

TEST_CASE("A velocity beside the speed of light is found to its last places, whatever the momentum")
{
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> uniform(0, 6.283);
    const auto check = [&]<class S>(S, long double size) {
        for (int k = 0; k < 20; ++k)
            CHECK(relativistic<S>(size, uniform(dice)).error <= 2 * std::numeric_limits<S>::epsilon());
        CHECK(relativistic<S>(size, 0).error <= 2 * std::numeric_limits<S>::epsilon());
    };
    for (const long double p : {0.1L, 1.0L, 10.0L, 100.0L, 1e3L}) check(0.0f, p);
    for (const long double p : {0.1L, 1.0L, 10.0L, 1e3L, 1e4L, 1e5L, 1e6L, 1e7L}) check(0.0, p);
    for (const long double p : {0.1L, 10.0L, 1e6L, 1e8L}) check(0.0L, p);
}

TEST_CASE("The momentum of the velocity found agrees as well as a unit of its last place lets it")
{
    const auto check = []<class S>(S, S p) {
        std::array<S, 2> z{};
        CHECK(newton(z, Relativistic<S>{p, S(0)}) == Status::ok);
        const auto momentum = [](S u) {
            const long double v = u;
            return S(1.2f) * v / std::sqrt((1 - v) * (1 + v));
        };
        CHECK(z[0] < S(1));
        const S below = std::nextafter(z[0], S(0)), above = std::nextafter(z[0], S(1));
        CHECK(momentum(std::nextafter(below, S(0))) < p);
        if (above < S(1)) CHECK(momentum(std::nextafter(above, S(1))) > p);
    };
    for (const float p : {1.0f, 30.0f, 300.0f, 1e3f}) check(0.0f, p);
    for (const double p : {1.0, 30.0, 1e4, 1e5, 1e6}) check(0.0, p);
}

TEST_CASE("An equation without a root, or with none that can be represented, diverges")
{
    for (const double p : {0.39, 0.4, 0.5}) // beyond the fold of v^3 - v at 2 / (3 sqrt 3), from the side of 0
        root([p](double v, double& F, double& dF) { F = v * v * v - v - p, dF = 3 * v * v - 1; },
             Status::newton_diverged);
    root([](double z, double& F, double& dF) { F = z * z - z + 1, dF = 2 * z - 1; }, Status::newton_diverged);
    root([](double z, double& F, double& dF) { F = dF = std::exp(z); }, Status::newton_diverged);
    root([](double z, double& F, double& dF) { F = std::sqrt(z - 1), dF = 0.5 / F; }, Status::newton_diverged);
    std::array<double, 2> z{};
    CHECK(newton(z, Relativistic<double>{1e12, 0}) == Status::newton_diverged);
}

TEST_CASE("Rounding errors of terms that cancel are measured by those terms, where they are given")
{
    const auto solve = [](double p, bool sized, Status expected) {
        std::array<double, 1> z{0};
        const auto function = [p](const auto& x, auto& F, auto& dF) noexcept {
            F = {std::exp(x[0]) - 1 - p};
            dF = {std::exp(x[0])};
        };
        CHECK((sized ? newton(z,
                              [&](const std::array<double, 1>& x, std::array<double, 1>& F, std::array<double, 1>& dF,
                                  std::array<double, 1>& size) noexcept {
                                  function(x, F, dF);
                                  size = {std::exp(x[0]) + 1 + p};
                              })
                     : newton(z, function)) == expected);
        return z[0];
    };
    for (const double p : {1e-10, 1e-12, 1e-15}) {
        CHECK(std::isnan(solve(p, false, Status::newton_diverged)));
        CHECK(std::abs(solve(p, true, Status::ok) - p) <= tolerance::roundoff(1));
    }
    // Terms do not make a root of what has none.
    std::array<double, 1> z{0};
    CHECK(newton(z, [](const std::array<double, 1>& x, std::array<double, 1>& F, std::array<double, 1>& dF,
                       std::array<double, 1>& size) noexcept {
              F = {(x[0] - 1) * (x[0] - 1) + 1e-9};
              dF = {2 * (x[0] - 1)};
              size = {4};
          }) == Status::newton_diverged);
}

TEST_CASE("Steps are shortened until F and its derivative are finite")
{
    for (const double p : {1e15, 1e100, 1e300})
        CHECK(std::abs(root([p](double v, double& F, double& dF) { F = std::exp(v) - 1 - p, dF = std::exp(v); },
                            Status::ok) /
                           std::log(p) -
                       1) <= tolerance::roundoff(1));
    const double arc =
        root([](double v, double& F, double& dF) { F = std::asin(v) - 1, dF = 1 / std::sqrt(1 - v * v); }, Status::ok);
    CHECK(std::abs(arc - std::sin(1.0)) <= tolerance::roundoff(1));
}

TEST_CASE("Beside the speed of light, in a frame that moves, every direction is found")
{
    // p = m gamma (u + w, v), whose terms are given; from u = v = 0
    const auto check = []<class S>(S, long double size) {
        const long double w = 0.5L;
        for (int k = 0; k < 72; ++k) {
            const long double angle = k * std::acos(-1.0L) / 36, p = size * std::cos(angle), q = size * std::sin(angle);
            std::array<S, 2> z{};
            const Relativistic<S> moving{S(p), S(q)};
            const Status status = newton(z, [&](const std::array<S, 2>& at, std::array<S, 2>& F, std::array<S, 4>& dF,
                                                std::array<S, 2>& terms) noexcept {
                moving({S(at[0] + S(w)), at[1]}, F, dF);
                terms = {S(std::abs(F[0]) + 2 * std::abs(moving.p)), S(std::abs(F[1]) + 2 * std::abs(moving.q))};
            });
            CHECK(status == Status::ok);
            const long double m = S(1.2f), P = moving.p, Q = moving.q, all = std::sqrt(m * m + P * P + Q * Q);
            CHECK(std::abs(z[0] - (P / all - w)) <= 8 * std::numeric_limits<S>::epsilon());
            CHECK(std::abs(z[1] - Q / all) <= 8 * std::numeric_limits<S>::epsilon());
        }
    };
    for (const long double size : {0.1L, 1.0L, 30.0L}) check(0.0f, size);
    for (const long double size : {0.1L, 1.0L, 10.0L, 100.0L, 1e3L, 1e5L}) check(0.0, size);
    for (const long double size : {1.0L, 1e4L}) check(0.0L, size);
}

TEST_CASE("Where the guess is near the speed of light every direction is found")
{
    // (p, q, r) = 1.3 gamma V with V = z + (0.6, -0.7, 0), from z = 0
    std::mt19937 dice(8);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 2000; ++k) {
        const double all = std::pow(10, -4 + 8 * (k % 100) / 99.0);
        const std::array<double, 3> p{all * normal(dice), all * normal(dice), all * normal(dice)}, w{0.6, -0.7, 0};
        std::array<double, 3> z{};
        const Status status = newton(z, [&](const std::array<double, 3>& at, std::array<double, 3>& F,
                                            std::array<double, 9>& dF, std::array<double, 3>& size) noexcept {
            const std::array<double, 3> V{at[0] + w[0], at[1] + w[1], at[2] + w[2]};
            const double root = std::sqrt(1 - V[0] * V[0] - V[1] * V[1] - V[2] * V[2]), mass = 1.3 / root;
            for (std::size_t i = 0; i < 3; ++i) {
                F[i] = mass * V[i] - p[i];
                size[i] = std::abs(mass * V[i]) * (4 + 8 / (root * root)) + std::abs(F[i]);
                for (std::size_t j = 0; j < 3; ++j)
                    dF[3 * i + j] = mass * ((i == j ? 1 : 0) + V[i] * V[j] / (root * root));
            }
        });
        INFO(p[0] << " " << p[1] << " " << p[2]);
        CHECK(status == Status::ok);
        const double energy = std::sqrt(1.69 + p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(z[i] - (p[i] / energy - w[i])) <= 1e-14);
    }
}

TEST_CASE("Sizes that are far too large cost the last places, and make no root of the guess")
{
    for (const double p : {9.0, 30.0, 40.0}) {
        std::array<double, 1> z{0};
        CHECK(newton(z, [p](const std::array<double, 1>& x, std::array<double, 1>& F, std::array<double, 1>& dF,
                            std::array<double, 1>& size) noexcept {
                  F = {std::exp(x[0]) - p};
                  dF = {std::exp(x[0])};
                  size = {1e17};
              }) == Status::ok);
        CHECK(std::abs(z[0] - std::log(p)) <= 1e-14);
    }
}

TEST_CASE("A residual of exactly zero is a root, also where its derivative is singular")
{
    CHECK(root([](double z, double& F, double& dF) { F = z * z * z, dF = 3 * z * z; }, Status::ok) == 0);
}

TEST_CASE("An equation that is not computed to its last places is solved to what is computed")
{
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> uniform(0.5, 3);
    for (const double size : {1.0, 1e3, 1e5})
        for (int k = 0; k < 200; ++k) {
            const double x = uniform(dice), p = x + x * x * x;
            const double z = root(
                [=](double b, double& F, double& dF) {
                    const double lost = size * std::exp(1.1 * b); // takes the last digits along
                    F = ((b + b * b * b + lost) - lost) - p;
                    dF = 1 + 3 * b * b;
                },
                Status::ok);
            CHECK(std::abs(z - x) * (1 + 3 * x * x) <= tolerance::roundoff(4) * (size * std::exp(1.1 * x) + p));
        }
}

TEST_CASE("Steps that go to and fro across a narrow bend are no rounding errors")
{
    // p = z + A (z - 1)/sqrt((z - 1)^2 + e^2) bends within e of 1 by 2 A, a hundred millionth.
    const double A = 5e-9, e = 1e-12;
    for (const double p : {1.0, 1 + 3e-10, 1 + 2e-9, 1 - 4e-9, 1.1}) {
        INFO(p);
        std::array<double, 1> z{0};
        CHECK(newton(z, [=](const std::array<double, 1>& x, std::array<double, 1>& F, std::array<double, 1>& dF,
                            std::array<double, 1>& size) noexcept {
                  const double away = x[0] - 1, root = std::sqrt(away * away + e * e);
                  F = {x[0] - p + A * away / root};
                  dF = {1 + A * (e / root) * (e / root) / root};
                  size = {std::abs(x[0]) + 2 * std::abs(x[0] - p) + 8 * A};
              }) == Status::ok);
        double low = 0, high = 2;
        for (int k = 0; k < 100; ++k) {
            const double middle = (low + high) / 2, away = middle - 1;
            (middle - p + A * away / std::sqrt(away * away + e * e) < 0 ? low : high) = middle;
        }
        CHECK(std::abs(z[0] - low) <= tolerance::roundoff(4));
    }
}

TEST_CASE("What is easy takes as many evaluations as Newton's method has steps, and one")
{
    CHECK(relativistic<double>(0.1L, 1).calls <= 6);
    CHECK(relativistic<double>(0.3L, 1).calls <= 6);
    CHECK(relativistic<double>(1.0L, 1).calls <= 9);
    CHECK(relativistic<double>(3.0L, 1).calls <= 14);
    int calls = 0;
    std::array<double, 1> z{0};
    CHECK(newton(z, [&](const auto& x, auto& F, auto& dF) noexcept {
              ++calls;
              F = {3 * x[0] - 1};
              dF = {3};
          }) == Status::ok);
    CHECK(z[0] == 1.0 / 3);
    CHECK(calls == 2);
}

TEST_CASE("Every lane of a pack has the root, and the status, of its scalar")
{
    using P = Pack<double, 4>;
    const std::array<double, 4> momenta{0.0, 1.0, 1e6, 1e12}, others{0.5, -2.0, 1e-3, 0.0};
    std::array<P, 2> z{};
    const auto status = newton(z, Relativistic<P>{P(momenta), P(others)});
    for (std::size_t lane = 0; lane < 4; ++lane) {
        std::array<double, 2> alone{};
        const int index = static_cast<int>(lane);
        CHECK(newton(alone, Relativistic<double>{momenta[lane], others[lane]}) == status[index]);
        CHECK(status[index] == (lane < 3 ? Status::ok : Status::newton_diverged));
        for (std::size_t k = 0; k < 2; ++k)
            CHECK((lane < 3 ? z[k][index] == alone[k] : std::isnan(z[k][index]) && std::isnan(alone[k])));
    }
}
