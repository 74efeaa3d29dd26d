// SPDX-License-Identifier: GPL-2.0-or-later
/// The classical method of order 4 as one writes it by hand: no status is kept, nothing can be asked of it.
#pragma once

namespace plain {

/// n steps of length h from (0, s).
template <class M>
void rk4(const M& model, typename M::State& s, double h, long n)
{
    typename M::State k1, k2, k3, k4, x;
    for (long k = 0; k < n; ++k) {
        const double t = h * static_cast<double>(k);
        (void)model.rhs(t, s, k1);
        for (int i = 0; i < M::dimension; ++i) x[i] = s[i] + h / 2 * k1[i];
        (void)model.rhs(t + h / 2, x, k2);
        for (int i = 0; i < M::dimension; ++i) x[i] = s[i] + h / 2 * k2[i];
        (void)model.rhs(t + h / 2, x, k3);
        for (int i = 0; i < M::dimension; ++i) x[i] = s[i] + h * k3[i];
        (void)model.rhs(t + h, x, k4);
        for (int i = 0; i < M::dimension; ++i) s[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
}

} // namespace plain
