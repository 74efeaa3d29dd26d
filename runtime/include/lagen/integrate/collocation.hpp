// SPDX-License-Identifier: MIT
/// Collocation methods with s stages: X_i = s + Z_i,
///   Z_i = h sum_j a_ij f(t + c_j h, X_j),   s1 = s + h sum_j b_j f(t + c_j h, X_j),
/// where a_ij and b_j integrate the Lagrange polynomials of the nodes c from 0 to c_i and to 1.
/// The coefficients are kept as mu_ij = a_ij / b_j. A method keeps quadratic invariants where mu_ij + mu_ji = 1, and of
/// Gauss' nodes that holds exactly here, for the rounded numbers: rounded a_ij would lose such an invariant in
/// proportion to the number of steps [Antonana, Makazaga, Murua, Numer. Algorithms 76 (2017) 861; Hairer, McLachlan,
/// Razakarivony, BIT 48 (2008) 231].
/// Everything is computed in the scalar type from closed forms of the nodes.
#pragma once

#include "lagen/integrate/newton_matrix.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace lagen::detail {

/// Nodes c, weights b and mu of a method with s stages.
template <class Real, std::size_t s>
struct Collocation {
    std::array<Real, s> c{};
    std::array<Real, s> b{};
    std::array<std::array<Real, s>, s> mu{};
};

/// Legendre's polynomials L_0 .. L_s at x.
template <std::size_t s, class Real>
std::array<Real, s + 1> legendre(const Real& x) noexcept
{
    std::array<Real, s + 1> values{};
    values[0] = Real(1);
    if constexpr (s > 0) values[1] = x;
    for (std::size_t k = 2; k <= s; ++k)
        values[k] = (Real(2 * k - 1) * x * values[k - 1] - Real(k - 1) * values[k - 2]) / Real(k);
    return values;
}

/// The coefficients of the nodes (1 + x_i) / 2, x the zeros of L_s in increasing order:
///   mu_ij = 1/2 + 1/2 sum_{k=1}^{s-1} (L_k(x_i) L_{k-1}(x_j) - L_{k-1}(x_i) L_k(x_j))
/// [Hairer, Wanner IV.5, W-transformation]. For i > j it lies between 1/2 and 2, so that mu_ji = 1 - mu_ij is exact.
template <class Real, std::size_t s>
Collocation<Real, s> gauss_coefficients(const std::array<Real, s>& x, const std::array<Real, s>& b) noexcept
{
    Collocation<Real, s> method;
    method.b = b;
    for (std::size_t i = 0; i < s; ++i) {
        method.c[i] = (Real(1) + x[i]) / Real(2);
        method.mu[i][i] = Real(1) / Real(2);
        const auto at_i = legendre<s>(x[i]);
        for (std::size_t j = 0; j < i; ++j) {
            const auto at_j = legendre<s>(x[j]);
            Real sum = Real(1);
            for (std::size_t k = 1; k < s; ++k) sum += at_i[k] * at_j[k - 1] - at_i[k - 1] * at_j[k];
            method.mu[i][j] = sum / Real(2);
            method.mu[j][i] = Real(1) - method.mu[i][j];
        }
    }
    return method;
}

/// Gauss' method with s stages, order 2 s. `denominator` is that of the stability function, a multiple of
/// det(1 - z A) by rising powers of z; `poles` are close to its zeros, real ones first, one of each conjugate pair.
template <std::size_t s>
struct GaussScheme;

template <>
struct GaussScheme<1> {
    static constexpr std::size_t stages = 1, real_poles = 1;
    static constexpr int order = 2;
    static constexpr bool stiffly_accurate = false;
    static constexpr std::array<int, 2> denominator{2, -1};
    static constexpr std::array<Complex<double>, 1> poles{{{2, 0}}};

    template <class Real>
    static Collocation<Real, 1> coefficients() noexcept
    {
        return gauss_coefficients<Real, 1>({Real(0)}, {Real(1)});
    }
};

template <>
struct GaussScheme<2> {
    static constexpr std::size_t stages = 2, real_poles = 0;
    static constexpr int order = 4;
    static constexpr bool stiffly_accurate = false;
    static constexpr std::array<int, 3> denominator{12, -6, 1};
    static constexpr std::array<Complex<double>, 1> poles{{{3, 1.73}}};

    template <class Real>
    static Collocation<Real, 2> coefficients() noexcept
    {
        using std::sqrt;
        const Real x = sqrt(Real(1) / Real(3)), half = Real(1) / Real(2);
        return gauss_coefficients<Real, 2>({Real(-x), x}, {half, half});
    }
};

template <>
struct GaussScheme<3> {
    static constexpr std::size_t stages = 3, real_poles = 1;
    static constexpr int order = 6;
    static constexpr bool stiffly_accurate = false;
    static constexpr std::array<int, 4> denominator{120, -60, 12, -1};
    static constexpr std::array<Complex<double>, 2> poles{{{4.64, 0}, {3.68, 3.51}}};

