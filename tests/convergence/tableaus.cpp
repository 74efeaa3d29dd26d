// SPDX-License-Identifier: GPL-2.0-or-later
/// Order conditions of the tableaus: in rational arithmetic where they are rational, else to the digits they are
/// published to.
#include "lagen/integrate.hpp"
#include "support/rooted_trees.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>

using boost::multiprecision::cpp_rational;
using lagen::Decimal;
using lagen::Fraction;
using lagen::support::worst_residual;
namespace tableau = lagen::tableau;

namespace {

cpp_rational number(const Fraction& f)
{
    return cpp_rational(f.numerator, f.denominator);
}
long double number(const Decimal& d)
{
    return d.value;
}

template <class Array>
auto numbers(const Array& values)
{
    std::vector<decltype(number(Fraction{}))> none;
    std::vector<decltype(number(typename Array::value_type{}))> list;
    for (const auto& value : values) list.push_back(number(value));
    return list;
}

/// Conditions up to the order hold exactly, one of the next order does not; row sums are the nodes.
template <class Tableau>
void check_rational()
{
    const auto a = numbers(Tableau::a);
    const auto b = numbers(Tableau::b);
    constexpr auto order = static_cast<std::size_t>(Tableau::order);
    CHECK(worst_residual(a, b, 1, order) == 0);
    CHECK(worst_residual(a, b, order + 1, order + 1) > cpp_rational(1, 100000));
    for (std::size_t i = 0; i < Tableau::stages; ++i) {
        cpp_rational sum = 0;
        for (std::size_t j = 0; j < i; ++j) sum += a[i * (i - 1) / 2 + j];
        CHECK(sum == number(Tableau::c[i]));
    }
}

template <class Tableau>
long double worst_row_sum()
{
    long double worst = 0;
    for (std::size_t i = 1; i < Tableau::stages; ++i) {
        long double sum = -number(Tableau::c[i]);
        for (std::size_t j = 0; j < i; ++j) sum += number(Tableau::a[i * (i - 1) / 2 + j]);
        worst = std::max(worst, std::abs(sum));
    }
    return worst;
}

std::vector<long double> weights_853()
{
    const auto a = numbers(tableau::Dop853::a);
    return {a.begin() + 66, a.begin() + 78};
}

/// b minus an error row.
template <class Row>
std::vector<long double> embedded_853(const Row& error)
{
    auto weights = weights_853();
    for (std::size_t i = 0; i < error.size(); ++i) weights[i] -= number(error[i]);
    return weights;
}

template <std::size_t... i>
std::vector<long double> interpolated_tsit5(long double theta, std::index_sequence<i...>)
{
    return {lagen::detail::interpolant_weight<tableau::Tsit5, i>(theta)...};
}

/// The weights of Hairer's nested form (dop853.hpp), of the 16 stages.
std::vector<long double> interpolated_853(long double theta)
{
    auto b = weights_853();
    b.resize(16);
    std::vector<long double> weights(16);
    const long double rest = 1 - theta;
    for (std::size_t i = 0; i < 16; ++i) {
        const long double first = i == 0 ? 1 : 0, last = i == 12 ? 1 : 0, bend = first - b[i];
        const auto of = [&](const auto& row) { return i < row.size() ? number(row[i]) : 0; };
        long double sum = rest * (of(tableau::Dop853::dense6) + theta * of(tableau::Dop853::dense7));
        sum = rest * (of(tableau::Dop853::dense4) + theta * (of(tableau::Dop853::dense5) + sum));
        weights[i] = theta * (b[i] + rest * (bend + theta * (b[i] - last - bend + sum)));
    }
    return weights;
}

} // namespace

TEST_CASE("There are 1, 1, 2, 4, 9, 20, 48, 115 rooted trees of 1 to 8 vertices")
{
    std::array<int, 9> count{};
    for (const auto& tree : lagen::support::rooted_trees(8)) ++count[tree.order];
    CHECK(count == std::array<int, 9>{0, 1, 1, 2, 4, 9, 20, 48, 115});
}

