// SPDX-License-Identifier: GPL-2.0-or-later
#include <lagen/lanes/pack.hpp>
#include <lagen/sincos.hpp>
#include <lagen/single_sincos.hpp>

#include "../support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

using namespace lagen;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// |value - reference| in units of the last place of the reference, rounded to T.
template <class T>
double ulps(T value, long double reference)
{
    const int exponent = std::ilogb(static_cast<T>(reference));
    const long double unit = std::scalbn(1.0L, exponent - std::numeric_limits<T>::digits + 1);
    return static_cast<double>(std::fabs(static_cast<long double>(value) - reference) / unit);
}

/// The largest errors met so far.
template <class T>
struct Worst {
    double sine = 0;
    double cosine = 0;

    void meet(T x)
    {
        const auto [s, c] = sincos(x);
        sine = std::max(sine, ulps(s, std::sin(static_cast<long double>(x))));
        cosine = std::max(cosine, ulps(c, std::cos(static_cast<long double>(x))));
    }
};

bool same_bits(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::vector<double> random_angles(std::size_t count, double range)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> angle(-range, range);
    std::vector<double> angles(count);
    for (double& x : angles) x = angle(random);
    return angles;
}

/// Do K angles at once get the bits that each gets alone?
template <std::size_t K>
bool agrees_with_one()
{
    const std::vector<double> pool = random_angles(K * 500, 300);
    for (std::size_t start = 0; start < pool.size(); start += K) {
        std::array<double, K> x;
        std::copy_n(pool.begin() + static_cast<std::ptrdiff_t>(start), K, x.begin());
        if (start == 0) x[K / 2] = 1e9; // one of them beyond the reduction
        const auto [sines, cosines] = sincos<double, K>(x);
        for (std::size_t k = 0; k < K; ++k) {
            const auto [sine, cosine] = sincos(x[k]);
            if (!same_bits(sine, sines[k]) || !same_bits(cosine, cosines[k])) return false;
        }
    }
    return true;
}

/// A scalar with functions of its own.
struct Counted {
    double value;
};
Counted sin(const Counted& x)
{
    return {x.value + 1};
}
Counted cos(const Counted& x)
{
    return {x.value + 2};
}

} // namespace

TEST_CASE("sines and cosines of doubles are within 0.87 units of the last place", "[sincos]")
{
    static_assert(std::numeric_limits<long double>::digits >= 64, "the reference must be finer than double");
    for (const double range : {0.8, 4.0, 1000.0, 131072.0, 1e9}) {
        CAPTURE(range);
        Worst<double> worst;
        for (const double x : random_angles(200000, range)) worst.meet(x);
        CHECK(worst.sine < 0.87);
        CHECK(worst.cosine < 0.87);
        CHECK(worst.sine > 0.4); // the reference is not the function itself
        CHECK(worst.cosine > 0.4);
    }
}

TEST_CASE("next to multiples of a quarter turn sines and cosines keep all their digits", "[sincos]")
{
    Worst<double> worst;
    for (int n = 1; n < 90000; ++n) {
        const double x = static_cast<double>(n * (std::numbers::pi_v<long double> / 2));
        for (const double near : {std::nextafter(x, 0.0), x, std::nextafter(x, infinite)}) worst.meet(near);
    }
    CHECK(worst.sine < 0.87);
    CHECK(worst.cosine < 0.87);
    CHECK(sincos(0x1.921fb54442d18p+1).sine == 0x1.1a62633145c07p-53); // pi - its double
}

TEST_CASE("sines and cosines of floats are within 0.54 units of the last place", "[sincos]")
{
    for (const double range : {0.8, 100.0, 131072.0}) {
        Worst<float> worst;
        for (const double x : random_angles(200000, range)) worst.meet(static_cast<float>(x));
        CHECK(worst.sine < 0.54);
        CHECK(worst.cosine < 0.54);
        CHECK(worst.sine > 0.4);
        CHECK(worst.cosine > 0.4);
    }
}

