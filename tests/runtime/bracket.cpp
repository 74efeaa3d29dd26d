// SPDX-License-Identifier: GPL-2.0-or-later
/// Roots between bounds: ends, open intervals, functions on which Newton's method alone goes astray, packs.
#include <lagen/bracket.hpp>
#include <lagen/lanes/pack.hpp>

#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class S>
struct Found {
    S z;
    status_t<S> status;
};

/// The root of one falling function.
template <class S, class F, class D>
Found<S> root_of(S lower, S upper, const F& f, const D& slope)
{
    std::array<S, 1> z{};
    const auto status =
        bracket(z, std::array<S, 1>{lower}, std::array<S, 1>{upper},
                [&](const std::array<S, 1>& at, std::array<S, 1>& value, std::array<S, 1>& derivative) noexcept {
                    value[0] = f(at[0]);
                    derivative[0] = slope(at[0]);
                });
    return {z[0], status};
}

Found<double> root_of_tangent(double target, double lower, double upper)
{
    return root_of(
        lower, upper, [&](double u) { return target - std::tan(u); },
        [](double u) { return -1 - std::tan(u) * std::tan(u); });
}

Found<double> root_of_exponential(double target, double lower, double upper)
{
    return root_of(
        lower, upper, [&](double u) { return target - std::exp(u); }, [](double u) { return -std::exp(u); });
}

} // namespace

TEST_CASE("a root inside its interval is found to round-off", "[bracket]")
{
    for (const double target : {-13.0, -4.0, -0.5, 1e-9, 0.7, 4.0, 14.0}) {
        INFO(target);
        const Found<double> found = root_of_tangent(target, -1.5, 1.5);
        CHECK(found.status == Status::ok);
        CHECK(std::abs(found.z - std::atan(target)) <= tolerance::roundoff(8) * std::abs(std::atan(target)));
    }
    // Newton's steps from the middle of [-10, 10] lead far away: u/sqrt(1 + u^2) is flat.
    for (const double target : {0.999, -0.99, 0.3}) {
        const Found<double> found = root_of(
            -10.0, 100.0, [&](double u) { return target - u / std::sqrt(1 + u * u); },
            [](double u) { return -std::pow(1 + u * u, -1.5); });
        const double exact = target / std::sqrt((1 - target) * (1 + target));
        CHECK(std::abs(found.z - exact) <= 1e-12 * std::abs(exact)); // of the condition 1/(1 - target^2)
    }
    CHECK(root_of_tangent(0, -1.25, 1.5).z == Approx(0).margin(1e-30));
}

TEST_CASE("without a root the end next to it is taken", "[bracket]")
{
    CHECK(root_of_tangent(20, -1.5, 1.5).z == 1.5);
    CHECK(root_of_tangent(-20, -1.5, 1.5).z == -1.5);
    CHECK(root_of_exponential(-1, -1, 1).z == -1);
    CHECK(root_of_exponential(-1, -1, infinite).z == -1);
    CHECK(root_of_exponential(100, -infinite, 1).z == 1);
}

TEST_CASE("an open interval is searched outwards, and has a status where there is no root", "[bracket]")
{
    CHECK(root_of_exponential(1e9, -1, infinite).z == Approx(std::log(1e9)).epsilon(tolerance::roundoff(8)));
    CHECK(root_of_exponential(1e-9, -infinite, 1).z == Approx(std::log(1e-9)).epsilon(tolerance::roundoff(8)));
    for (const double target : {1e-6, 0.5, 1e6})
        CHECK(root_of_exponential(target, -infinite, infinite).z ==
              Approx(std::log(target)).epsilon(tolerance::roundoff(16)));
    const Found<double> none = root_of(
        0.0, infinite, [](double u) { return 1 + std::exp(-u); }, [](double u) { return -std::exp(-u); });
    CHECK(none.status == Status::newton_diverged);
    CHECK(std::isnan(none.z));
    const Found<double> undefined = root_of(
        -1.0, 1.0, [](double u) { return std::sqrt(u - 2); }, [](double u) { return 0.5 / std::sqrt(u - 2); });
    CHECK(undefined.status == Status::newton_diverged);
    CHECK(std::isnan(undefined.z));
}