    /// The weights 5/18, 4/9, 5/18, rounded so that their sum is exactly 1.
    template <class Real>
    static Collocation<Real, 3> coefficients() noexcept
    {
        using std::sqrt;
        const Real x = sqrt(Real(3) / Real(5)), outer = Real(5) / Real(18);
        return gauss_coefficients<Real, 3>({Real(-x), Real(0), x}, {outer, Real(Real(1) - Real(2) * outer), outer});
    }
};

template <>
struct GaussScheme<4> {
    static constexpr std::size_t stages = 4, real_poles = 0;
    static constexpr int order = 8;
    static constexpr bool stiffly_accurate = false;
    static constexpr std::array<int, 5> denominator{1680, -840, 180, -20, 1};
    static constexpr std::array<Complex<double>, 2> poles{{{4.21, 5.31}, {5.79, 1.73}}};

    /// x^2 = 3/7 +- 2/7 sqrt(6/5), the smaller one from their product 3/35; weights 1/4 -+ sqrt(30)/72, rounded so that
    /// their sum is exactly 1.
    template <class Real>
    static Collocation<Real, 4> coefficients() noexcept
    {
        using std::sqrt;
        const Real square = (Real(3) + Real(2) * sqrt(Real(6) / Real(5))) / Real(7);
        const Real outer = sqrt(square), inner = sqrt(Real(Real(3) / (Real(35) * square)));
        const Real large = Real(1) / Real(4) + sqrt(Real(30)) / Real(72), small = Real(1) / Real(2) - large;
        return gauss_coefficients<Real, 4>({Real(-outer), Real(-inner), inner, outer}, {small, large, large, small});
    }
};

/// Radau IIA with s stages, order 2 s - 1; the nodes end at 1 [Hairer, Wanner IV.5, tables 5.5 and 5.6].
template <std::size_t s>
struct RadauScheme;

template <>
struct RadauScheme<2> {
    static constexpr std::size_t stages = 2, real_poles = 0;
    static constexpr int order = 3;
    static constexpr bool stiffly_accurate = true; ///< s1 = X_2
    static constexpr std::array<int, 3> denominator{6, -4, 1};
    static constexpr std::array<Complex<double>, 1> poles{{{2, 1.41}}};

    template <class Real>
    static Collocation<Real, 2> coefficients() noexcept
    {
        const Real one = Real(1), three = Real(3);
        Collocation<Real, 2> method;
        method.c = {Real(one / three), one};
        method.b = {Real(three / Real(4)), Real(one / Real(4))};
        method.mu = {{{Real(Real(5) / Real(9)), Real(-one / three)}, {one, one}}};
        return method;
    }
};

template <>
struct RadauScheme<3> {
    static constexpr std::size_t stages = 3, real_poles = 1;
    static constexpr int order = 5;
    static constexpr bool stiffly_accurate = true; ///< s1 = X_3
    static constexpr std::array<int, 4> denominator{60, -36, 9, -1};
    static constexpr std::array<Complex<double>, 2> poles{{{3.64, 0}, {2.68, 3.05}}};

    template <class Real>
    static Collocation<Real, 3> coefficients() noexcept
    {
        using std::sqrt;
        const Real root = sqrt(Real(6));
        Collocation<Real, 3> method;
        method.c = {Real((Real(4) - root) / Real(10)), Real((Real(4) + root) / Real(10)), Real(1)};
        method.b = {Real((Real(16) - root) / Real(36)), Real((Real(16) + root) / Real(36)), Real(Real(1) / Real(9))};
        const std::array<std::array<Real, 3>, 2> a{{
            {Real((Real(88) - Real(7) * root) / Real(360)), Real((Real(296) - Real(169) * root) / Real(1800)),
             Real((Real(3) * root - Real(2)) / Real(225))},
            {Real((Real(296) + Real(169) * root) / Real(1800)), Real((Real(88) + Real(7) * root) / Real(360)),
             Real((Real(-3) * root - Real(2)) / Real(225))},
        }};
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i < 2; ++i) method.mu[i][j] = a[i][j] / method.b[j];
            method.mu[2][j] = Real(1);
        }
        return method;
    }
};

/// One eigenvalue lambda of A with its eigenvectors, left . right = 1. With them the s n equations of Newton's method
/// fall apart into systems (1 - h lambda J) w = left . R, and the increments are sums of right w [Butcher 1976; Hairer,
/// Wanner IV.8]; of a pair of conjugate ones the real part of one counts twice.
template <class Entry, std::size_t s>
struct Mode {
    Entry lambda{};
    std::array<Entry, s> left{};
    std::array<Entry, s> right{};
};