TEST_CASE("an angle gets the same bits alone, among others and in a pack", "[sincos]")
{
    CHECK(agrees_with_one<2>());
    CHECK(agrees_with_one<3>());
    CHECK(agrees_with_one<4>());
    CHECK(agrees_with_one<5>());
    CHECK(agrees_with_one<8>());
    CHECK(agrees_with_one<13>());
    CHECK(agrees_with_one<32>());
    const std::vector<double> angles = random_angles(8, 50);
    std::array<double, 8> x;
    std::copy_n(angles.begin(), 8, x.begin());
    const auto [sines, cosines] = sincos(Pack<double, 8>(x));
    const auto [other_sines, other_cosines] = sincos<Pack<double, 8>, 2>({Pack<double, 8>(1.0), Pack<double, 8>(x)});
    for (int lane = 0; lane < 8; ++lane) {
        const auto [sine, cosine] = sincos(x[static_cast<std::size_t>(lane)]);
        CHECK(same_bits(sines[lane], sine));
        CHECK(same_bits(cosines[lane], cosine));
        CHECK(same_bits(other_sines[1][lane], sine));
        CHECK(same_bits(other_cosines[1][lane], cosine));
        CHECK(same_bits(other_cosines[0][lane], sincos(1.0).cosine));
    }
}

TEST_CASE("the sine is odd and the cosine even, bit for bit, and their squares add up to one", "[sincos]")
{
    bool symmetric = true;
    double largest = 0;
    for (const double x : random_angles(100000, 1e5)) {
        const auto [sine, cosine] = sincos(x);
        const auto [other_sine, other_cosine] = sincos(-x);
        symmetric = symmetric && same_bits(sine, -other_sine) && same_bits(cosine, other_cosine);
        largest = std::max(largest, std::fabs(sine * sine + cosine * cosine - 1));
    }
    CHECK(symmetric);
    CHECK(largest <= tolerance::roundoff(2));
    CHECK(largest > 0);
}

TEST_CASE("zeros keep their sign, subnormal numbers their value, and infinity has no sine", "[sincos]")
{
    CHECK(same_bits(sincos(0.0).sine, 0.0));
    CHECK(same_bits(sincos(-0.0).sine, -0.0));
    CHECK(sincos(-0.0).cosine == 1);
    for (const double tiny : {5e-324, 1e-310, 2.3e-308, 1e-9}) {
        CHECK(sincos(tiny).sine == tiny);
        CHECK(sincos(-tiny).sine == -tiny);
        CHECK(sincos(tiny).cosine == 1);
    }
    const auto [sines, cosines] = sincos<double, 5>({infinite, 1.0, -infinite, not_a_number, 1e300});
    for (const std::size_t k : {0U, 2U, 3U}) {
        CHECK(std::isnan(sines[k]));
        CHECK(std::isnan(cosines[k]));
    }
    CHECK(same_bits(sines[1], sincos(1.0).sine));
    CHECK(same_bits(sines[4], std::sin(1e300)));
    CHECK(same_bits(cosines[4], std::cos(1e300)));
}

TEST_CASE("other scalars use functions of their own", "[sincos]")
{
    const auto [sine, cosine] = sincos(1.25L);
    CHECK(sine == std::sin(1.25L));
    CHECK(cosine == std::cos(1.25L));
    const auto [sines, cosines] = sincos<Counted, 2>({Counted{3}, Counted{5}});
    CHECK(sines[1].value == 6);
    CHECK(cosines[0].value == 5);
    CHECK(sincos(Counted{1}).sine.value == 2);
}

TEST_CASE("Sine and cosine in whole numbers are within 0.54 ulp for every float")
{
    const auto ulps = [](float found, double exact) {
        int exponent = 0;
        (void)std::frexp(exact, &exponent);
        return std::abs(static_cast<double>(found) - exact) / std::ldexp(1.0, std::max(exponent, -125) - 24);
    };
    double worst = 0;
    for (std::uint32_t bits = 0; bits < 0x7f800000U; bits += 40961) {
        const auto x = std::bit_cast<float>(bits);
        const detail::SingleSinCos both = detail::single_sincos(x), opposite = detail::single_sincos(-x);
        worst = std::max({worst, ulps(both.sine, std::sin(double(x))), ulps(both.cosine, std::cos(double(x)))});
        CHECK((opposite.sine == -both.sine && opposite.cosine == both.cosine));
    }
    CHECK(worst < 0.54);
    CHECK(worst > 0.5);
    CHECK(std::signbit(detail::single_sincos(-0.0F).sine));
    CHECK(std::isnan(detail::single_sincos(std::numeric_limits<float>::infinity()).sine));
    CHECK(std::isnan(detail::single_sincos(std::nanf("")).cosine));
}
