// SPDX-License-Identifier: GPL-2.0-or-later
/// One linear algebra over several fields and rings: determinants by both expansions against the pivots of a
/// factorisation, solutions put in again, and the blocks of a matrix.
#include "expression/linear_algebra.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;

namespace {

struct RationalRing {
    using Number = Rational;
    const std::vector<Rational>& matrix;
    std::size_t n;

    [[nodiscard]] Rational zero() const { return 0; }
    [[nodiscard]] Rational one() const { return 1; }
    [[nodiscard]] const Rational& entry(std::size_t i, std::size_t j) const { return matrix[i * n + j]; }
    [[nodiscard]] bool is_zero(const Rational& a) const { return sgn(a) == 0; }
    [[nodiscard]] Rational times(const Rational& a, const Rational& b) const { return a * b; }
    void add(Rational& sum, const Rational& term, int sign) const { sum += sign * term; }
};

/// Small integers, a third of them 0.
std::vector<Rational> random_entries(std::mt19937& random, std::size_t count)
{
    std::vector<Rational> entries;
    for (std::size_t k = 0; k < count; ++k) {
        const long value = static_cast<long>(random() % 9) - 4;
        entries.emplace_back(random() % 3 == 0 ? 0 : value);
    }
    return entries;
}

/// The product of the pivots, with the sign of the row exchanges; 0 where there is no pivot.
Rational pivot_product(const Factorisation<Rational>& f, std::size_t n)
{
    if (!f.regular) return 0;
    Rational product = 1;
    for (std::size_t i = 0; i < n; ++i) product *= f.lu[i * n + i];
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (f.order[j] > f.order[i]) product = -product;
    return product;
}

} // namespace

TEST_CASE("a determinant by minors is the product of the pivots, along the first row and along the last")
{
    std::mt19937 random(7);
    std::size_t singular = 0;
    for (std::size_t n = 1; n <= 6; ++n)
        for (int k = 0; k < 20; ++k) {
            const std::vector<Rational> matrix = random_entries(random, n * n);
            const Rational expected = pivot_product(factorise(matrix, n), n);
            CHECK(determinant(RationalRing{matrix, n}, n) == expected);
            CHECK(determinant(RationalRing{matrix, n}, n, ExpandBy::last_row) == expected);
            singular += expected == 0 ? 1 : 0;
        }
    CHECK(singular >= 10);
    CHECK(singular <= 80);
    CHECK(determinant(RationalRing{{}, 0}, 0) == 1);
}

TEST_CASE("a solution satisfies its equations, exactly over the rationals and to rounding in floating point")
{
    std::mt19937 random(11);
    std::size_t solved = 0;
    for (std::size_t n = 1; n <= 6; ++n)
        for (int k = 0; k < 20; ++k) {
            const std::vector<Rational> A = random_entries(random, n * n);
            const std::vector<Rational> b = random_entries(random, n);
            const std::vector<Rational> z = substitute(factorise(A, n), b);
            std::vector<double> rounded_A, rounded_b;
            for (const Rational& entry : A) rounded_A.push_back(entry.get_d());
            for (const Rational& entry : b) rounded_b.push_back(entry.get_d());
            const std::vector<double> x = substitute(factorise(rounded_A, n), rounded_b);
            if (z.empty()) continue;
            ++solved;
            for (std::size_t i = 0; i < n; ++i) {
                Rational left = 0;
                for (std::size_t j = 0; j < n; ++j) left += A[i * n + j] * z[j];
                CHECK(left == b[i]);
                CHECK(x[i] == Approx(z[i].get_d()).margin(tolerance::roundoff(1e6)));
            }
        }
    CHECK(solved >= 50);
}

TEST_CASE("a singular system has no solution: none over the rationals, not a number in floating point")
{
    CHECK(substitute(factorise(std::vector<Rational>{1, 2, 2, 4}, 2), std::vector<Rational>{1, 1}).empty());
    for (const double x : substitute(factorise(std::vector<double>{1, 2, 2, 4}, 2), std::vector<double>{1, 1}))
        CHECK(std::isnan(x));
}

TEST_CASE("blocks are the rows and columns that entries connect, by their first rows")
{
    // Row 0 meets column 2, rows 1 and 2 meet columns 0 and 1.
    const bool entries[3][3] = {{false, false, true}, {true, true, false}, {false, true, false}};
    const auto blocks = coupled_blocks(3, [&](std::size_t i, std::size_t j) { return !entries[i][j]; });
    REQUIRE(blocks.size() == 2);
    CHECK(blocks[0].rows == std::vector<std::size_t>{0});
    CHECK(blocks[0].columns == std::vector<std::size_t>{2});
    CHECK(blocks[1].rows == std::vector<std::size_t>{1, 2});
    CHECK(blocks[1].columns == std::vector<std::size_t>{0, 1});
    // As a matrix of couplings all three unknowns hang together: 0 with 2 and 1, 1 with 2.
    CHECK(connected_classes(3, [&](std::size_t i, std::size_t j) { return entries[i][j]; }).size() == 1);
    const auto apart = connected_classes(4, [](std::size_t i, std::size_t j) { return i == 3 && j == 1; });
    CHECK(apart == std::vector<std::vector<std::size_t>>{{0}, {1, 3}, {2}});
}
