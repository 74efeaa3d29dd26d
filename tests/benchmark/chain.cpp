// SPDX-License-Identifier: GPL-2.0-or-later
/// The right-hand side of a chain of n pendulums: the generated one beside two written by hand, in one run.
///   tridiagonal   absolute angles: the tensions of the rods solve a tridiagonal system, O(n); with the sines and
///   cosines of
///                 the runtime, all angles at once, and with those of libm
///   dense         absolute angles: L D L^T of the n x n mass matrix, loops of fixed length
/// Compiled by scripts/chain-table with -D HEADER="\"FILE\"", -D CLASS=NAME and -D RELATIVE=0 or 1 (relative angles:
/// the hand-written ones sum the angles and subtract the accelerations). Every call depends on the result of the one
/// before. Prints, as words in a line: ns a call, median of 5 rounds, of the generated, the tridiagonal, the dense and
/// the tridiagonal one with libm; the largest difference of the accelerations, relative to the largest of them, between
/// generated and tridiagonal.
#include HEADER

#include "lagen/sincos.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace {

using Generated = lagen::models::CLASS<double>;
using State = Generated::State;
constexpr int n = Generated::base_dimension;
constexpr bool relative = RELATIVE != 0;
using Vector = std::array<double, n>;

/// Masses 1, rods 1/n, g = 9.81, as models/chain.toml has them; members, so that no compiler folds them.
struct Chain {
    Vector m;
    Vector l;
    double g = 9.81;

    Chain()
    {
        m.fill(1);
        l.fill(1.0 / n);
    }
};

/// Absolute angles and rates.
void absolute(const State& s, Vector& a, Vector& w)
{
    double angle = 0;
    double rate = 0;
    for (int k = 0; k < n; ++k) {
        angle = relative ? angle + s[k] : s[k];
        rate = relative ? rate + s[n + k] : s[n + k];
        a[k] = angle;
        w[k] = rate;
    }
}

void store(const State& s, const Vector& acceleration, State& ds)
{
    for (int k = 0; k < n; ++k) {
        ds[k] = s[n + k];
        ds[n + k] = relative && k > 0 ? acceleration[k] - acceleration[k - 1] : acceleration[k];
    }
}

lagen::SinesCosines<double, n> sines_cosines(const Vector& a)
{
    return lagen::sincos<double, n>(a);
}

lagen::SinesCosines<double, n> libm_sines_cosines(const Vector& a)
{
    lagen::SinesCosines<double, n> result;
    for (int k = 0; k < n; ++k) {
        result.sines[k] = std::sin(a[k]);
        result.cosines[k] = std::cos(a[k]);
    }
    return result;
}

/// T_k (1/m_k + 1/m_(k-1)) - T_(k-1) cos(a_k - a_(k-1)) / m_(k-1) - T_(k+1) cos(a_(k+1) - a_k) / m_k = l_k w_k^2, plus
/// g cos a_1 in the first row; then l_k a_k'' = T_(k+1) sin(a_(k+1) - a_k) / m_k - T_(k-1) sin(a_k - a_(k-1)) /
/// m_(k-1).
template <lagen::SinesCosines<double, n> (&sines)(const Vector&)>
struct Tridiagonal : Chain {
    void rhs(const State& s, State& ds) const
    {
        Vector a, w, d, f, off, side, inverse, T, result;
        absolute(s, a, w);
        const auto [sin_a, cos_a] = sines(a);
        for (int k = 0; k < n; ++k) inverse[k] = 1 / m[k];
        for (int k = 0; k + 1 < n; ++k) {
            off[k] = -(cos_a[k + 1] * cos_a[k] + sin_a[k + 1] * sin_a[k]) * inverse[k];
            side[k] = (sin_a[k + 1] * cos_a[k] - cos_a[k + 1] * sin_a[k]) * inverse[k];
        }
        for (int k = 0; k < n; ++k) {
            d[k] = inverse[k] + (k > 0 ? inverse[k - 1] : 0);
            f[k] = l[k] * w[k] * w[k] + (k == 0 ? g * cos_a[0] : 0);
            if (k == 0) continue;
            const double factor = off[k - 1] / d[k - 1];
            d[k] -= factor * off[k - 1];
            f[k] -= factor * f[k - 1];
        }
        T[n - 1] = f[n - 1] / d[n - 1];
        for (int k = n - 2; k >= 0; --k) T[k] = (f[k] - off[k] * T[k + 1]) / d[k];
        for (int k = 0; k < n; ++k) {
            double force = k == 0 ? -g * sin_a[0] : -T[k - 1] * side[k - 1];
            if (k + 1 < n) force += T[k + 1] * side[k];
            result[k] = force / l[k];
        }
        store(s, result, ds);
    }
};

