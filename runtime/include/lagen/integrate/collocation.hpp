// SPDX-License-Identifier: MIT
/// Collocation methods with s stages: X_i = s + Z_i,
///   Z_i = h sum_j a_ij f(t + c_j h, X_j),   s1 = s + h sum_j b_j f(t + c_j h, X_j),
/// where a_ij and b_j integrate the Lagrange polynomials of the nodes c from 0 to c_i and to 1.
/// The coefficients are kept as mu_ij = a_ij / b_j. A method keeps quadratic invariants where mu_ij + mu_ji = 1, and of
/// Gauss' nodes that holds exactly here, for the rounded numbers: rounded a_ij would lose such an invariant in
/// proportion to the number of steps [Antonana, Makazaga, Murua, Numer. Algorithms 76 (2017) 861; Hairer, McLachlan,
/// Razakarivony, BIT 48 (2008) 231].
/// Everything is computed for the scalar type: what is irrational in a wider one where there is one.
#pragma once

#include "lagen/integrate/newton_matrix.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

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

/// A scalar in which coefficients of `Real` are computed, so that they are rounded once: the next wider built-in one.
template <class Real>
using Wider = std::conditional_t<std::is_same_v<Real, float>, double,
                                 std::conditional_t<std::is_same_v<Real, double>, long double, Real>>;

/// L_{s-1} and L_s at x.
template <class Real>
std::pair<Real, Real> last_legendre(std::size_t s, const Real& x) noexcept
{
    Real before = Real(1), last = x;
    for (std::size_t k = 2; k <= s; ++k) {
        const Real next = (Real(2 * k - 1) * x * last - Real(k - 1) * before) / Real(k);
        before = last;
        last = next;
    }
    return {before, last};
}

/// The zeros x of L_s in increasing order, of which there is room for s, by Newton's method from cos(pi (i + 3/4) / (s
/// + 1/2)), every step of which doubles the number of right digits; and 1/(s L_{s-1}(x))^2 (1 - x^2), the weights on an
/// interval of length 1.
template <class Real>
void legendre_nodes(std::span<Real> x, std::span<Real> b) noexcept
{
    const std::size_t s = x.size();
    for (std::size_t i = 0; i < s; ++i) {
        const double angle = (static_cast<double>(i) + 0.75) / (static_cast<double>(s) + 0.5);
        if (2 * i + 1 == s) {
            x[i] = Real(0);
        } else if (2 * i + 1 > s) {
            x[i] = -x[s - 1 - i];
        } else {
            x[i] = Real(-std::cos(3.141592653589793 * angle));
            for (int step = 0; step < 10; ++step) {
                const auto [before, last] = last_legendre(s, x[i]);
                x[i] -= last * (x[i] * x[i] - Real(1)) / (Real(s) * (x[i] * last - before));
            }
        }
        const Real slope = Real(s) * last_legendre(s, x[i]).first;
        b[i] = (Real(1) - x[i] * x[i]) / (slope * slope);
    }
}

/// Rounded so that b_i = b_{s-1-i} and their sum is exactly 1: whole numbers of units of the last place of 1/2.
template <class Real, std::size_t s, class Wide>
std::array<Real, s> rounded_weights(const std::array<Wide, s>& b) noexcept
{
    std::array<Real, s> result{};
    const Real half = Real(1) / Real(2);
    Real rest = half;
    for (std::size_t i = 0; i < s / 2; ++i) {
        const Real inner = Real(Real(b[i]) + half) - half;
        result[i] = result[s - 1 - i] = s % 2 == 0 && i + 1 == s / 2 ? rest : inner;
        rest -= result[i];
    }
    if (s % 2 != 0) result[s / 2] = rest + rest;
    return result;
}

/// The coefficients of the nodes (1 + x_i) / 2, x the zeros of L_s in increasing order:
///   mu_ij = 1/2 + 1/2 sum_{k=1}^{s-1} (L_k(x_i) L_{k-1}(x_j) - L_{k-1}(x_i) L_k(x_j))
/// [Hairer, Wanner IV.5, W-transformation]. For i > j it lies between 1/2 and 2, so that mu_ji = 1 - mu_ij is exact.
template <class Real, std::size_t s>
Collocation<Real, s> gauss_coefficients() noexcept
{
    using Wide = Wider<Real>;
    std::array<Wide, s> x{}, b{};
    legendre_nodes<Wide>(x, b);
    Collocation<Real, s> method;
    method.b = rounded_weights<Real>(b);
    for (std::size_t i = 0; i < s; ++i) {
        method.c[i] = static_cast<Real>((Wide(1) + x[i]) / Wide(2));
        method.mu[i][i] = Real(1) / Real(2);
        const auto at_i = legendre<s>(x[i]);
        for (std::size_t j = 0; j < i; ++j) {
            const auto at_j = legendre<s>(x[j]);
            Wide sum = Wide(1);
            for (std::size_t k = 1; k < s; ++k) sum += at_i[k] * at_j[k - 1] - at_i[k - 1] * at_j[k];
            method.mu[i][j] = static_cast<Real>(sum / Wide(2));
            method.mu[j][i] = Real(1) - method.mu[i][j];
        }
    }
    return method;
}

/// Close to the zeros of Gauss' denominators, real ones first, one of each conjugate pair.
template <std::size_t s>
inline constexpr std::array<Complex<double>, 0> gauss_poles{};
template <>
inline constexpr std::array<Complex<double>, 1> gauss_poles<1>{{{2, 0}}};
template <>
inline constexpr std::array<Complex<double>, 1> gauss_poles<2>{{{3, 1.73}}};
template <>
inline constexpr std::array<Complex<double>, 2> gauss_poles<3>{{{4.64, 0}, {3.68, 3.51}}};
template <>
inline constexpr std::array<Complex<double>, 2> gauss_poles<4>{{{4.21, 5.31}, {5.79, 1.73}}};
template <>
inline constexpr std::array<Complex<double>, 3> gauss_poles<6>{{{5.03, 8.99}, {7.47, 5.25}, {8.5, 1.73}}};
template <>
inline constexpr std::array<Complex<double>, 4> gauss_poles<8>{
    {{5.68, 12.71}, {8.74, 8.83}, {10.41, 5.23}, {11.18, 1.73}}};

/// Gauss' method with s stages, order 2 s. `denominator` is that of the stability function, a multiple of
/// det(1 - z A) by rising powers of z: (-1)^k (2 s - k)! / (k! (s - k)!). `poles` are close to its zeros.
template <std::size_t s>
struct GaussScheme {
    static constexpr std::size_t stages = s, real_poles = s % 2;
    static constexpr int order = 2 * static_cast<int>(s);
    static constexpr bool stiffly_accurate = false;
    static constexpr auto poles = gauss_poles<s>;
    static constexpr std::array<int, s + 1> denominator = [] {
        std::array<int, s + 1> all{};
        std::int64_t entry = s % 2 == 0 ? 1 : -1, degree = s;
        for (std::int64_t k = degree; k >= 0; --k) {
            all[static_cast<std::size_t>(k)] = static_cast<int>(entry);
            entry = -entry * k * (2 * degree - k + 1) / (degree - k + 1);
        }
        return all;
    }();

    template <class Real>
    static Collocation<Real, s> coefficients() noexcept
    {
        return gauss_coefficients<Real, s>();
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
