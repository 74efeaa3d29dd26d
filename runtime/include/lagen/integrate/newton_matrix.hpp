// SPDX-License-Identifier: MIT
/// The linear systems of Newton's method in implicit methods: complex numbers over any scalar, and LU decompositions of
/// real and complex n x n matrices with partial pivoting. They only have to be good enough for the iteration to
/// converge; what it converges to does not depend on them.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace lagen::detail {

/// A complex number over any scalar (std::complex promises nothing for other types than float, double, long double, and
/// looks for infinities in every product).
template <class Real>
struct Complex {
    Real re = Real(0);
    Real im = Real(0);

    friend Complex operator+(const Complex& a, const Complex& b) noexcept { return {a.re + b.re, a.im + b.im}; }
    friend Complex operator-(const Complex& a, const Complex& b) noexcept { return {a.re - b.re, a.im - b.im}; }
    friend Complex operator*(const Complex& a, const Complex& b) noexcept
    {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend Complex operator*(const Real& a, const Complex& b) noexcept { return {a * b.re, a * b.im}; }
    friend bool operator==(const Complex& a, const Complex& b) noexcept { return a.re == b.re && a.im == b.im; }
};

template <class Real>
Real reciprocal(const Real& a) noexcept
{
    return Real(1) / a;
}
template <class Real>
Complex<Real> reciprocal(const Complex<Real>& a) noexcept
{
    const Real square = a.re * a.re + a.im * a.im;
    return {a.re / square, -a.im / square};
}

/// |a|, for complex numbers |re| + |im|.
template <class Real>
Real magnitude(const Real& a) noexcept
{
    using std::abs;
    return abs(a);
}
template <class Real>
Real magnitude(const Complex<Real>& a) noexcept
{
    return magnitude(a.re) + magnitude(a.im);
}

template <class Real>
struct RealPart {
    using type = Real;
};
template <class Real>
struct RealPart<Complex<Real>> {
    using type = Real;
};

/// Zero; a scalar's default constructor need not make one.
template <class Entry>
Entry zero() noexcept
{
    if constexpr (std::is_same_v<Entry, typename RealPart<Entry>::type>)
        return Entry(0);
    else
        return Entry{};
}

/// Entries by rows: in place up to a size that a stack holds easily, else on the heap (once, at construction).
template <class Entry, std::size_t rows, std::size_t columns>
class Grid {
  public:
    static constexpr bool in_place = rows * columns <= 48 * 48;

    Grid() { clear(); }
    [[nodiscard]] Entry& operator()(std::size_t i, std::size_t j) noexcept { return entries_[i * columns + j]; }
    [[nodiscard]] const Entry& operator()(std::size_t i, std::size_t j) const noexcept
    {
        return entries_[i * columns + j];
    }

    void clear()
    {
        if constexpr (in_place)
            entries_.fill(zero<Entry>());
        else
            entries_.assign(rows * columns, zero<Entry>()); // allocates the first time alone
    }

  private:
    std::conditional_t<in_place, std::array<Entry, rows * columns>, std::vector<Entry>> entries_;
};

/// f(0), .., f(count - 1), the numbers as constants: written out, which g++ 12 does not do at -O2 by itself.
template <std::size_t count, class Function>
[[gnu::always_inline]] inline void write_out(const Function& f) noexcept
{
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
        (f(std::integral_constant<std::size_t, k>()), ...);
    }
    (std::make_index_sequence<count>{});
}

/// P A = L U, the pivot of a column its largest entry. Zeros below the diagonal cost nothing.
template <class Entry, std::size_t n>
class MatrixLu {
  public:
    using Real = typename RealPart<Entry>::type;

    /// The matrix to be factorised, by entries.
    [[nodiscard]] Entry& operator()(std::size_t i, std::size_t j) noexcept { return lu_(i, j); }

    void clear() { lu_.clear(); }

    /// Factorises in place. False where a pivot is zero or no number.
    [[nodiscard]] bool factor() noexcept
    {
        for (std::size_t k = 0; k < n; ++k) {
            if (!bring_up_pivot(k)) return false;
            const Entry inverse = reciprocal(lu_(k, k));
            inverses_[k] = inverse;
            for (std::size_t i = k + 1; i < n; ++i) {
                if (lu_(i, k) == zero<Entry>()) continue;
                const Entry multiplier = lu_(i, k) * inverse;
                lu_(i, k) = multiplier;
                for (std::size_t j = k + 1; j < n; ++j) lu_(i, j) = lu_(i, j) - multiplier * lu_(k, j);
            }
        }
        return true;
    }

    /// Replaces b by A^-1 b.
    void solve(std::array<Entry, n>& b) const noexcept
    {
        for (std::size_t k = 0; k + 1 < n; ++k)
            if (swaps_[k] != k) std::swap(b[k], b[swaps_[k]]);
        if constexpr (n <= 6) {
            write_out<n>([&](auto i) { write_out<i()>([&](auto j) { b[i] = b[i] - lu_(i, j) * b[j]; }); });
            write_out<n>([&](auto k) {
                constexpr std::size_t j = n - 1 - k();
                b[j] = b[j] * inverses_[j];
                write_out<j>([&](auto i) { b[i] = b[i] - lu_(i, j) * b[j]; });
            });
        } else {
            for (std::size_t i = 1; i < n; ++i)
                for (std::size_t j = 0; j < i; ++j) b[i] = b[i] - lu_(i, j) * b[j];
            for (std::size_t j = n; j-- > 0;) {
                b[j] = b[j] * inverses_[j];
                for (std::size_t i = 0; i < j; ++i) b[i] = b[i] - lu_(i, j) * b[j];
            }
        }
    }

  private:
    bool bring_up_pivot(std::size_t k) noexcept
    {
        Real largest = magnitude(lu_(k, k));
        std::size_t row = k;
        for (std::size_t i = k + 1; i < n; ++i) {
            const Real size = magnitude(lu_(i, k));
            if (!(size > largest)) continue;
            largest = size;
            row = i;
        }
        // Whole rows, so that a right-hand side takes every exchange before the first elimination.
        if constexpr (n > 1)
            if (k < row && row < n)
                for (std::size_t j = 0; j < n; ++j) std::swap(lu_(k, j), lu_(row, j));
        swaps_[k] = row;
        return largest > Real(0) && largest - largest == Real(0);
    }

    Grid<Entry, n, n> lu_;
    std::array<Entry, n> inverses_{};
    std::array<std::size_t, n> swaps_{};
};

} // namespace lagen::detail