/// W_ij = l_i l_j cos(a_i - a_j) sum_(k >= max(i, j)) m_k.
struct Dense : Chain {
    void rhs(const State& s, State& ds) const
    {
        Vector a, w, mass, f, d, v;
        std::array<Vector, n> W;
        absolute(s, a, w);
        const auto [sin_a, cos_a] = sines_cosines(a);
        double sum = 0;
        for (int k = n - 1; k >= 0; --k) mass[k] = sum += m[k];
        for (int i = 0; i < n; ++i) {
            f[i] = -g * mass[i] * l[i] * sin_a[i];
            for (int j = 0; j < n; ++j) {
                const double scale = mass[std::max(i, j)] * l[i] * l[j];
                if (j <= i) W[i][j] = scale * (cos_a[i] * cos_a[j] + sin_a[i] * sin_a[j]);
                f[i] -= scale * (sin_a[i] * cos_a[j] - cos_a[i] * sin_a[j]) * w[j] * w[j];
            }
        }
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < j; ++k) v[k] = W[j][k] * d[k];
            d[j] = W[j][j];
            for (int k = 0; k < j; ++k) d[j] -= W[j][k] * v[k];
            const double reciprocal = 1 / d[j];
            for (int i = j + 1; i < n; ++i) {
                double value = W[i][j];
                for (int k = 0; k < j; ++k) value -= W[i][k] * v[k];
                W[i][j] = value * reciprocal;
            }
        }
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < i; ++k) f[i] -= W[i][k] * f[k];
        for (int i = n - 1; i >= 0; --i) {
            f[i] /= d[i];
            for (int k = i + 1; k < n; ++k) f[i] -= W[k][i] * f[k];
        }
        store(s, f, ds);
    }
};

[[gnu::noinline]] void call(const Generated& model, const State& s, State& ds)
{
    (void)model.rhs(0, s, ds);
}
template <lagen::SinesCosines<double, n> (&sines)(const Vector&)>
[[gnu::noinline]] void call(const Tridiagonal<sines>& model, const State& s, State& ds)
{
    model.rhs(s, ds);
}
[[gnu::noinline]] void call(const Dense& model, const State& s, State& ds)
{
    model.rhs(s, ds);
}

State start()
{
    State s;
    for (int k = 0; k < n; ++k) {
        s[k] = relative && k > 0 ? 0.1 : 0.3 + 0.1 * k;
        s[n + k] = 0.2 - 0.05 * (k % 5);
    }
    return s;
}

/// ns a call, each on a state that the call before has touched.
template <class Model>
double time_of(const Model& model, long calls)
{
    const State first = start();
    State s = first;
    State ds;
    const auto begin = std::chrono::steady_clock::now();
    for (long k = 0; k < calls; ++k) {
        call(model, s, ds);
        s = first + 1e-9 * ds;
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    return spent.count() / static_cast<double>(calls);
}

double median(std::array<double, 5> times)
{
    std::ranges::sort(times);
    return times[2];
}

} // namespace

int main()
{
    const Generated generated;
    const Tridiagonal<sines_cosines> tridiagonal;
    const Tridiagonal<libm_sines_cosines> with_libm;
    const Dense dense;
    State one, two;
    call(generated, start(), one);
    call(tridiagonal, start(), two);
    const double difference = (one - two).cwiseAbs().maxCoeff() / two.cwiseAbs().maxCoeff();
    std::array<double, 5> times[4];
    const long calls = 400'000 / n;
    for (std::size_t round = 0; round < 5; ++round) {
        times[0][round] = time_of(generated, calls);
        times[1][round] = time_of(tridiagonal, calls);
        times[2][round] = time_of(dense, calls);
        times[3][round] = time_of(with_libm, calls);
    }
    std::printf("%.1f %.1f %.1f %.1f %.1e\n", median(times[0]), median(times[1]), median(times[2]), median(times[3]),
                difference);
}
