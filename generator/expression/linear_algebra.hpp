// SPDX-License-Identifier: GPL-2.0-or-later
/// Dense linear algebra over any field or ring. (Generated code has its own: runtime, linear.hpp.) An arithmetic says
/// which pivot is better, and how a - f b and a / b are computed: in floating point as they come, rounded, or exactly.
#pragma once

#include "expression/tree.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace lagen {

/// Arithmetic of floating point numbers; the largest pivot is the best.
template <class Scalar>
struct Arithmetic {
    using Number = Scalar;
    [[nodiscard]] bool is_better_pivot(Scalar a, Scalar than) const { return std::abs(a) > std::abs(than); }
    [[nodiscard]] bool is_pivot(Scalar a) const { return std::abs(a) > 0; }
    [[nodiscard]] Scalar quotient(Scalar a, Scalar b) const { return a / b; }
    void subtract_product(Scalar& a, Scalar f, Scalar b) const { a -= f * b; }
    /// The solution of a singular system of n unknowns.
    [[nodiscard]] std::vector<Scalar> no_solution(std::size_t n) const
    {
        return std::vector<Scalar>(n, std::numeric_limits<Scalar>::quiet_NaN());
    }
};

/// Arithmetic of exact numbers; the first pivot that is not 0 serves.
template <>
struct Arithmetic<Rational> {
    using Number = Rational;
    [[nodiscard]] bool is_better_pivot(const Rational& a, const Rational& than) const
    {
        return sgn(than) == 0 && sgn(a) != 0;
    }
    [[nodiscard]] bool is_pivot(const Rational& a) const { return sgn(a) != 0; }
    [[nodiscard]] Rational quotient(const Rational& a, const Rational& b) const { return a / b; }
    void subtract_product(Rational& a, const Rational& f, const Rational& b) const
    {
        if (sgn(f) != 0) a -= f * b;
    }
    [[nodiscard]] std::vector<Rational> no_solution(std::size_t) const { return {}; }
};

/// P A = L U by rows with row exchanges; `regular` is false where a column has no pivot.
template <class Number>
struct Factorisation {
    std::vector<Number> lu;
    std::vector<std::size_t> order; ///< row of A that stands in row i of L U
    bool regular = true;
};

