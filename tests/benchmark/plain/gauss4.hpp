// SPDX-License-Identifier: GPL-2.0-or-later
/// Gauss' method of order 4 as one writes it by hand: simplified Newton iterations with the Jacobian at the beginning
/// of the step until the increments are rounding errors, from the collocation polynomial of the step before. No status
/// is kept, a step that does not converge is not noticed.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace plain {

template <class M>
class Gauss4 {
  public:
    using State = typename M::State;
    static constexpr int n = M::dimension;
    long iterations = 0;

    /// `steps` steps of length h from (0, s).
    void run(const M& model, State& s, double h, long steps)
    {
        State z1, z2;
        for (int i = 0; i < n; ++i) z1[i] = z2[i] = lost[i] = 0;
        for (long k = 0; k < steps; ++k) {
            const double t = h * static_cast<double>(k);
            if (k > 0) predict(z1, z2);
            factor(model, t, s, h);
            solve_stages(model, t, s, h, z1, z2);
            for (int i = 0; i < n; ++i) {
                const double increment = h / 2 * (k1[i] + k2[i]) - lost[i], before = s[i];
                s[i] = before + increment;
                lost[i] = (s[i] - before) - increment;
            }
        }
    }

  private:
    static constexpr double root = 1.7320508075688772935; // sqrt 3
    static constexpr double c1 = 0.5 - root / 6, c2 = 0.5 + root / 6;
    static constexpr double a11 = 0.25, a12 = 0.25 - root / 6, a21 = 0.25 + root / 6, a22 = 0.25;

    /// Z(theta) = z1 l1(theta) + z2 l2(theta), l_i(0) = 0, l_i(c_j) = delta_ij, moved to the next step.
    void predict(State& z1, State& z2) const
    {
        constexpr auto l1 = [](double x) { return x / c1 * (x - c2) / (c1 - c2); };
        constexpr auto l2 = [](double x) { return x / c2 * (x - c1) / (c2 - c1); };
        constexpr double p = l1(1 + c1) - l1(1), q = l2(1 + c1) - l2(1);
        constexpr double u = l1(1 + c2) - l1(1), v = l2(1 + c2) - l2(1);
        for (int i = 0; i < n; ++i) {
            const double first = p * z1[i] + q * z2[i];
            z2[i] = u * z1[i] + v * z2[i];
            z1[i] = first;
        }
    }

    void solve_stages(const M& model, double t, const State& s, double h, State& z1, State& z2)
    {
        // Left and right eigenvectors of A for lambda = 1/4 + i sqrt(3)/12: (1, m), m = (lambda - a11) / a12.
        constexpr double m = (root / 12) / a12; // imaginary
        double before = 1e300;
        State x, r1, r2;
        for (int round = 0; round < 30; ++round) {
            ++iterations;
            for (int i = 0; i < n; ++i) x[i] = s[i] + (z1[i] - lost[i]);
            (void)model.rhs(t + c1 * h, x, k1);
            for (int i = 0; i < n; ++i) x[i] = s[i] + (z2[i] - lost[i]);
            (void)model.rhs(t + c2 * h, x, k2);
            for (int i = 0; i < n; ++i) {
                r1[i] = h * (a11 * k1[i] + a12 * k2[i]) - z1[i];
                r2[i] = h * (a21 * k1[i] + a22 * k2[i]) - z2[i];
            }
            // r = v w + conj(v w) with v = (1, i m): w = (r1 - i r2 / m) / 2.
            for (int i = 0; i < n; ++i) {
                re[i] = r1[i] / 2;
                im[i] = -r2[i] / (2 * m);
            }
            back_substitute();
            double size = 0;
            for (int i = 0; i < n; ++i) {
                const double d1 = 2 * re[i], d2 = -2 * m * im[i];
                z1[i] += d1;
                z2[i] += d2;
                const double step = std::max(std::abs(d1), std::abs(d2));
                size = std::max(size, step / (std::abs(s[i]) + std::abs(z1[i]) + 1e-300));
            }
            if (size == 0 || (size <= 4.5e-16 && 4 * size >= 3 * before)) return;
            before = size;
        }
    }

    /// LU decomposition with partial pivoting of 1 - h lambda J, real and imaginary parts apart.
    void factor(const M& model, double t, const State& s, double h)
    {
        model.jacobian_values(t, s, values);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                a[i][j] = i == j;
                b[i][j] = 0;
            }
        for (std::size_t k = 0; k < values.size(); ++k) {
            a[M::jacobian_rows[k]][M::jacobian_columns[k]] -= h / 4 * values[k];
            b[M::jacobian_rows[k]][M::jacobian_columns[k]] -= h * root / 12 * values[k];
        }
        for (int k = 0; k < n; ++k) {
            int row = k;
            for (int i = k + 1; i < n; ++i)
                if (std::abs(a[i][k]) + std::abs(b[i][k]) > std::abs(a[row][k]) + std::abs(b[row][k])) row = i;
            pivot[k] = row;
            if (row != k)
                for (int j = 0; j < n; ++j) {
                    std::swap(a[k][j], a[row][j]);
                    std::swap(b[k][j], b[row][j]);
                }
            const double square = a[k][k] * a[k][k] + b[k][k] * b[k][k];
            const double u = inverse_re[k] = a[k][k] / square, v = inverse_im[k] = -b[k][k] / square;
            for (int i = k + 1; i < n; ++i) {
                const double p = a[i][k] * u - b[i][k] * v, q = a[i][k] * v + b[i][k] * u;
                a[i][k] = p;
                b[i][k] = q;
                for (int j = k + 1; j < n; ++j) {
                    a[i][j] -= p * a[k][j] - q * b[k][j];
                    b[i][j] -= p * b[k][j] + q * a[k][j];
                }
            }
        }
    }

    void back_substitute()
    {
        for (int k = 0; k + 1 < n; ++k)
            if (pivot[k] != k) {
                std::swap(re[k], re[pivot[k]]);
                std::swap(im[k], im[pivot[k]]);
            }
        for (int i = 1; i < n; ++i)
            for (int j = 0; j < i; ++j) {
                re[i] -= a[i][j] * re[j] - b[i][j] * im[j];
                im[i] -= a[i][j] * im[j] + b[i][j] * re[j];
            }
        for (int j = n; j-- > 0;) {
            const double p = re[j], q = im[j];
            re[j] = p * inverse_re[j] - q * inverse_im[j];
            im[j] = p * inverse_im[j] + q * inverse_re[j];
            for (int i = 0; i < j; ++i) {
                re[i] -= a[i][j] * re[j] - b[i][j] * im[j];
                im[i] -= a[i][j] * im[j] + b[i][j] * re[j];
            }
        }
    }

    State k1, k2, lost;
    std::array<double, M::jacobian_rows.size()> values;
    double a[n][n], b[n][n], inverse_re[n], inverse_im[n], re[n], im[n];
    int pivot[n];
};

} // namespace plain
