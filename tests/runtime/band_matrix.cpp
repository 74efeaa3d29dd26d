// SPDX-License-Identifier: GPL-2.0-or-later
/// Matrices with a band: the order that the pattern of a Jacobian gives, decompositions inside it, and implicit methods
/// that use them.
#include "lagen/integrate/band_matrix.hpp"
#include "lagen/integrate.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <random>

using lagen::detail::band_order;
using lagen::detail::BandLu;
using lagen::detail::Complex;
using lagen::detail::is_narrow;
using lagen::detail::KnownBand;

namespace {

/// n masses on a line between walls, springs of force d + d^3 between neighbours: (x, v) with x' = v.
template <int n>
struct Lattice {
    using Scalar = double;
    static constexpr int dimension = 2 * n;
    using State = Eigen::Matrix<double, dimension, 1>;
    static constexpr std::size_t entries = 4 * n - 2;
    static constexpr auto pattern = [] {
        std::array<std::array<int, entries>, 2> found{};
        std::size_t k = 0;
        for (int i = 0; i < n; ++i) found[0][k] = i, found[1][k++] = n + i;
        for (int i = 0; i < n; ++i)
            for (int j = std::max(i - 1, 0); j <= std::min(i + 1, n - 1); ++j) found[0][k] = n + i, found[1][k++] = j;
        return found;
    }();
    static constexpr auto jacobian_rows = pattern[0], jacobian_columns = pattern[1];

    static double stretch(const State& s, int i) noexcept { return (i < n ? s[i] : 0) - (i > 0 ? s[i - 1] : 0); }
    static double slope(const State& s, int i) noexcept { return 1 + 3 * stretch(s, i) * stretch(s, i); }

    lagen::Status rhs(double, const State& s, State& rate) const noexcept
    {
        const auto force = [&](int i) { return stretch(s, i) + stretch(s, i) * stretch(s, i) * stretch(s, i); };
        for (int i = 0; i < n; ++i) {
            rate[i] = s[n + i];
            rate[n + i] = force(i + 1) - force(i);
        }
        return lagen::Status::ok;
    }
    void jacobian_values(double, const State& s, std::array<double, entries>& values) const noexcept
    {
        std::size_t k = 0;
        for (int i = 0; i < n; ++i) values[k++] = 1;
        for (int i = 0; i < n; ++i) {
            if (i > 0) values[k++] = slope(s, i);
            values[k++] = -slope(s, i) - slope(s, i + 1);
            if (i + 1 < n) values[k++] = slope(s, i + 1);
        }
    }
    static State start()
    {
        State s;
        for (int i = 0; i < n; ++i) s[i] = std::sin(3.0 * (i + 1) / (n + 1)), s[n + i] = 0.3 * std::cos(5.0 * i);
        return s;
    }
};

/// The same with every entry of the matrix in its pattern.
template <class M>
struct Full : M {
    static constexpr auto n = static_cast<std::size_t>(M::dimension);
    static constexpr auto index(bool row)
    {
        std::array<int, n * n> list{};
        for (std::size_t k = 0; k < n * n; ++k) list[k] = static_cast<int>(row ? k / n : k % n);
        return list;
    }
    static constexpr auto jacobian_rows = index(true), jacobian_columns = index(false);
    void jacobian_values(double t, const typename M::State& s, std::array<double, n * n>& values) const noexcept
    {
        std::array<double, M::entries> few;
        M::jacobian_values(t, s, few);
        values.fill(0);
        for (std::size_t k = 0; k < few.size(); ++k)
            values[static_cast<std::size_t>(M::jacobian_rows[k]) * n +
                   static_cast<std::size_t>(M::jacobian_columns[k])] = few[k];
    }
};

template <class M>
constexpr auto order_of = band_order<static_cast<std::size_t>(M::dimension)>(M::jacobian_rows, M::jacobian_columns);

template <class M, class Method>
void compare(const Method& method)
{
    const auto narrow = lagen::integrate(M{}, M::start(), {0.0, 3.0}, method);
    const auto full = lagen::integrate(Full<M>{}, M::start(), {0.0, 3.0}, method);
    REQUIRE(narrow);
    CHECK(narrow.steps == full.steps);
    CHECK(narrow.decompositions == full.decompositions);
    CHECK((narrow.state - full.state).norm() < lagen::tolerance::roundoff(1000) * full.state.norm());
    CHECK((narrow.state - M::start()).norm() > 1);
}

/// max |A x - b| relative to x for random entries on a pattern, with zeros on the diagonal.
template <class M, class Entry, class Draw>
double residual(const Draw& draw)
{
    constexpr auto n = static_cast<std::size_t>(M::dimension);
    static constexpr auto band = order_of<M>;
    BandLu<Entry, KnownBand<band>> lu;
    std::array<Entry, n> b, sums{};
    std::array<Entry, M::entries> values;
    for (Entry& entry : b) entry = draw();
    for (std::size_t k = 0; k < M::entries; ++k) {
        values[k] = draw();
        lu(static_cast<std::size_t>(M::jacobian_rows[k]), static_cast<std::size_t>(M::jacobian_columns[k])) = values[k];
    }
    REQUIRE(lu.factor());
    auto x = b;
    lu.solve(x);
    for (std::size_t k = 0; k < M::entries; ++k) {
        Entry& sum = sums[static_cast<std::size_t>(M::jacobian_rows[k])];
        sum = sum + values[k] * x[static_cast<std::size_t>(M::jacobian_columns[k])];
    }
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < n; ++i) {
        worst = std::max(worst, lagen::detail::magnitude(Entry(sums[i] - b[i])));
        size = std::max(size, lagen::detail::magnitude(x[i]));
    }
    return worst / size;
}

} // namespace

