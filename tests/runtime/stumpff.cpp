// SPDX-License-Identifier: GPL-2.0-or-later
/// The Stumpff functions of the runtime against their series in a hundred digits.
#include "lagen/stumpff.hpp"
#include "lagen/lagen.hpp"
#include "support/tolerances.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace lagen;

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// A hundred digits, less fourteen that the largest terms are above the first.
Wide series(int k, const Wide& z)
{
    Wide term = 1;
    for (int i = 2; i <= k; ++i) term /= i;
    const Wide last = term * Wide("1e-85");
    Wide sum = term;
    for (int n = k; abs(term) > last; n += 2) {
        term *= -z / ((n + 1) * (n + 2));
        sum += term;
    }
    return sum;
}

/// Between -100 and 1000, near 0 on both sides down to the subnormal numbers, and at the changes of method.
template <class S>
std::vector<S> arguments()
{
    std::vector<S> z{0, std::numeric_limits<S>::denorm_min(), -std::numeric_limits<S>::denorm_min(),
                     std::numeric_limits<S>::min()};
    for (int e = 1; e < 100; e += 7)
        for (const S sign : {S(-1), S(1)}) z.push_back(sign * std::ldexp(S(1.37L), -e));
    for (int i = 0; i <= 220; ++i) z.push_back(S(-100) + 5 * S(i) + S(i) / 977);
    for (int k = 1; k <= 32; ++k)
        for (const S shift : {S(-1e-3L), S(0), S(1e-3L)}) {
            const auto radius = static_cast<S>(k < 2 ? 1 : k * (k - 1));
            z.push_back(radius + shift);
            if (radius <= 100) z.push_back(-radius + shift);
        }
    // (m pi)^2: double zeros of c_2, simple ones of c_0 and c_1.
    for (int m = 1; m <= 20; ++m) z.push_back(static_cast<S>(std::pow(1.570796326794896619231L * m, 2.0L)));
    return z;
}

/// The error in units of epsilon (|c_k| + |z c_k'|): what half a unit of z would do counts as the size of the value.
template <class S>
S error(int k, const S& z, const S& value)
{
    const Wide exact = series(k, z);
    const Wide slope = (k * series(k + 2, z) - series(k + 1, z)) / 2;
    const Wide scale =
        (k < 2 ? Wide(abs(exact) + abs(z * slope)) : Wide(abs(exact))) * Wide(std::numeric_limits<S>::epsilon());
    return static_cast<S>(abs(Wide(value) - exact) / scale);
}

template <class S, int k>
S worst_single()
{
    S worst = 0;
    for (const S z : arguments<S>()) {
        const S e = error(k, z, stumpff<k>(z));
        worst = e <= worst ? worst : e; // a value that is not a number counts
    }
    return worst;
}

template <class S, int... k>
std::vector<S> worst_of(std::integer_sequence<int, k...>)
{
    return {worst_single<S, k>()...};
}

template <class S>
S largest(const std::vector<S>& values)
{
    return *std::max_element(values.begin(), values.end());
}

} // namespace

// The largest errors measured on these arguments: 3 (double), 4 (float), 3.4 (long double).
TEST_CASE("Stumpff functions of double, float and long double are good to a few units in the last place")
{
    const auto some = std::integer_sequence<int, 0, 1, 2, 3, 4, 5, 8, 13, 32>{};
    CHECK(largest(worst_of<double>(some)) < 4.0);
    CHECK(largest(worst_of<long double>(some)) < 4.5L);
    CHECK(largest(worst_of<float>(some)) < 5.0F);
    CHECK(largest(worst_of<double>(std::integer_sequence<int, 48, 64>{})) < 4.0);
}

TEST_CASE("the orders of one argument together are as good as each alone")
{
    double worst = 0;
    for (const double z : arguments<double>()) {
        const auto low = stumpff_orders<0, 7>(z);
        for (int k = 0; k < 8; ++k) worst = std::max(worst, error(k, z, low[static_cast<std::size_t>(k)]));
        const auto high = stumpff_orders<3, 4>(z);
        CHECK(high[0] == Approx(low[3]).epsilon(tolerance::roundoff(8)));
        worst = std::max(worst, error(4, z, high[1]));
    }
    CHECK(worst > 0);
    CHECK(worst < 4);
}

TEST_CASE("Stumpff functions at 0, beyond the range and of no number are what they must be")
{
    CHECK(stumpff<0>(0.0) == 1);
    CHECK(stumpff<3>(0.0) == 1.0 / 6);
    CHECK(stumpff<4>(5e-324) == 1.0 / 24);
    CHECK(stumpff<2>(-1e7) == std::numeric_limits<double>::infinity());
    CHECK(std::isnan(stumpff<1>(std::numeric_limits<double>::quiet_NaN())));
    CHECK(stumpff_orders<2, 5>(0.0)[3] == 1.0 / 120);
    static_assert(noexcept(stumpff<2>(1.0)));
}

TEST_CASE("a pack of Stumpff functions is that of its lanes, small, large and mixed")
{
    using P = Pack<double, 4>;
    using F = Pack<float, 4>;
    for (const auto& z : {std::array<double, 4>{0, 0.25, -0.75, 1}, std::array<double, 4>{-90, 12, 1e-300, 700}}) {
        const P one = stumpff<2>(P(z));
        const auto many = stumpff_orders<1, 4>(P(z));
        for (int lane = 0; lane < 4; ++lane) {
            const double x = z[static_cast<std::size_t>(lane)];
            CHECK(one[lane] == stumpff<2>(x));
            for (std::size_t k = 0; k < 4; ++k)
                CHECK(many[k][lane] == Approx(stumpff_orders<1, 4>(x)[k]).epsilon(tolerance::roundoff(4)));
            CHECK(stumpff<20>(F(static_cast<float>(x)))[lane] == stumpff<20>(static_cast<float>(x)));
        }
    }
}

TEST_CASE("a multiprecision scalar gets Stumpff functions of its own precision")
{
    using Fifty = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>>;
    for (const char* text : {"-30.5", "-0.001", "1e-40", "0.7", "11", "950.25"}) {
        const Fifty z(text);
        const auto off = [](int k, const Fifty& argument, const Fifty& value) {
            const Wide exact = series(k, Wide(argument));
            return static_cast<double>(abs(Wide(value) / exact - 1));
        };
        CHECK(off(3, z, stumpff<3>(z)) < 1e-48);
        CHECK(off(1, z, stumpff_orders<1, 4>(z)[0]) < 1e-47);
        CHECK(off(4, z, stumpff_orders<1, 4>(z)[3]) < 1e-48);
    }
}
