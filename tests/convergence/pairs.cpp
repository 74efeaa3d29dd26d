// SPDX-License-Identifier: GPL-2.0-or-later
/// Order conditions, generated tree by tree and evaluated with 50 digits, of the pairs whose coefficients have 40: of
/// both formulas and of the interpolant, and that it joins the steps smoothly.
#include "lagen/integrate.hpp"
#include "support/nystrom_trees.hpp"
#include "support/rooted_trees.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include <map>

namespace tableau = lagen::tableau;

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Weights = std::vector<Wide>;
using lagen::support::worst_residual;

/// What the digits that are printed leave: interpolants have coefficients up to 6000.
const Wide exact_to("1e-34");

template <class Array>
Weights numbers(const Array& values)
{
    Weights list;
    for (const auto& value : values) list.push_back(value.template as<Wide>());
    return list;
}

/// Row `i` of a strict lower triangle.
template <class Array>
Weights row_of(const Array& triangle, std::size_t i)
{
    const Weights all = numbers(triangle);
    if (i == 0) return {};
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(i * (i - 1) / 2);
    return {first, first + static_cast<std::ptrdiff_t>(i)};
}

Weights minus(Weights a, const Weights& b)
{
    a.resize(std::max(a.size(), b.size()), Wide(0));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] -= b[i];
    return a;
}

Wide sum(const Weights& weights)
{
    Wide total = 0;
    for (const Wide& weight : weights) total += weight;
    return total;
}

Wide largest(const Weights& weights)
{
    Wide size = 0;
    for (const Wide& weight : weights) size = std::max<Wide>(size, abs(weight));
    return size;
}

template <class Tableau, class Function>
Weights interpolated(const Function& weight)
{
    return [&]<std::size_t... i>(std::index_sequence<i...>)
    {
        return Weights{weight.template operator()<i>()...};
    }
    (std::make_index_sequence<Tableau::dense_stages>{});
}

template <class Tableau>
Weights weights_at(const Wide& theta)
{
    return interpolated<Tableau>([&]<std::size_t i>() { return lagen::detail::interpolant_weight<Tableau, i>(theta); });
}

template <class Tableau>
Weights integrals_at(const Wide& theta)
{
    return interpolated<Tableau>(
        [&]<std::size_t i>() { return lagen::detail::interpolant_integral<Tableau, i>(theta); });
}

/// Derivatives of the weights: 1 for the first stage at 0, 1 for the end at 1, else 0, so that the slope is f.
template <class Tableau>
Wide worst_slope()
{
    Wide worst = 0;
    for (std::size_t i = 0; i < Tableau::dense_stages; ++i) {
        const Weights row = numbers(Tableau::interpolant[i]);
        Wide after = i == Tableau::end ? Wide(-1) : Wide(0), before = row[0] - Wide(i == 0 ? 1 : 0);
        for (std::size_t k = 0; k < row.size(); ++k) after += Wide(k + 1) * row[k];
        worst = std::max<Wide>(worst, std::max<Wide>(abs(after), abs(before)));
    }
    return worst;
}

/// The weights have this order, and miss a condition of the next one by more than `least`.
template <class Tableau>
void check_order(const Weights& weights, std::size_t order, double least)
{
    const Weights a = numbers(Tableau::a);
    CHECK(worst_residual(a, weights, 1, order) < exact_to);
    CHECK(worst_residual(a, weights, order + 1, order + 1) > least);
}

