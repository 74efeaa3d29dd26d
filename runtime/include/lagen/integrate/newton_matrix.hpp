// SPDX-License-Identifier: MIT
/// The linear systems of Newton's method in implicit methods: complex numbers over any scalar, and LU decompositions of
/// real and complex n x n matrices with partial pivoting. They only have to be good enough for the iteration to
/// converge; what it converges to does not depend on them.
#pragma once

#include "lagen/integrate/sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

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

/// P A = L U, the pivot of a column its largest entry. Zeros below the diagonal cost nothing. A size that is known at
/// run time is `sized_later`.
template <class Entry, std::size_t size>
class MatrixLu {
  public:
    using Real = typename RealPart<Entry>::type;

    MatrixLu()
    {
        if constexpr (size != sized_later) begin(size);
    }

    /// A matrix of n x n zeros; takes memory where it is not in place.
    void begin(std::size_t n)
    {
        n_ = Size<size>(n);
        make_numbers(lu_, n * n, zero<Entry>());
        make_numbers(inverses_, n, zero<Entry>());
        make_numbers(swaps_, n, 0);
    }

    /// The matrix to be factorised, by entries.
    [[nodiscard]] Entry& operator()(std::size_t i, std::size_t j) noexcept { return lu_[i * n_ + j]; }

    void clear() noexcept { std::fill(lu_.begin(), lu_.end(), zero<Entry>()); }

    /// Factorises in place. False where a pivot is zero or no number.
    [[nodiscard]] bool factor() noexcept
    {
        return with_constant(n_, [&](auto n) { return this->factor(n); });
    }

    /// Replaces b by A^-1 b.
    void solve(Numbers<Entry, size>& b) const noexcept
    {
        with_constant(n_, [&](auto n) { this->solve(n, b.data()); });
    }

  private:
    template <class Number>
    [[gnu::always_inline]] bool factor(Number n) noexcept
    {
        const auto lu = [first = lu_.data(), n](std::size_t i, std::size_t j) -> Entry& { return first[i * n + j]; };
        for (std::size_t k = 0; k < n; ++k) {
            if (!bring_up_pivot(n, lu, k)) return false;
            const Entry inverse = reciprocal(lu(k, k));
            inverses_[k] = inverse;
            for (std::size_t i = k + 1; i < n; ++i) {
                if (lu(i, k) == zero<Entry>()) continue;
                const Entry multiplier = lu(i, k) * inverse;
                lu(i, k) = multiplier;
                for (std::size_t j = k + 1; j < n; ++j) lu(i, j) = lu(i, j) - multiplier * lu(k, j);
            }
        }
        return true;
    }

    template <class Number>
    [[gnu::always_inline]] void solve(Number n, Entry* b) const noexcept
    {
        const auto lu = [first = lu_.data(), n](std::size_t i, std::size_t j) { return first[i * n + j]; };
        for (std::size_t k = 0; k + 1 < n; ++k)
            if (swaps_[k] != k) std::swap(b[k], b[swaps_[k]]);
        if constexpr (is_constant_up_to<Number, 6>()) {
            write_out<n()>([&](auto i) { write_out<i()>([&](auto j) { b[i] = b[i] - lu(i, j) * b[j]; }); });
            write_out<n()>([&](auto k) {
                constexpr std::size_t j = n() - 1 - k();
                b[j] = b[j] * inverses_[j];
                write_out<j>([&](auto i) { b[i] = b[i] - lu(i, j) * b[j]; });
            });
        } else {
            for (std::size_t i = 1; i < n; ++i)
                for (std::size_t j = 0; j < i; ++j) b[i] = b[i] - lu(i, j) * b[j];
            for (std::size_t j = n; j-- > 0;) {
                b[j] = b[j] * inverses_[j];
                for (std::size_t i = 0; i < j; ++i) b[i] = b[i] - lu(i, j) * b[j];
            }
        }
    }

    template <class Number, class Places>
    bool bring_up_pivot(Number n, const Places& lu, std::size_t k) noexcept
    {
        Real largest = magnitude(lu(k, k));
        std::size_t row = k;
        for (std::size_t i = k + 1; i < n; ++i) {
            const Real size_here = magnitude(lu(i, k));
            if (!(size_here > largest)) continue;
            largest = size_here;
            row = i;
        }
        // Whole rows, so that a right-hand side takes every exchange before the first elimination.
        if (n > 1 && k < row && row < n)
            for (std::size_t j = 0; j < n; ++j) std::swap(lu(k, j), lu(row, j));
        swaps_[k] = row;
        return largest > Real(0) && largest - largest == Real(0);
    }

    [[no_unique_address]] Size<size> n_;
    Numbers<Entry, held_in_place(size, size)> lu_;
    Numbers<Entry, size> inverses_;
    Numbers<std::size_t, size> swaps_;
};

} // namespace lagen::detail