TEST_CASE("The fixed-step tableaus satisfy exactly the order conditions of their order")
{
    check_rational<tableau::Euler>();
    check_rational<tableau::Midpoint>();
    check_rational<tableau::Heun>();
    check_rational<tableau::Ralston>();
    check_rational<tableau::Kutta3>();
    check_rational<tableau::Rk4>();
    check_rational<tableau::Rk38>();
}

TEST_CASE("Dormand-Prince 5(4) has order 5 exactly, its embedded formula and its dense output order 4")
{
    check_rational<tableau::Dopri5>();
    const auto a = numbers(tableau::Dopri5::a);
    auto embedded = numbers(tableau::Dopri5::b);
    const auto error = numbers(tableau::Dopri5::error);
    for (std::size_t i = 0; i < embedded.size(); ++i) embedded[i] -= error[i];
    CHECK(worst_residual(a, embedded, 1, 4) == 0);
    CHECK(worst_residual(a, embedded, 5, 5) > 0);
    CHECK(numbers(tableau::Dopri5::b)[2] == cpp_rational(500, 1113));
    for (int k = 1; k <= 8; ++k) {
        const long double theta = static_cast<long double>(k) / 8;
        std::array<long double, 7> w{};
        tableau::Dopri5::dense(theta, w);
        std::vector<long double> al;
        for (const Fraction& f : tableau::Dopri5::a) al.push_back(f.as<long double>());
        CHECK(worst_residual(al, {w.begin(), w.end()}, 1, 4, theta) < 1e-17L);
    }
}

TEST_CASE("Tsitouras 5(4) has order 5, its embedded formula and its free interpolant order 4")
{
    const auto a = numbers(tableau::Tsit5::a);
    const auto b = numbers(tableau::Tsit5::b);
    CHECK(worst_residual(a, b, 1, 5) < 1e-17L);
    CHECK(worst_residual(a, b, 6, 6) > 1e-5L);
    CHECK(worst_row_sum<tableau::Tsit5>() < 1e-17L);
    auto embedded = b;
    for (std::size_t i = 0; i < b.size(); ++i) embedded[i] += number(tableau::Tsit5::error[i]);
    CHECK(worst_residual(a, embedded, 1, 4) < 1e-17L);
    CHECK(worst_residual(a, embedded, 5, 5) > 1e-6L);
    for (int k = 1; k <= 8; ++k) {
        const long double theta = static_cast<long double>(k) / 8;
        CHECK(worst_residual(a, interpolated_tsit5(theta, std::make_index_sequence<7>{}), 1, 4, theta) < 3e-16L);
    }
}

TEST_CASE(
    "DOP853 satisfies all 200 order conditions up to order 8, its embedded formulas those of order 5 and 3, its dense "
    "output those of order 7")
{
    const auto a = numbers(tableau::Dop853::a);
    CHECK(worst_residual(a, weights_853(), 1, 8) < 1e-16L);
    CHECK(worst_residual(a, weights_853(), 9, 9) > 1e-7L);
    CHECK(worst_row_sum<tableau::Dop853>() < 1e-17L);
    CHECK(worst_residual(a, embedded_853(tableau::Dop853::error5), 1, 5) < 1e-16L);
    CHECK(worst_residual(a, embedded_853(tableau::Dop853::error5), 6, 6) > 1e-6L);
    CHECK(worst_residual(a, embedded_853(tableau::Dop853::error3), 1, 3) < 1e-16L);
    CHECK(worst_residual(a, embedded_853(tableau::Dop853::error3), 4, 4) > 1e-4L);
    for (int k = 1; k <= 8; ++k) {
        const long double theta = static_cast<long double>(k) / 8;
        CHECK(worst_residual(a, interpolated_853(theta), 1, 7, theta) < 1e-16L);
    }
    CHECK(worst_residual(a, interpolated_853(0.5L), 8, 8, 0.5L) > 1e-7L);
    const long double root = std::sqrt(6.0L);
    CHECK(std::abs(number(tableau::Dop853::c[1]) - (12 - 2 * root) / 135) < 1e-19L);
    CHECK(std::abs(number(tableau::Dop853::c[4]) - (6 + root) / 30) < 1e-19L);
}
