// SPDX-License-Identifier: GPL-2.0-or-later
/// The pair 8(6) of Dormand, El-Mikkawy and Prince for x'' = f(t, x) with step control as one writes it by hand: no
/// status is kept, and values inside a step cannot be asked for.
#pragma once

#include "dop853.hpp"

#include "lagen/integrate/rkn86_coefficients.hpp"

namespace plain {

namespace rkn86 {

using Table = lagen::tableau::Rkn86;
template <std::size_t i, std::size_t j>
inline constexpr double p = Table::abar[i * (i - 1) / 2 + j].head;
template <std::size_t i>
inline constexpr double node = Table::c[i].head;
template <std::size_t j>
inline constexpr double x1 = Table::bbar[j].head;
template <std::size_t j>
inline constexpr double v1 = Table::b[j].head;
template <std::size_t j>
inline constexpr double ex = Table::error_bar[j].head;
template <std::size_t j>
inline constexpr double ev = Table::error[j].head;

} // namespace rkn86

template <class M>
class Rkn86 {
  public:
    using State = typename M::State;
    static constexpr int n = M::dimension / 2;

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
            double factor = std::pow(error, 1.0 / 7) / 0.8;
            if (error > 1) {
                h /= std::min(5.0, factor);
                rejected = true;
                ++steps.rejected;
                continue;
            }
            for (int i = 0; i < n; ++i) k1[n + i] = k9[n + i];
            for (int i = 0; i < 2 * n; ++i) s[i] = y[i];
            t = last ? end : t + h;
            factor = std::max(0.1, std::min(5.0, factor));
            if (rejected && factor < 1) factor = 1;
            h /= factor;
            rejected = false;
            ++steps.accepted;
        }
        return steps;
    }

  private:
    void stages(const M& f, double t, const State& s, double h)
    {
        using namespace rkn86;
        const double g = h * h;
        const auto rate = [&](int i) { return s[n + i]; };
        for (int i = 0; i < n; ++i) x[n + i] = rate(i);
        for (int i = 0; i < n; ++i) x[i] = s[i] + node<1> * h * rate(i) + g * (p<1, 0> * k1[n + i]);
        (void)f.rhs(t + node<1> * h, x, k2);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + node<2> * h * rate(i) + g * (p<2, 0> * k1[n + i] + p<2, 1> * k2[n + i]);
        (void)f.rhs(t + node<2> * h, x, k3);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + node<3> * h * rate(i) + g * (p<3, 0> * k1[n + i] + p<3, 1> * k2[n + i] + p<3, 2> * k3[n + i]);
        (void)f.rhs(t + node<3> * h, x, k4);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + node<4> * h * rate(i) +
                   g * (p<4, 0> * k1[n + i] + p<4, 1> * k2[n + i] + p<4, 2> * k3[n + i] + p<4, 3> * k4[n + i]);
        (void)f.rhs(t + node<4> * h, x, k5);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + node<5> * h * rate(i) +
                   g * (p<5, 0> * k1[n + i] + p<5, 1> * k2[n + i] + p<5, 2> * k3[n + i] + p<5, 3> * k4[n + i] +
                        p<5, 4> * k5[n + i]);
        (void)f.rhs(t + node<5> * h, x, k6);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + node<6> * h * rate(i) +
                   g * (p<6, 0> * k1[n + i] + p<6, 1> * k2[n + i] + p<6, 2> * k3[n + i] + p<6, 3> * k4[n + i] +
                        p<6, 4> * k5[n + i] + p<6, 5> * k6[n + i]);
        (void)f.rhs(t + node<6> * h, x, k7);
        for (int i = 0; i < n; ++i)
            x[i] = s[i] + h * rate(i) +
                   g * (p<7, 0> * k1[n + i] + p<7, 1> * k2[n + i] + p<7, 2> * k3[n + i] + p<7, 3> * k4[n + i] +
                        p<7, 4> * k5[n + i] + p<7, 5> * k6[n + i] + p<7, 6> * k7[n + i]);
        (void)f.rhs(t + h, x, k8);
        for (int i = 0; i < n; ++i) {
            y[i] = s[i] + h * rate(i) +
                   g * (x1<0> * k1[n + i] + x1<2> * k3[n + i] + x1<3> * k4[n + i] + x1<4> * k5[n + i] +
                        x1<5> * k6[n + i] + x1<6> * k7[n + i]);
            y[n + i] = rate(i) + h * (v1<0> * k1[n + i] + v1<2> * k3[n + i] + v1<3> * k4[n + i] + v1<4> * k5[n + i] +
                                      v1<5> * k6[n + i] + v1<6> * k7[n + i] + v1<7> * k8[n + i]);
        }
        (void)f.rhs(t + h, y, k9);
    }

    [[nodiscard]] double measure(const State& s, double h, double tolerance) const
    {
        using namespace rkn86;
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const double dx = h * h *
                              (ex<0> * k1[n + i] + ex<2> * k3[n + i] + ex<3> * k4[n + i] + ex<4> * k5[n + i] +
                               ex<5> * k6[n + i] + ex<6> * k7[n + i]);
            const double dv = h * (ev<0> * k1[n + i] + ev<2> * k3[n + i] + ev<3> * k4[n + i] + ev<4> * k5[n + i] +
                                   ev<5> * k6[n + i] + ev<6> * k7[n + i] + ev<7> * k8[n + i] + ev<8> * k9[n + i]);
            const double rx = dx / (tolerance + tolerance * std::max(std::abs(s[i]), std::abs(y[i])));
            const double rv = dv / (tolerance + tolerance * std::max(std::abs(s[n + i]), std::abs(y[n + i])));
            sum += rx * rx + rv * rv;
        }
        return std::sqrt(sum / (2 * n));
    }

    State x, y, k1, k2, k3, k4, k5, k6, k7, k8, k9;
};

} // namespace plain