/// The modes of a scheme's matrix A: real ones and one of each conjugate pair, as long as in radau5.f: real vectors
/// `right` of length 1, the last entry of complex ones 1/2.
template <class Scheme, class Real>
struct Modes {
    static constexpr std::size_t s = Scheme::stages, reals = Scheme::real_poles, pairs = (s - reals) / 2;
    std::array<Mode<Real, s>, reals> real{};
    std::array<Mode<Complex<Real>, s>, pairs> complex{};
};

/// The zero of the scheme's denominator near `start`, by Newton's method until it stands still.
template <class Scheme, class Real>
Complex<Real> pole(const Complex<double>& start) noexcept
{
    Complex<Real> z{Real(start.re), Real(start.im)};
    for (int step = 0; step < 12; ++step) { // every step doubles the number of right digits
        Complex<Real> value{}, slope{};
        for (std::size_t k = Scheme::denominator.size(); k-- > 0;) {
            slope = slope * z + value;
            value = value * z + Complex<Real>{Real(Scheme::denominator[k]), Real(0)};
        }
        z = z - value * reciprocal(slope);
    }
    return z;
}

/// The eigenvector of A for lambda: v_i = sum_{k=0}^{s-1} lambda^k M^(k+1)(c_i) with M(x) = prod_j (x - c_j), since
/// lambda v(x) - integral of v from 0 to x is then a multiple of M(x).
template <std::size_t s, class Real>
std::array<Complex<Real>, s> eigenvector(const std::array<Real, s>& c, const Complex<Real>& lambda) noexcept
{
    std::array<Real, s + 1> m{}; // by rising powers
    m[0] = Real(1);
    for (std::size_t j = 0; j < s; ++j)
        for (std::size_t k = j + 2; k-- > 0;) m[k] = (k > 0 ? m[k - 1] : Real(0)) - c[j] * m[k];
    std::array<Complex<Real>, s> v{};
    Complex<Real> power{Real(1), Real(0)};
    for (std::size_t derivative = 1; derivative <= s; ++derivative) {
        for (std::size_t k = 0; k < s; ++k) m[k] = Real(k + 1) * m[k + 1];
        m[s] = Real(0);
        for (std::size_t i = 0; i < s; ++i) {
            Real value = Real(0);
            for (std::size_t k = s; k-- > 0;) value = value * c[i] + m[k];
            v[i] = v[i] + value * power;
        }
        power = power * lambda;
    }
    return v;
}

template <std::size_t s, class Real>
std::array<Complex<Real>, s> of_length_one(std::array<Complex<Real>, s> v) noexcept
{
    using std::sqrt;
    Real square = Real(0);
    for (const Complex<Real>& entry : v) square += entry.re * entry.re;
    const Real factor = Real(1) / sqrt(square);
    for (Complex<Real>& entry : v) entry = factor * entry;
    return v;
}

template <std::size_t s, class Real>
std::array<Complex<Real>, s> with_last_half(std::array<Complex<Real>, s> v) noexcept
{
    const Complex<Real> factor = reciprocal(v.back() + v.back());
    for (Complex<Real>& entry : v) entry = factor * entry;
    return v;
}

/// Eigenvalues and eigenvectors of the scheme's A with nodes c.
template <class Scheme, class Real>
Modes<Scheme, Real> modes(const std::array<Real, Scheme::stages>& c) noexcept
{
    constexpr std::size_t s = Scheme::stages, reals = Modes<Scheme, Real>::reals;
    Modes<Scheme, Real> result;
    MatrixLu<Complex<Real>, s> matrix; // columns: every eigenvector, conjugate ones too
    for (std::size_t k = 0; k < Scheme::poles.size(); ++k) {
        const Complex<Real> lambda = reciprocal(pole<Scheme, Real>(Scheme::poles[k]));
        const auto right =
            k < reals ? of_length_one(eigenvector<s>(c, lambda)) : with_last_half(eigenvector<s>(c, lambda));
        const std::size_t column = k < reals ? k : 2 * k - reals;
        for (std::size_t i = 0; i < s; ++i) {
            matrix(i, column) = right[i];
            if (k >= reals) matrix(i, column + 1) = Complex<Real>{right[i].re, Real(-right[i].im)};
        }
        if (k >= reals) {
            result.complex[k - reals].lambda = lambda;
            result.complex[k - reals].right = right;
        } else if constexpr (reals > 0) {
            result.real[k].lambda = lambda.re;
            for (std::size_t i = 0; i < s; ++i) result.real[k].right[i] = right[i].re;
        }
    }
    static_cast<void>(matrix.factor()); // regular: the eigenvalues are distinct
    for (std::size_t j = 0; j < s; ++j) {
        std::array<Complex<Real>, s> column{};
        column[j].re = Real(1);
        matrix.solve(column);
        for (std::size_t k = 0; k < result.real.size(); ++k) result.real[k].left[j] = column[k].re;
        for (std::size_t k = 0; k < result.complex.size(); ++k) result.complex[k].left[j] = column[reals + 2 * k];
    }
    return result;
}

} // namespace lagen::detail