/// The factorisation of the n x n matrix `a`, by rows.
template <class Number, class Field = Arithmetic<Number>>
[[nodiscard]] Factorisation<Number> factorise(std::vector<Number> a, std::size_t n, const Field& field = {})
{
    Factorisation<Number> result;
    result.order.resize(n);
    for (std::size_t i = 0; i < n; ++i) result.order[i] = i;
    for (std::size_t k = 0; k < n && result.regular; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (field.is_better_pivot(a[i * n + k], a[pivot * n + k])) pivot = i;
        result.regular = field.is_pivot(a[pivot * n + k]);
        if (!result.regular) break;
        for (std::size_t j = 0; pivot != k && j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
        std::swap(result.order[k], result.order[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Number factor = a[i * n + k] = field.quotient(a[i * n + k], a[k * n + k]);
            for (std::size_t j = k + 1; j < n; ++j) field.subtract_product(a[i * n + j], factor, a[k * n + j]);
        }
    }
    result.lu = std::move(a);
    return result;
}

/// z with A z = b; the field's `no_solution` where A is singular.
template <class Number, class Field = Arithmetic<Number>>
[[nodiscard]] std::vector<Number> substitute(const Factorisation<Number>& f, const std::vector<Number>& b,
                                             const Field& field = {})
{
    const std::size_t n = b.size();
    if (!f.regular) return field.no_solution(n);
    std::vector<Number> z(n);
    for (std::size_t i = 0; i < n; ++i) {
        z[i] = b[f.order[i]];
        for (std::size_t j = 0; j < i; ++j) field.subtract_product(z[i], f.lu[i * n + j], z[j]);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) field.subtract_product(z[i], f.lu[i * n + j], z[j]);
        z[i] = field.quotient(z[i], f.lu[i * n + i]);
    }
    return z;
}

/// Along which row a determinant is expanded: the first, as it is written on paper, or the last, so that leading minors
/// share their minors.
enum class ExpandBy { first_row, last_row };

/// The determinant of an n x n matrix over a ring without division, by minors that are computed once each and only
/// where an entry that is not 0 asks for them: 2^n of them. The ring has Number, zero(), one(), entry(i, j),
/// is_zero(a), times(a, b) and add(sum, term, sign).
template <class Ring>
[[nodiscard]] typename Ring::Number determinant(Ring ring, std::size_t n, ExpandBy expansion = ExpandBy::first_row)
{
    const bool first = expansion == ExpandBy::first_row;
    const std::size_t whole = (std::size_t{1} << n) - 1;
    const auto row_of = [&](std::size_t set) {
        const auto size = static_cast<std::size_t>(std::popcount(set));
        return first ? n - size : size - 1;
    };
    const auto without = [](std::size_t set, std::size_t column) { return set & ~(std::size_t{1} << column); };
    std::vector<bool> needed(whole + 1, false);
    needed[whole] = true;
    for (std::size_t set = whole; set > 0; --set)
        for (std::size_t column = 0; column < n; ++column)
            if (needed[set] && (set >> column & 1U) != 0 && !ring.is_zero(ring.entry(row_of(set), column)))
                needed[without(set, column)] = true;
    std::vector<typename Ring::Number> minors(whole + 1, ring.zero());
    minors[0] = ring.one();
    for (std::size_t set = 1; set <= whole; ++set) {
        if (!needed[set]) continue;
        std::size_t position = first ? 0 : row_of(set);
        for (std::size_t column = 0; column < n; ++column) {
            if ((set >> column & 1U) == 0) continue;
            const auto& entry = ring.entry(row_of(set), column);
            const int sign = position++ % 2 == 0 ? 1 : -1;
            if (!ring.is_zero(entry)) ring.add(minors[set], ring.times(entry, minors[without(set, column)]), sign);
        }
    }
    return minors[whole];
}

/// Cramer's rule: the determinant of the ring's matrix with b for one column is the numerator of that unknown.
template <class Ring>
struct WithColumn : Ring {
    std::size_t place;
    const std::vector<typename Ring::Number>& b;

    [[nodiscard]] decltype(auto) entry(std::size_t i, std::size_t j) const
    {
        return j == place ? b[i] : Ring::entry(i, j);
    }
};
template <class Ring>
[[nodiscard]] typename Ring::Number numerator(const Ring& ring, std::size_t place,
                                              const std::vector<typename Ring::Number>& b,
                                              ExpandBy expansion = ExpandBy::first_row)
{
    return determinant(WithColumn<Ring>{ring, place, b}, b.size(), expansion);
}

/// The classes of 0 .. count - 1 that `joined(i, j)` connects, each ascending, by their first members.
template <class Joined>
[[nodiscard]] std::vector<std::vector<std::size_t>> connected_classes(std::size_t count, const Joined& joined)
{
    std::vector<std::size_t> parent(count);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
            if (i != j && joined(i, j)) {
                const std::size_t a = root(i);
                const std::size_t b = root(j);
                parent[a < b ? b : a] = a < b ? a : b;
            }
    std::vector<std::vector<std::size_t>> classes;
    std::vector<std::size_t> class_of(count);
    for (std::size_t k = 0; k < count; ++k) {
        if (root(k) == k) {
            class_of[k] = classes.size();
            classes.emplace_back();
        }
        classes[class_of[root(k)]].push_back(k);
    }
    return classes;
}

/// Rows and columns of a square matrix that entries connect which are not 0, ascending, by their first rows; a row or
/// column of zeros stands alone.
struct CoupledBlock {
    std::vector<std::size_t> rows;
    std::vector<std::size_t> columns;
};

template <class IsZero>
[[nodiscard]] std::vector<CoupledBlock> coupled_blocks(std::size_t n, const IsZero& is_zero)
{
    std::vector<CoupledBlock> blocks;
    const auto joined = [&](std::size_t i, std::size_t j) { return i < n && j >= n && !is_zero(i, j - n); };
    for (const std::vector<std::size_t>& members : connected_classes(2 * n, joined)) { // rows, then columns
        CoupledBlock& block = blocks.emplace_back();
        for (const std::size_t k : members) (k < n ? block.rows : block.columns).push_back(k < n ? k : k - n);
    }
    return blocks;
}

} // namespace lagen