TEST_CASE("The order of a lattice sets positions beside velocities, and that of a full matrix has no narrow band")
{
    CHECK(order_of<Lattice<64>>.width <= 3);
    CHECK(is_narrow(order_of<Lattice<64>>));
    CHECK(is_narrow(order_of<Lattice<16>>));
    CHECK_FALSE(is_narrow(order_of<Lattice<2>>));
    CHECK(order_of<Full<Lattice<4>>>.width == 7);
    CHECK(order_of<Full<Lattice<8>>>.width == 16); // not looked for
    CHECK_FALSE(is_narrow(order_of<Full<Lattice<8>>>));
    auto places = order_of<Lattice<64>>.place;
    std::ranges::sort(places);
    for (std::size_t i = 0; i < places.size(); ++i) CHECK(places[i] == i);
    // Parts that nothing joins, one of them a ring that is numbered across.
    constexpr auto apart = band_order<8>(std::array{0, 4, 2, 6, 1, 3}, std::array{4, 2, 6, 0, 3, 5});
    CHECK(apart.width == 2);
}

TEST_CASE("An unknown with many neighbours has no band, and does not tire the compiler")
{
    // The first unknown is joined to 750 others, of which 250 have an entry on the diagonal.
    constexpr std::size_t n = 751, entries = 1000;
    constexpr auto ends = [] {
        std::array<std::array<int, entries>, 2> result{};
        for (std::size_t k = 0; k < n - 1; ++k) result[1][k] = static_cast<int>(k + 1);
        for (std::size_t k = n - 1; k < entries; ++k) result[0][k] = result[1][k] = static_cast<int>(k - n + 2);
        return result;
    }();
    constexpr auto band = lagen::detail::band_order<n>(ends[0], ends[1]);
    CHECK(band.width == n);
    CHECK_FALSE(lagen::detail::is_narrow(band));
}

TEST_CASE("Systems with a band are solved to rounding with exchanges of rows, on the stack and on the heap")
{
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
        const auto real = [&] { return uniform(dice); };
        const auto complex = [&] { return Complex<double>{uniform(dice), uniform(dice)}; };
        CHECK(residual<Lattice<5>, double>(real) < lagen::tolerance::roundoff(100));
        CHECK(residual<Lattice<64>, double>(real) < lagen::tolerance::roundoff(1000));
        CHECK(residual<Lattice<200>, Complex<double>>(complex) < lagen::tolerance::roundoff(1000));
    }
    static constexpr auto diagonal = band_order<3>(std::array{0, 1, 2}, std::array{0, 1, 2});
    BandLu<double, KnownBand<diagonal>> singular;
    singular(0, 0) = singular(2, 2) = 1;
    CHECK_FALSE(singular.factor());
    singular(1, 1) = std::nan("");
    CHECK_FALSE(singular.factor());
}

TEST_CASE("Implicit methods take the same steps with a matrix in its band as with a full one")
{
    compare<Lattice<16>>(lagen::Gauss4{.step = 0.1});
    compare<Lattice<16>>(lagen::Gauss8{.step = 0.1});
    compare<Lattice<16>>(lagen::Radau5Fixed{.step = 0.1});
    compare<Lattice<16>>(lagen::Radau5{.tolerance = 1e-6});
}
