// SPDX-License-Identifier: GPL-2.0-or-later
/// Eigenvalues of real matrices that are known beforehand.
#include "lagen_chart/spectrum.hpp"

#include <catch2/catch.hpp>

#include <random>

using lagen::chart::SquareMatrix;
using Numbers = std::vector<std::complex<double>>;

namespace {

/// By the real part, then the imaginary one; parts that are equal to rounding count as equal.
Numbers sorted(Numbers list)
{
    const auto rounded = [](double x) { return std::round(x * 1e6); };
    std::sort(list.begin(), list.end(), [&](const std::complex<double>& a, const std::complex<double>& b) {
        return std::pair(rounded(a.real()), a.imag()) < std::pair(rounded(b.real()), b.imag());
    });
    return list;
}

double distance(const Numbers& a, const Numbers& b)
{
    REQUIRE(a.size() == b.size());
    const Numbers one = sorted(a), other = sorted(b);
    double most = 0;
    for (std::size_t k = 0; k < one.size(); ++k) most = std::max(most, std::abs(one[k] - other[k]));
    return most;
}

/// A <- Q^T A Q with rotations Q by the same angle in the planes (i, j), i < j.
void turn(SquareMatrix& a, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    for (int i = 0; i < a.size(); ++i)
        for (int j = i + 1; j < a.size(); ++j) {
            for (int k = 0; k < a.size(); ++k) {
                const double x = a(i, k), y = a(j, k);
                a(i, k) = c * x + s * y;
                a(j, k) = c * y - s * x;
            }
            for (int k = 0; k < a.size(); ++k) {
                const double x = a(k, i), y = a(k, j);
                a(k, i) = c * x + s * y;
                a(k, j) = c * y - s * x;
            }
        }
}

} // namespace

TEST_CASE("eigenvalues of block-triangular matrices in turned axes are those of their blocks")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-2, 2);
    for (int trial = 0; trial < 300; ++trial) {
        const int size = 1 + trial % 12;
        SquareMatrix a(size);
        Numbers exact;
        for (int i = 0; i < size; ++i)
            for (int j = i; j < size; ++j) a(i, j) = number(random);
        for (int i = 0; i < size;) {
            const double re = number(random), im = number(random);
            a(i, i) = re;
            if (i + 1 < size && trial % 3 > 0) {
                a(i + 1, i + 1) = re;
                a(i, i + 1) = im * 1.5;
                a(i + 1, i) = -im / 1.5;
                exact.emplace_back(re, im);
                exact.emplace_back(re, -im);
                i += 2;
            } else {
                exact.emplace_back(re);
                ++i;
            }
        }
        turn(a, number(random));
        CAPTURE(trial);
        CHECK(distance(lagen::chart::eigenvalues(a), exact) < 2e-9); // some are nearly double
    }
}

TEST_CASE("eigenvalues of an oscillator, of a cyclic permutation and of zero; none where an entry is no number")
{
    SquareMatrix oscillator(2);
    oscillator(0, 1) = 1;
    oscillator(1, 0) = -9;
    CHECK(distance(lagen::chart::eigenvalues(oscillator), {{0, 3}, {0, -3}}) < 1e-15);
    SquareMatrix cycle(6); // its shifts are 0: only exceptional ones move it
    for (int i = 0; i < 6; ++i) cycle(i, (i + 1) % 6) = 1;
    Numbers roots;
    for (int k = 0; k < 6; ++k) roots.push_back(std::polar(1.0, k * std::acos(-1.0) / 3));
    CHECK(distance(lagen::chart::eigenvalues(cycle), roots) < 1e-14);
    CHECK(distance(lagen::chart::eigenvalues(SquareMatrix(4)), Numbers(4)) == 0);
    CHECK(lagen::chart::eigenvalues(SquareMatrix(0)).empty());
    oscillator(1, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(lagen::chart::eigenvalues(oscillator).empty());
}