TEST_CASE("a function that only tends to zero has no root where it underflows", "[bracket]")
{
    // H = p u - exp(u) at p = 0, u - sqrt(1 + u^2), u - log(cosh(u)): no maximum.
    const auto falling = [](double u) { return -std::exp(u); };
    CHECK(root_of(-infinite, infinite, falling, falling).status == Status::newton_diverged);
    CHECK(root_of(-infinite, 1.0, falling, falling).status == Status::newton_diverged);
    CHECK(root_of(
              -infinite, infinite, [](double u) { return 1 - u / std::sqrt(1 + u * u); },
              [](double u) { return -std::pow(1 + u * u, -1.5); })
              .status == Status::newton_diverged);
    CHECK(root_of(
              -infinite, infinite, [](double u) { return 1 - std::tanh(u); },
              [](double u) { return -1 / (std::cosh(u) * std::cosh(u)); })
              .status == Status::newton_diverged);
    // A root where the search begins is one, and the end of an interval too.
    const auto cubic = [](double u) { return -u * u * u; };
    const auto slope = [](double u) { return -3 * u * u; };
    CHECK(root_of(-infinite, infinite, cubic, slope).z == 0);
    CHECK(root_of(0.0, infinite, cubic, slope).z == 0);
}

TEST_CASE("an interval may be as wide as its scalar, and a root as small", "[bracket]")
{
    const auto quartic = [](auto p, auto lower, auto upper) { // of u^4/4 + u^2/2: p = u^3 + u
        using S = decltype(p);
        return root_of(
            lower, upper, [p](const S& u) { return p - u * u * u - u; },
            [](const S& u) { return S(-1) - S(3) * u * u; });
    };
    constexpr double most = std::numeric_limits<double>::max();
    for (const auto& [lower, upper] : {std::pair{-1e70, 2e70}, {-1e100, 2e100}, {-most, most}, {-3.0, 1e200}}) {
        CHECK(quartic(2.0, lower, upper).z == 1);
        CHECK(quartic(0.0, lower, upper).z == 0);
        CHECK(quartic(-10.0, -most, upper).z == -2);
        CHECK(quartic(1e-200, lower, upper).z == 1e-200);
    }
    CHECK(quartic(2.0f, -1e30f, 2e30f).z == 1);
    const Found<double> power = root_of(
        -1.0, 2.0, [](double u) { return 4e-240 - 4 * u * u * u; }, [](double u) { return -12 * u * u; });
    CHECK(power.z == Approx(1e-80).epsilon(tolerance::roundoff(8)));
    // A slope without bound is no step of length 0.
    const Found<double> root = root_of(
        0.0, 1e9, [](double u) { return 3 - std::sqrt(u); },
        [](double u) { return u == 0 ? -infinite : -0.5 / std::sqrt(u); });
    CHECK(root.z == Approx(9).epsilon(tolerance::roundoff(8)));
    CHECK(root_of_tangent(0.5, infinite, infinite).status == Status::newton_diverged);
}

TEST_CASE("a short step is no root where the function has not changed its sign", "[bracket]")
{
    // 0 = dH/du of (u - 1.2)^2/2 + sqrt((u - 1)^2 + w^2)/10: at 1, where it is 0.2, the slope is -0.1/w.
    for (const double width : {1e-10, 1e-15, 1e-17, 1e-30}) {
        const Found<double> found = root_of(
            0.5, 1.5, [&](double u) { return 1.2 - u - 0.1 * (u - 1) / std::sqrt((u - 1) * (u - 1) + width * width); },
            [&](double u) {
                const double root = std::sqrt((u - 1) * (u - 1) + width * width);
                return -1 - 0.1 * (width / root) * (width / root) / root;
            });
        INFO(width);
        CHECK(found.status == Status::ok);
        CHECK(found.z == Approx(1.1).epsilon(tolerance::roundoff(8)));
    }
    // A jump: the place where the sign changes.
    const Found<double> jump = root_of(
        -1.0, 3.0, [](double u) { return u < 0.7 ? 1.0 : -1.0; }, [](double) { return -1e20; });
    CHECK(jump.z == Approx(0.7).epsilon(tolerance::roundoff(4)));
}

