// SPDX-License-Identifier: GPL-2.0-or-later
#include <lagen/lanes/pack.hpp>
#include <lagen/roots.hpp>

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;

namespace {

/// Numbers of all sizes, with zeros, a subnormal number, infinity and a negative one in front.
template <class T, std::size_t K>
std::array<T, K> numbers(unsigned seed)
{
    constexpr std::array first{T(0), T(-0.0), std::numeric_limits<T>::denorm_min(), std::numeric_limits<T>::infinity(),
                               T(-2)};
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-30, 30);
    std::array<T, K> x;
    for (std::size_t k = 0; k < K; ++k)
        x[k] = seed == 0 && k < first.size() ? first[k] : static_cast<T>(std::exp(exponent(random)));
    return x;
}

template <class T>
bool same(T a, T b)
{
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

/// Are K roots and reciprocals those of the library and of the operator, one by one?
template <class T, std::size_t K>
bool agrees()
{
    for (unsigned seed = 0; seed < 200; ++seed) {
        const std::array<T, K> x = numbers<T, K>(seed);
        const std::array<T, K> roots = square_roots(x);
        const std::array<T, K> inverses = reciprocals(x);
        for (std::size_t k = 0; k < K; ++k)
            if (!same(roots[k], std::sqrt(x[k])) || !same(inverses[k], T(1) / x[k]) ||
                !same(arithmetic::sqrt(x[k]), std::sqrt(x[k])))
                return false;
    }
    return true;
}

/// A scalar with a square root of its own.
struct Marked {
    double value;
    Marked(double v) : value(v) {}
    friend Marked operator/(const Marked& a, const Marked& b) { return a.value - b.value; }
    friend Marked sqrt(const Marked& x) { return x.value + 1; }
};

} // namespace

TEST_CASE("square roots and reciprocals are those of the library bit for bit, alone and together", "[roots]")
{
    CHECK(agrees<double, 1>());
    CHECK(agrees<double, 4>());
    CHECK(agrees<double, 7>());
    CHECK(agrees<double, 21>());
    CHECK(agrees<float, 3>());
    CHECK(agrees<float, 8>());
    CHECK(agrees<float, 21>());
    CHECK(agrees<long double, 5>());
}

TEST_CASE("a negative number has no square root, and errno is not set", "[roots]")
{
    errno = 0;
    CHECK(std::isnan(arithmetic::sqrt(-1.0)));
    CHECK(std::isnan(arithmetic::sqrt(-1.0F)));
    CHECK(errno == 0);
    CHECK(std::signbit(arithmetic::sqrt(-0.0)));
}

TEST_CASE("the square root of a pack is that of its lanes", "[roots]")
{
    const std::array<double, 8> x = numbers<double, 8>(1);
    const Pack<double, 8> roots = sqrt(Pack<double, 8>(x));
    const auto several = square_roots<Pack<double, 8>, 2>({Pack<double, 8>(2.0), Pack<double, 8>(x)});
    for (int lane = 0; lane < 8; ++lane) {
        CHECK(roots[lane] == std::sqrt(x[static_cast<std::size_t>(lane)]));
        CHECK(several[1][lane] == roots[lane]);
        CHECK(several[0][lane] == std::sqrt(2.0));
    }
}

TEST_CASE("other scalars divide and take roots by themselves", "[roots]")
{
    CHECK(square_roots<Marked, 2>({Marked(3), Marked(5)})[1].value == 6);
    CHECK(reciprocals<Marked, 2>({Marked(3), Marked(5)})[0].value == -2);
}
