// SPDX-License-Identifier: GPL-2.0-or-later
/// PivotedLu: solutions, what counts as singular, and that units do not matter.
#include "lagen/linear.hpp"
#include "lagen/lanes/pack.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace lagen;

namespace {

template <int N>
using Entries = std::array<double, static_cast<std::size_t>(N) * static_cast<std::size_t>(N)>;

template <int N>
bool singular(const Entries<N>& a)
{
    PivotedLu<double, N> lu;
    return lu.factor(a);
}

/// rows[i] a(i, j) columns[j].
Entries<3> scaled(Entries<3> a, const std::array<double, 3>& rows, const std::array<double, 3>& columns)
{
    for (std::size_t k = 0; k < 9; ++k) a[k] *= rows[k / 3] * columns[k % 3];
    return a;
}

const Entries<3> cycle{1, 0, 1, 1, 1, 0, 0, 1, 1}; // determinant 2
const Entries<3> flat{1, 2, 3, 4, 5, 6, 7, 8, 9};  // rank 2
const Entries<3> indefinite{0, 1, 2, 1, 0, 3, 2, 3, 0};

} // namespace

TEST_CASE("Diagonal and scaled matrices are not singular, whatever their units; rank 2 is, in all units")
{
    CHECK_FALSE(singular<3>({1e-12, 0, 0, 0, 1, 0, 0, 0, 1e12}));
    CHECK_FALSE(singular<2>({1e-12, 0, 0, 1e12}));
    for (const double big : {1.0, 1e8, 1e20, 1e100}) {
        INFO("scale " << big);
        CHECK_FALSE(singular<3>(scaled(cycle, {1, 1, 1}, {1, 1, big})));
        CHECK_FALSE(singular<3>(scaled(cycle, {big, 1, 1 / big}, {1, 1 / big, big})));
        CHECK_FALSE(singular<3>(scaled(indefinite, {1 / big, 1, big}, {1 / big, 1, big})));
        CHECK(singular<3>(scaled(flat, {1, 1, 1}, {1, 1, big})));
        CHECK(singular<3>(scaled(flat, {1 / big, 1, big}, {1 / big, 1, big})));
    }
    CHECK(singular<3>({0, 0, 0, 0, 0, 0, 0, 0, 0}));
    CHECK(singular<3>({1, 2, 0, 2, 4, 0, 0, 0, 1}));
}

TEST_CASE("Solutions are right for matrices without a definite sign, and do not depend on units")
{
    PivotedLu<double, 3> lu;
    REQUIRE_FALSE(lu.factor(indefinite));
    const auto z = lu.solve({8, 10, 8}); // A (1, 2, 3) = (8, 10, 8)
    for (std::size_t k = 0; k < 3; ++k) CHECK_THAT(z[k], Catch::WithinAbs(1.0 + static_cast<double>(k), 1e-14));
    REQUIRE_FALSE(lu.factor(scaled(indefinite, {0x1p-60, 1, 0x1p60}, {0x1p-60, 1, 0x1p60})));
    const auto y = lu.solve({8 * 0x1p-60, 10, 8 * 0x1p60});
    CHECK_THAT(y[0] * 0x1p-60, Catch::WithinAbs(1, 1e-14));
    CHECK_THAT(y[1], Catch::WithinAbs(2, 1e-14));
    CHECK_THAT(y[2] * 0x1p60, Catch::WithinAbs(3, 1e-14));
}

TEST_CASE("Random regular matrices are never called singular; of singular ones at least 19 in 20 are")
{
    std::mt19937 generator(7);
    const auto number = [&] { return static_cast<double>(generator()) / 2147483648.0 - 1; };
    int recognised = 0;
    for (int round = 0; round < 1000; ++round) {
        std::array<double, 16> regular{}, low{};
        std::array<double, 12> left{}, right{};
        for (double& x : regular) x = number();
        for (double& x : left) x = number();
        for (double& x : right) x = number();
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                for (std::size_t k = 0; k < 3; ++k) low[4 * i + j] += left[3 * i + k] * right[4 * k + j];
        CHECK_FALSE(singular<4>(regular));
        recognised += singular<4>(low) ? 1 : 0;
    }
    CHECK(recognised > 950);
}

TEST_CASE("Lanes pivot on their own and only the singular ones are marked")
{
    using P = Pack<double, 2>;
    std::array<P, 9> a;
    for (std::size_t k = 0; k < 9; ++k) a[k] = P(std::array<double, 2>{indefinite[k], flat[k]});
    PivotedLu<P, 3> lu;
    const auto mask = lu.factor(a);
    CHECK_FALSE(mask[0]);
    CHECK(mask[1]);
    const auto z = lu.solve({P(8), P(10), P(8)});
    CHECK_THAT(z[2][0], Catch::WithinAbs(3, 1e-14));
}
