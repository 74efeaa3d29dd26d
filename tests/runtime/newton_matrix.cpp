// SPDX-License-Identifier: GPL-2.0-or-later
/// LU decompositions of real and complex matrices for Newton's method.
#include "lagen/integrate/newton_matrix.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <complex>
#include <random>

using lagen::detail::Complex;
using lagen::detail::MatrixLu;

namespace {

/// max |A x - b| relative to the sizes of A and x, for random A and x.
template <std::size_t n>
double real_residual(unsigned seed)
{
    std::mt19937 dice(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::array<std::array<double, n>, n> a;
    std::array<double, n> b;
    MatrixLu<double, n> lu;
    for (std::size_t i = 0; i < n; ++i) {
        b[i] = uniform(dice);
        for (std::size_t j = 0; j < n; ++j) lu(i, j) = a[i][j] = (i + j) % 3 == 0 ? 0 : uniform(dice);
    }
    if (n % 3 == 1) a[0][0] = lu(0, 0) = 1;
    REQUIRE(lu.factor());
    auto x = b;
    lu.solve(x);
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        double sum = -b[i], size = 0;
        for (std::size_t j = 0; j < n; ++j) {
            sum += a[i][j] * x[j];
            size += std::abs(x[j]);
        }
        worst = std::max(worst, std::abs(sum) / size);
    }
    return worst;
}

template <std::size_t n>
double complex_residual(unsigned seed)
{
    std::mt19937 dice(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::array<std::array<std::complex<double>, n>, n> a;
    std::array<Complex<double>, n> b;
    MatrixLu<Complex<double>, n> lu;
    for (std::size_t i = 0; i < n; ++i) {
        b[i] = {uniform(dice), uniform(dice)};
        for (std::size_t j = 0; j < n; ++j) {
            lu(i, j) = {i == j ? 0 : uniform(dice), i + 1 == j ? 0 : uniform(dice)};
            a[i][j] = {lu(i, j).re, lu(i, j).im};
        }
    }
    REQUIRE(lu.factor());
    auto x = b;
    lu.solve(x);
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        std::complex<double> sum(-b[i].re, -b[i].im);
        double size = 0;
        for (std::size_t j = 0; j < n; ++j) {
            sum += a[i][j] * std::complex<double>(x[j].re, x[j].im);
            size += std::abs(x[j].re) + std::abs(x[j].im);
        }
        worst = std::max(worst, std::abs(sum) / size);
    }
    return worst;
}

} // namespace

TEST_CASE("Real and complex systems are solved to rounding, on the stack and on the heap")
{
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CHECK(real_residual<1>(seed) < lagen::tolerance::roundoff(20));
        CHECK(real_residual<4>(seed) < lagen::tolerance::roundoff(20));
        CHECK(real_residual<13>(seed) < lagen::tolerance::roundoff(20));
        CHECK(real_residual<61>(seed) < lagen::tolerance::roundoff(200));
        CHECK(complex_residual<1>(seed) < lagen::tolerance::roundoff(20));
        CHECK(complex_residual<5>(seed) < lagen::tolerance::roundoff(20));
        CHECK(complex_residual<61>(seed) < lagen::tolerance::roundoff(200));
    }
}

TEST_CASE("A matrix that needs exchanges of rows is solved exactly, one without a pivot is refused")
{
    MatrixLu<double, 3> cyclic; // x -> (x_2, x_3, x_1)
    cyclic(0, 1) = cyclic(1, 2) = cyclic(2, 0) = 1;
    REQUIRE(cyclic.factor());
    std::array<double, 3> b{2, 3, 5};
    cyclic.solve(b);
    CHECK(b == std::array<double, 3>{5, 2, 3});
    MatrixLu<double, 2> singular;
    singular(0, 0) = singular(0, 1) = singular(1, 0) = singular(1, 1) = 3;
    CHECK_FALSE(singular.factor());
    MatrixLu<double, 2> wrong;
    wrong(0, 0) = wrong(1, 1) = std::nan("");
    CHECK_FALSE(wrong.factor());
    MatrixLu<Complex<double>, 2> rotated; // i and -i on the other diagonal
    rotated(0, 1) = {0, 1};
    rotated(1, 0) = {0, -1};
    REQUIRE(rotated.factor());
    std::array<Complex<double>, 2> c{{{1, 2}, {3, 4}}};
    rotated.solve(c);
    CHECK((c[0] == Complex<double>{-4, 3}));
    CHECK((c[1] == Complex<double>{2, -1}));
}