/// Both formulas, the nodes, and the weights inside the step, that of theta being `inside(theta)`.
template <class Tableau, class Error, class Inside>
void check_orders(const Error& error, const Inside& inside)
{
    const Weights b = row_of(Tableau::a, Tableau::end);
    constexpr std::size_t d = Tableau::dense_order;
    check_order<Tableau>(b, Tableau::order, 1e-8);
    check_order<Tableau>(minus(b, numbers(error)), Tableau::embedded_order, 1e-7);
    for (std::size_t i = 0; i < Tableau::dense_stages; ++i)
        CHECK(abs(sum(row_of(Tableau::a, i)) - Tableau::c[i].template as<Wide>()) < exact_to);
    const Weights a = numbers(Tableau::a);
    for (int k = 1; k < 8; ++k) CHECK(worst_residual(a, inside(Wide(k) / 8), 1, d, Wide(k) / 8) < exact_to);
    CHECK(worst_residual(a, inside(Wide(0.5)), d + 1, d + 1, Wide(0.5)) > 1e-9);
    CHECK(largest(minus(inside(Wide(1)), b)) < exact_to);
}

template <class Tableau>
void check_pair()
{
    check_orders<Tableau>(Tableau::error, weights_at<Tableau>);
    CHECK(worst_slope<Tableau>() < exact_to * 1000);
}

/// The weights of the 16 stages in Hairer's nested form, as in dop853.hpp.
Weights nested_weights(const Wide& theta)
{
    using Table = tableau::Dop853;
    Weights b = row_of(Table::a, Table::end), weights(Table::dense_stages);
    b.resize(Table::dense_stages);
    const Wide rest = 1 - theta;
    for (std::size_t i = 0; i < Table::dense_stages; ++i) {
        const Wide first = i == 0 ? 1 : 0, last = i == Table::end ? 1 : 0;
        const auto of = [i](const auto& row) { return row[i].template as<Wide>(); };
        Wide sum = rest * (of(Table::dense6) + theta * of(Table::dense7));
        sum = rest * (of(Table::dense4) + theta * (of(Table::dense5) + sum));
        weights[i] = theta * (b[i] + rest * (first - b[i] + theta * (2 * b[i] - first - last + sum)));
    }
    return weights;
}

template <class Tableau>
lagen::support::NystromRows<Wide> rows_of()
{
    lagen::support::NystromRows<Wide> rows;
    rows.c = numbers(Tableau::c);
    for (std::size_t i = 0; i < Tableau::dense_stages; ++i) {
        rows.abar.push_back(row_of(Tableau::abar, i));
        if constexpr (requires { Tableau::a; }) rows.a.push_back(row_of(Tableau::a, i));
    }
    return rows;
}

template <class Tableau>
void check_nystrom_pair()
{
    constexpr std::size_t p = Tableau::order, q = Tableau::embedded_order, d = Tableau::dense_order;
    const auto rows = rows_of<Tableau>();
    const lagen::support::NystromTrees<Wide> grown(p + 1, !rows.a.empty());
    const auto& trees = grown.list();
    const auto phi = elementary_weights(rows, trees);
    const auto worst = [&](const Weights& weights, std::size_t from, std::size_t to, bool twice, const Wide& theta) {
        return worst_nystrom_residual(phi, trees, weights, from, to, twice, theta);
    };
    const Weights bbar = numbers(Tableau::bbar), b = numbers(Tableau::b);
    for (const bool twice : {false, true}) {
        const Weights& high = twice ? bbar : b;
        CHECK(worst(high, 1, p, twice, 1) < exact_to);
        CHECK(worst(high, p + 1, p + 1, twice, 1) > 1e-9);
        const Weights low = minus(high, numbers(twice ? Tableau::error_bar : Tableau::error));
        CHECK(worst(low, 1, q, twice, 1) < exact_to);
        CHECK(worst(low, q + 1, q + 1, twice, 1) > 1e-8);
        for (int k = 1; k < 8; ++k) {
            const Wide theta = Wide(k) / 8;
            const Weights inside = twice ? integrals_at<Tableau>(theta) : weights_at<Tableau>(theta);
            CHECK(worst(inside, 1, d, twice, theta) < exact_to);
        }
    }
    CHECK(worst(weights_at<Tableau>(Wide(0.5)), d + 1, d + 1, false, Wide(0.5)) > 1e-10);
    CHECK(largest(minus(row_of(Tableau::abar, Tableau::end), bbar)) < exact_to);
    CHECK(largest(minus(weights_at<Tableau>(1), b)) < exact_to);
    CHECK(largest(minus(integrals_at<Tableau>(1), bbar)) < exact_to);
    CHECK(worst_slope<Tableau>() < exact_to * 1000);
}