TEST_CASE("an end where terms overflow is not believed", "[bracket]")
{
    const auto flat = [](auto target, auto lower, auto upper) { // p = u/sqrt(1 + u^2), which is computed as 0 far away
        using S = decltype(target);
        std::array<S, 1> z{};
        const auto status = bracket(z, std::array<S, 1>{lower}, std::array<S, 1>{upper},
                                    [&](const std::array<S, 1>& at, std::array<S, 1>& value,
                                        std::array<S, 1>& derivative, std::array<S, 1>& size) noexcept {
                                        using std::abs;
                                        using std::sqrt;
                                        const S root = sqrt(S(1) + at[0] * at[0]);
                                        value[0] = target - at[0] / root;
                                        derivative[0] = S(-1) / (root * root * root);
                                        size[0] = S(2) * root * abs(at[0]) / (root * root) + abs(value[0]);
                                    });
        return Found<S>{z[0], status};
    };
    for (const double end : {1e100, 1e160, 1e300, std::numeric_limits<double>::max(), infinite})
        for (const double other : {-1e155, -1e30, -infinite, -3.0})
            for (const double target : {0.0, 0.6, -0.8}) {
                INFO(other << " " << end << " " << target);
                const Found<double> found = flat(target, other, end);
                CHECK(found.status == Status::ok);
                CHECK(found.z == Approx(target / std::sqrt(1 - target * target)).margin(1e-30).epsilon(1e-13));
            }
    CHECK(flat(0.6F, -1e30F, 1e25F).z == Approx(0.75).epsilon(1e-5));
    CHECK(flat(2.0, -1.0, 1e150).z == 1e150); // F is positive up to the end
    CHECK(flat(-2.0, -1e150, 1e200).z == -1e150);
    CHECK(flat(2.0, -1.0, 1e200).status == Status::newton_diverged); // nothing is known of F there
    using Lanes = Pack<double, 4>;
    const Found<Lanes> lanes = flat(Lanes(std::array<double, 4>{0.6, -0.8, 2, 0}), Lanes(-1e160),
                                    Lanes(std::array<double, 4>{1e160, 10, 1e100, infinite}));
    CHECK(lanes.z.lanes[0] == Approx(0.75).epsilon(1e-13));
    CHECK(lanes.z.lanes[1] == Approx(-4.0 / 3).epsilon(1e-13));
    CHECK(lanes.z.lanes[2] == 1e100);
    CHECK(lanes.z.lanes[3] == 0);
    // log(cosh(u)), whose slope is inf/inf far away
    const Found<double> ratio = root_of(
        -1000.0, 2000.0, [](double u) { return 0.5 - std::sinh(u) / std::cosh(u); },
        [](double u) { return -1 / (std::cosh(u) * std::cosh(u)); });
    CHECK(ratio.z == Approx(std::atanh(0.5)).epsilon(1e-13));
    CHECK(root_of_exponential(1e300, 1e250, infinite).z == 1e250); // beyond the root
    CHECK(root_of_exponential(1e300, -1e250, infinite).z == Approx(std::log(1e300)).epsilon(1e-15));
}

TEST_CASE("ends that cross or are not numbers have a status", "[bracket]")
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [lower, upper] : {std::pair{1.0, -1.0}, {nan, 1.0}, {-1.0, nan}, {-infinite, nan}}) {
        const Found<double> found = root_of_tangent(0.5, lower, upper);
        CHECK(found.status == Status::newton_diverged);
        CHECK(std::isnan(found.z));
    }
    CHECK(root_of_tangent(0.5, 1, 1).z == 1);
}

TEST_CASE("lanes of a pack and other scalars find what double finds", "[bracket]")
{
    using Lanes = Pack<double, 4>;
    const std::array<double, 4> targets{-5, 0.25, 2, 40};
    const Lanes target(targets);
    const auto cubic = [](auto t, auto lower, auto upper) {
        using S = decltype(t);
        return root_of(
            lower, upper, [t](const S& u) { return t - u - u * u * u; },
            [](const S& u) { return S(-1) - S(3) * u * u; });
    };
    const Found<Lanes> lanes = cubic(target, Lanes(-1), Lanes(infinite));
    for (std::size_t k = 0; k < targets.size(); ++k) {
        INFO(targets[k]);
        const double one = cubic(targets[k], -1.0, infinite).z;
        CHECK(lanes.z.lanes[k] == Approx(one).epsilon(tolerance::roundoff(4)));
        CHECK((one == -1 || std::abs(one + one * one * one - targets[k]) <= tolerance::roundoff(16) * targets[k]));
        const float single = cubic(static_cast<float>(targets[k]), -1.0F, std::numeric_limits<float>::infinity()).z;
        CHECK(single == Approx(one).epsilon(1e-6));
        const long double large = cubic(static_cast<long double>(targets[k]), -1.0L, 100.0L).z;
        CHECK(static_cast<double>(large) == Approx(one).epsilon(tolerance::roundoff(4)));
    }
    CHECK(cubic(-5.0, -1.0, infinite).z == -1);
}
