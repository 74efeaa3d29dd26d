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

template <std::size_t... i>
std::vector<long double> interpolated_tsit5(long double theta, std::index_sequence<i...>)
{
    return {lagen::detail::interpolant_weight<tableau::Tsit5, i>(theta)...};
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