std::map<std::size_t, int> counts(std::size_t order, bool rates)
{
    std::map<std::size_t, int> count;
    const lagen::support::NystromTrees<Wide> trees(order, rates);
    for (const auto& tree : trees.list()) ++count[tree.order];
    return count;
}

} // namespace

TEST_CASE("Verner's pairs have their orders, their embedded formulas and their interpolants one less")
{
    check_pair<tableau::Verner65>();
    check_pair<tableau::Verner76>();
    check_pair<tableau::Verner87>();
    check_pair<tableau::Verner98>();
}

TEST_CASE("DOP853 has order 8, its embedded formulas order 5 and 3, its dense output order 7")
{
    using Table = tableau::Dop853;
    check_orders<Table>(Table::error5, nested_weights);
    check_order<Table>(minus(row_of(Table::a, Table::end), numbers(Table::error3)), 3, 1e-4);
    const Wide root = sqrt(Wide(6));
    CHECK(abs(Table::c[1].as<Wide>() - (12 - 2 * root) / 135) < exact_to);
    CHECK(abs(Table::c[4].as<Wide>() - (6 + root) / 30) < exact_to);
}

TEST_CASE("The digits of DOP853 are the published ones")
{
    using Table = tableau::Dop853;
    const auto agrees = [](const lagen::Coefficient& made, const char* published) {
        return abs(made.as<Wide>() - Wide(published)) < abs(Wide(published)) * Wide("1e-25");
    };
    CHECK(agrees(Table::a[66], "5.42937341165687622380535766363e-2"));
    CHECK(agrees(Table::a[9 * 8 / 2], "0.477662536438264365890433908527"));
    CHECK(agrees(Table::a[13 * 12 / 2 + 12], "-0.008298"));
    CHECK(agrees(Table::a[15 * 14 / 2 + 14], "-9.15095847217987001081870187138"));
    CHECK(agrees(Table::error5[0], "0.1312004499419488073250102996e-1"));
    CHECK(agrees(Table::error3[11], "0.0226517921983608258118062039631"));
    CHECK(agrees(Table::dense5[7], "-0.37454675472269020279518312152e+3"));
    CHECK(agrees(Table::dense7[15], "-0.14972683625798562581422125276e+3"));
}

TEST_CASE("There are 1, 1, 2, 3, 6, 10, 20, 36, 72, 137 trees of x'' = f(t, x), 1, 2, 6, 18, 60 with f(t, x, x')")
{
    CHECK(counts(10, false) ==
          std::map<std::size_t, int>{
              {1, 1}, {2, 1}, {3, 2}, {4, 3}, {5, 6}, {6, 10}, {7, 20}, {8, 36}, {9, 72}, {10, 137}});
    CHECK(counts(5, true) == std::map<std::size_t, int>{{1, 1}, {2, 2}, {3, 6}, {4, 18}, {5, 60}});
}

TEST_CASE("Nystrom's pairs have their orders, x and x' of both formulas and inside the step")
{
    check_nystrom_pair<tableau::Rkn64>();
    check_nystrom_pair<tableau::Rkn86>();
    check_nystrom_pair<tableau::Rkn1210>();
    check_nystrom_pair<tableau::Rkng54>();
}

TEST_CASE("A coefficient that is changed in its 30th digit is found")
{
    const Weights a = numbers(tableau::Verner98::a);
    Weights changed = a;
    changed[20] *= 1 + Wide("1e-30");
    const Weights b = row_of(tableau::Verner98::a, tableau::Verner98::end);
    CHECK(worst_residual(changed, b, 1, 9) > exact_to);
}
