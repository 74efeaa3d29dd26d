// SPDX-License-Identifier: GPL-2.0-or-later
/// What one step of a method does to linear equations, exactly, from the runtime's table of its coefficients:
///   x' = lambda x:     x1 = R(z) x, z = h lambda, with a polynomial R (explicit) or R = P/Q (implicit);
///   x'' = -omega^2 x:  (x1, h v1) = M(u) (x, h v), u = (h omega)^2, of methods that treat x and v differently.
#pragma once

#include "stability/polynomial.hpp"
#include "text/diagnostic.hpp"

#include "lagen/integrate/collocation.hpp"
#include "lagen/integrate/stages.hpp"
#include "lagen/integrate/tableau.hpp"

#include <array>
#include <cmath>

namespace lagen::stability {

inline mpq_class exact(const Fraction& x)
{
    mpq_class value(mpz_class(static_cast<long>(x.numerator)), mpz_class(static_cast<long>(x.denominator)));
    value.canonicalize();
    return value;
}

inline mpq_class exact(const Decimal& x)
{
    const auto head = static_cast<double>(x.value);
    return mpq_class(head) + mpq_class(static_cast<double>(x.value - static_cast<long double>(head)));
}

inline mpq_class exact(const Coefficient& x)
{
    return mpq_class(x.head) + mpq_class(x.tail) + mpq_class(x.rest);
}

/// The stages that make the step, and its weights: row `end` of a where a pair says so, else b.
template <class Tableau>
constexpr std::size_t stages_of_step() noexcept
{
    if constexpr (requires { Tableau::end; }) return Tableau::end;
    return Tableau::stages;
}

template <class Tableau>
mpq_class weight_of_step(std::size_t j)
{
    if constexpr (requires { Tableau::end; })
        return exact(Tableau::a[detail::lower_index(Tableau::end, j)]);
    else
        return exact(Tableau::b[j]);
}

/// R of an explicit method: X_i = 1 + z sum_{j<i} a_ij X_j, R = 1 + z sum_i b_i X_i.
template <class Tableau>
Polynomial explicit_function()
{
    const Polynomial one{1}, z{0, 1}; // named: clang 14 makes a temporary Polynomial{1} of a template the list of one 0
    std::vector<Polynomial> x;
    Polynomial r = one;
    for (std::size_t i = 0; i < stages_of_step<Tableau>(); ++i) {
        Polynomial sum;
        for (std::size_t j = 0; j < i; ++j) sum = sum + exact(Tableau::a[detail::lower_index(i, j)]) * x[j];
        x.push_back(one + z * sum);
        r = r + z * (weight_of_step<Tableau>(i) * x[i]);
    }
    return r;
}

struct StepMatrix {
    Polynomial xx{1}, xv, vx, vv{1}; ///< x1 = xx x + xv (h v), h v1 = vx x + vv (h v)

    [[nodiscard]] Polynomial trace() const { return xx + vv; }
    [[nodiscard]] Polynomial determinant() const { return xx * vv - xv * vx; }
};

/// Of a Nystrom method: X_i = x + c_i h v - u sum_{j<i} abar_ij X_j, and x1, v1 by bbar, b in the same way.
template <class Tableau>
StepMatrix nystrom_matrix()
{
    const Polynomial one{1}, minus_u{0, -1};
    std::vector<std::array<Polynomial, 2>> stages; // what x and h v are multiplied by
    StepMatrix m;
    m.xv = {1};
    for (std::size_t i = 0; i < Tableau::stages; ++i) {
        std::array<Polynomial, 2> stage{one, {exact(Tableau::c[i])}};
        for (std::size_t j = 0; j < i; ++j) {
            const Polynomial weight = exact(Tableau::abar[detail::lower_index(i, j)]) * minus_u;
            for (std::size_t k = 0; k < 2; ++k) stage[k] = stage[k] + weight * stages[j][k];
        }
        m.xx = m.xx + exact(Tableau::bbar[i]) * minus_u * stage[0];
        m.xv = m.xv + exact(Tableau::bbar[i]) * minus_u * stage[1];
        m.vx = m.vx + exact(Tableau::b[i]) * minus_u * stage[0];
        m.vv = m.vv + exact(Tableau::b[i]) * minus_u * stage[1];
        stages.push_back(std::move(stage));
    }
    return m;
}

/// Of drifts x += w h v and kicks h v -= w u x in turn.
template <class Splitting>
StepMatrix splitting_matrix()
{
    StepMatrix m;
    bool kick = Splitting::kick_first;
    for (const Coefficient& weight : Splitting::weights) {
        const Polynomial w{exact(weight)}, wu{0, -exact(weight)};
        if (kick) {
            m.vx = m.vx + wu * m.xx;
            m.vv = m.vv + wu * m.xv;
        } else {
            m.xx = m.xx + w * m.vx;
            m.xv = m.xv + w * m.vv;
        }
        kick = !kick;
    }
    return m;
}

struct RationalFunction {
    Polynomial numerator, denominator;
};

/// R = P/Q of a collocation method. Q is the scheme's own, whose coefficients are whole numbers, P = Q R to its degree
/// with R = 1 + z b (1 + z A 1 + z^2 A^2 1 + ..): whole numbers too, which the coefficients of the scheme give to
/// rounding.
template <class Scheme>
RationalFunction implicit_function()
{
    constexpr std::size_t s = Scheme::stages;
    const auto method = Scheme::template coefficients<long double>();
    std::array<long double, s + 1> series{1};
    std::array<long double, s> power{}; // A^(k-1) 1
    power.fill(1);
    for (std::size_t k = 1; k <= s; ++k) {
        std::array<long double, s> next{};
        for (std::size_t i = 0; i < s; ++i)
            for (std::size_t j = 0; j < s; ++j) next[i] += method.mu[i][j] * method.b[j] * power[j];
        for (std::size_t i = 0; i < s; ++i) series[k] += method.b[i] * power[i];
        power = next;
    }
    RationalFunction r;
    for (std::size_t k = 0; k <= s; ++k) {
        long double sum = 0;
        for (std::size_t j = 0; j <= k; ++j) sum += static_cast<long double>(Scheme::denominator[j]) * series[k - j];
        const long double whole = std::round(sum);
        if (std::abs(sum - whole) > 1e-6L)
            throw InternalError("a stability function that is not made of whole numbers");
        r.numerator.emplace_back(static_cast<double>(whole));
        r.denominator.emplace_back(Scheme::denominator[k]);
    }
    return r;
}

} // namespace lagen::stability
