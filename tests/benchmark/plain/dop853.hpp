// SPDX-License-Identifier: GPL-2.0-or-later
/// DOP853 with step control as one writes it by hand after dop853.f: no status is kept, and values inside a step cannot
/// be asked for.
#pragma once

#include "lagen/integrate/dop853_coefficients.hpp"

#include <algorithm>
#include <cmath>

namespace plain {

/// Weight of K_j in stage i; row 12 is b.
template <std::size_t i, std::size_t j>
inline constexpr double a = lagen::tableau::Dop853::a[i * (i - 1) / 2 + j].head;
template <std::size_t i>
inline constexpr double c = lagen::tableau::Dop853::c[i].head;
template <std::size_t j>
inline constexpr double e3 = lagen::tableau::Dop853::error3[j].head;
template <std::size_t j>
inline constexpr double e5 = lagen::tableau::Dop853::error5[j].head;

/// What a run took.
struct Steps {
    long accepted = 0, rejected = 0;
};

template <class M>
class Dop853 {
  public:
    using State = typename M::State;
    static constexpr int n = M::dimension;

    /// From (0, s) to (end, s1) with first step h; relative and absolute tolerance `tolerance`.
    Steps run(const M& model, State& s, double end, double h, double tolerance)
    {
        Steps steps;
        double t = 0;
        bool rejected = false;
        (void)model.rhs(t, s, k1);
        while (t < end) {
            const bool last = t + 1.01 * h >= end;
            if (last) h = end - t;
            stages(model, t, s, h);
            const double error = measure(s, h, tolerance);
            double factor = std::pow(error, 1.0 / 8) / 0.8;
            if (error > 1) {
                h /= std::min(3.0, factor);
                rejected = true;
                ++steps.rejected;
                continue;
            }
            (void)model.rhs(t + h, s1, k2);
            for (int i = 0; i < n; ++i) k1[i] = k2[i];
            for (int i = 0; i < n; ++i) s[i] = s1[i];
            t = last ? end : t + h;
            factor = std::max(1.0 / 6, std::min(3.0, factor));
            if (rejected && factor < 1) factor = 1;
            h /= factor;
            rejected = false;
            ++steps.accepted;
        }
        return steps;
    }

  private:
    /// Twelve stages and s1. Each array of slopes is used again where its last use was before.
    void stages(const M& f, double t, const State& s, double h)
    {
        for (int i = 0; i < n; ++i) x[i] = s[i] + h * a<1, 0> * k1[i];
        (void)f.rhs(t + c<1> * h, x, k2);
        for (int i = 0; i < n; ++i) x[i] = s[i] + h * (a<2, 0> * k1[i] + a<2, 1> * k2[i]);
        (void)f.rhs(t + c<2> * h, x, k3);
        for (int i = 0; i < n; ++i) x[i] = s[i] + h * (a<3, 0> * k1[i] + a<3, 2> * k3[i]);
        (void)f.rhs(t + c<3> * h, x, k4);
        for (int i = 0; i < n; ++i) x[i] = s[i] + h * (a<4, 0> * k1[i] + a<4, 2> * k3[i] + a<4, 3> * k4[i]);
        (void)f.rhs(t + c<4> * h, x, k5);
        for (int i = 0; i < n; ++i) x[i] = s[i] + h * (a<5, 0> * k1[i] + a<5, 3> * k4[i] + a<5, 4> * k5[i]);
        (void)f.rhs(t + c<5> * h, x, k6);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * (a<6, 0> * k1[i] + a<6, 3> * k4[i] + a<6, 4> * k5[i] + a<6, 5> * k6[i]);
        (void)f.rhs(t + c<6> * h, x, k7);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * (a<7, 0> * k1[i] + a<7, 3> * k4[i] + a<7, 4> * k5[i] + a<7, 5> * k6[i] + a<7, 6> * k7[i]);
        (void)f.rhs(t + c<7> * h, x, k8);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * (a<8, 0> * k1[i] + a<8, 3> * k4[i] + a<8, 4> * k5[i] + a<8, 5> * k6[i] + a<8, 6> * k7[i] +
                               a<8, 7> * k8[i]);
        (void)f.rhs(t + c<8> * h, x, k9);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * (a<9, 0> * k1[i] + a<9, 3> * k4[i] + a<9, 4> * k5[i] + a<9, 5> * k6[i] + a<9, 6> * k7[i] +
                               a<9, 7> * k8[i] + a<9, 8> * k9[i]);
        (void)f.rhs(t + c<9> * h, x, k10);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * (a<10, 0> * k1[i] + a<10, 3> * k4[i] + a<10, 4> * k5[i] + a<10, 5> * k6[i] +
                               a<10, 6> * k7[i] + a<10, 7> * k8[i] + a<10, 8> * k9[i] + a<10, 9> * k10[i]);
        (void)f.rhs(t + c<10> * h, x, k2);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] +
                   h * (a<11, 0> * k1[i] + a<11, 3> * k4[i] + a<11, 4> * k5[i] + a<11, 5> * k6[i] + a<11, 6> * k7[i] +
                        a<11, 7> * k8[i] + a<11, 8> * k9[i] + a<11, 9> * k10[i] + a<11, 10> * k2[i]);
        (void)f.rhs(t + h, x, k3);
        for (int i = 0; i < n; ++i)
            s1[i] = s[i] + h * (a<12, 0> * k1[i] + a<12, 5> * k6[i] + a<12, 6> * k7[i] + a<12, 7> * k8[i] +
                                a<12, 8> * k9[i] + a<12, 9> * k10[i] + a<12, 10> * k2[i] + a<12, 11> * k3[i]);
    }

    /// |h| err5 / sqrt(n (err5^2 + err3^2 / 100)) err5.
    double measure(const State& s, double h, double tolerance) const
    {
        double five = 0, three = 0;
        for (int i = 0; i < n; ++i) {
            const double scale = tolerance + tolerance * std::max(std::abs(s[i]), std::abs(s1[i]));
            const double high = (e5<0> * k1[i] + e5<5> * k6[i] + e5<6> * k7[i] + e5<7> * k8[i] + e5<8> * k9[i] +
                                 e5<9> * k10[i] + e5<10> * k2[i] + e5<11> * k3[i]) /
                                scale;
            const double low = (e3<0> * k1[i] + e3<5> * k6[i] + e3<6> * k7[i] + e3<7> * k8[i] + e3<8> * k9[i] +
                                e3<9> * k10[i] + e3<10> * k2[i] + e3<11> * k3[i]) /
                               scale;
            five += high * high;
            three += low * low;
        }
        const double sum = five + 0.01 * three;
        return sum > 0 ? std::abs(h) * five / std::sqrt(sum * n) : 0;
    }

    State k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, x, s1;
};

} // namespace plain
