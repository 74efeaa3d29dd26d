// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method of one order on a model's generated recurrences, with steps by the last two coefficients [Jorba-Zou
/// 2005], as one writes it by hand: sums are plain, no status is kept, and a step is not looked at once it is made.
#pragma once

#include "lagen/series.hpp"

#include <algorithm>
#include <cmath>

namespace plain {

template <class M, int order>
class Taylor {
  public:
    using State = typename M::State;
    static constexpr int n = M::dimension;

    /// From (0, s) to (end, s): the number of steps.
    long run(const M& model, State& s, double end, double tolerance)
    {
        long steps = 0;
        for (double t = 0; t < end; ++steps) {
            (void)model.taylor(t, s, order, x_);
            const double h = std::min(length(s, tolerance), end - t);
            for (int i = 0; i < n; ++i) {
                const auto lane = static_cast<std::size_t>(i);
                double sum = x_[order][lane];
                for (int k = order - 1; k >= 0; --k) sum = x_[k][lane] + h * sum;
                s[i] = sum;
            }
            t += h;
        }
        return steps;
    }

  private:
    [[nodiscard]] double largest(int k) const
    {
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) most = std::max(most, std::abs(x_[k][i]));
        return most;
    }

    [[nodiscard]] double length(const State& s, double tolerance) const
    {
        const double size = tolerance * std::max(1.0, s.cwiseAbs().maxCoeff());
        return 0.8 * std::min(std::pow(size / largest(order - 1), 1.0 / (order - 1)),
                              std::pow(size / largest(order), 1.0 / order));
    }

    lagen::TaylorSeries<double, n, order> x_;
};

} // namespace plain
