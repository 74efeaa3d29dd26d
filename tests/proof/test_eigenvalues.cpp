// SPDX-License-Identifier: GPL-2.0-or-later
/// Multiplicities of eigenvalues: of tables with Jordan blocks that are known, in frames that hide them.
#include "proof/eigenvalues.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>

using namespace lagen;
using proof::Ball;
using proof::BallMatrix;
using proof::Eigenvalue;

namespace {

constexpr slong bits = 256;
constexpr double rounding = 0x1p-128;

using Table = std::vector<std::vector<Rational>>;
using Count = std::map<std::pair<double, double>, std::size_t>; // eigenvalues with multiplicities

BallMatrix balls(const Table& table)
{
    BallMatrix out(table.size(), table.size());
    for (std::size_t i = 0; i < table.size(); ++i)
        for (std::size_t j = 0; j < table.size(); ++j) out.at(i, j) = Ball(table[i][j], bits);
    return out;
}

Table zeros(std::size_t n)
{
    return Table(n, std::vector<Rational>(n));
}

std::size_t sum_of(const std::vector<Eigenvalue>& found)
{
    std::size_t sum = 0;
    for (const Eigenvalue& each : found) sum += each.multiplicity;
    return sum;
}

Count counted(const std::vector<Eigenvalue>& found)
{
    Count out;
    for (const Eigenvalue& each : found) out[{each.real, each.imaginary}] += each.multiplicity;
    return out;
}

/// A block of `size` with the eigenvalue a, or of twice the size with a +- i b, from row `at` on.
void put_block(Table& J, std::size_t at, std::size_t size, const Rational& a, const Rational& b)
{
    const std::size_t step = b == 0 ? 1 : 2;
    for (std::size_t k = 0; k < size * step; ++k) {
        J[at + k][at + k] = a;
        if (k + step < size * step) J[at + k][at + k + step] = 1;
    }
    for (std::size_t k = 0; step == 2 && k < size; ++k) {
        J[at + 2 * k][at + 2 * k + 1] = -b;
        J[at + 2 * k + 1][at + 2 * k] = b;
    }
}

/// A similar table: rows and columns are added to each other, as long as the numbers stay small.
Table turned(Table A, std::mt19937& random, int steps)
{
    const std::size_t n = A.size();
    for (int k = 0; k < steps; ++k) {
        const std::size_t i = random() % n, j = random() % n;
        const Rational c = static_cast<int>(random() % 5) - 2;
        if (i == j) continue;
        for (std::size_t l = 0; l < n; ++l) A[i][l] += c * A[j][l];
        for (std::size_t l = 0; l < n; ++l) A[l][j] -= c * A[l][i];
    }
    return A;
}

} // namespace

TEST_CASE("Jordan blocks in any frame are found with their multiplicities")
{
    std::mt19937 random(3);
    for (int trial = 0; trial < 60; ++trial) {
        Table J;
        Count known;
        while (J.size() < 4 + random() % 6) {
            const std::size_t size = 1 + random() % 5;
            const Rational a = Rational(static_cast<int>(random() % 9) - 4) / (trial % 3 == 0 ? 10 : 1);
            const Rational b = trial % 2 * static_cast<int>(random() % 3);
            const std::size_t rows = size * (b == 0 ? 1 : 2), at = J.size();
            J.resize(at + rows);
            for (auto& row : J) row.resize(at + rows);
            put_block(J, at, size, a, b);
            const double real = a.get_num().get_d() / a.get_den().get_d(); // get_d() does not round to nearest
            known[{real, b.get_d()}] += size;
            if (b != 0) known[{real, -b.get_d()}] += size;
        }
        const std::vector<Eigenvalue> found = proof::eigenvalues(balls(turned(J, random, 12)), bits, rounding);
        CHECK(sum_of(found) == J.size());
        CHECK(counted(found) == known);
    }
}

TEST_CASE("nilpotent tables have 0 alone, as often as they have rows")
{
    std::mt19937 random(5);
    for (std::size_t n = 1; n <= 14; ++n) {
        Table N = zeros(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) N[i][j] = Rational(static_cast<int>(random() % 199) - 99) / 7;
        for (const Table& table : {N, turned(N, random, 6)})
            CHECK(counted(proof::eigenvalues(balls(table), bits, rounding)) == Count{{{0.0, 0.0}, n}});
    }
}

TEST_CASE("multiplicities of any table add up to its rows, and what is not real comes in pairs")
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t n = 1 + random() % 9;
        Table A = zeros(n);
        for (auto& row : A)
            for (Rational& entry : row)
                if (random() % 3 != 0) {
                    entry = static_cast<int>(random() % 7) - 3;
                    if (trial % 4 == 1) entry /= 10;
                    if (trial % 4 == 2) entry *= random() % 2 == 0 ? Rational(1, 1000000000) : Rational(1000000);
                }
        if (trial % 4 == 3)
            for (std::size_t i = 0; i < n; ++i) A[i][n / 2] = A[i][0]; // singular
        for (const double known : {rounding, 0x1p-46}) {
            const std::vector<Eigenvalue> found = proof::eigenvalues(balls(A), bits, known);
            CHECK(sum_of(found) == n);
            const Count count = counted(found);
            for (const auto& [value, times] : count) {
                const auto conjugate = count.find({value.first, value.second == 0 ? 0 : -value.second});
                REQUIRE(conjugate != count.end());
                CHECK(conjugate->second == times);
            }
        }
    }
}

TEST_CASE("eigenvalues that lie close are two, slow ones beside fast ones too")
{
    Table A = zeros(4);
    A[0][0] = -100000000, A[0][1] = 1, A[1][0] = 3;
    A[1][1] = Rational(-1, 100), A[2][2] = Rational(-1, 50), A[2][3] = 1, A[3][2] = Rational(1, 1000000000000),
    A[3][3] = 0;
    const std::vector<Eigenvalue> found = proof::eigenvalues(balls(A), bits, rounding);
    REQUIRE(found.size() == 4);
    CHECK(found[0].real == Approx(-1e8));
    CHECK(found[2].real == Approx(-0.01 + 3e-8).epsilon(1e-12));
    CHECK(found[3].real == Approx(5e-11).epsilon(1e-8)); // 1e-12/(1/50)
}

TEST_CASE("where a table is known to few digits a cluster says how far its members lie apart")
{
    Table A = zeros(3);
    A[0][0] = A[1][1] = A[2][2] = -2, A[0][1] = A[1][2] = 1, A[2][0] = Rational(1, 1000000000000000);
    const std::vector<Eigenvalue> exact = proof::eigenvalues(balls(A), bits, rounding);
    CHECK(exact.size() == 3);
    const std::vector<Eigenvalue> rough = proof::eigenvalues(balls(A), bits, 1e-10);
    REQUIRE(rough.size() == 1);
    CHECK(rough[0].multiplicity == 3);
    CHECK(rough[0].real == -2);
    CHECK(rough[0].spread == Approx(1e-5).epsilon(1e-6));
}
