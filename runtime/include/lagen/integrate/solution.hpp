// SPDX-License-Identifier: MIT
/// The state of a run at any time of its interval, also after the run: `integrate(.., {.dense = true})`.
#pragma once

#include "lagen/kernel.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace lagen {

/// A polynomial a step, of the degree of the method's dense output or, where that is a shorter step, of the method's
/// order: through d + 1 states at Chebyshev's points (1 - cos(pi k / d)) / 2 of the step, its two ends among them. So
/// it is the method's interpolant up to rounding where that is a polynomial, continuous, and exact at the ends of
/// steps. Where a motion jumps it is the state before the jump.
template <class Real, class State>
class Solution {
  public:
    /// The state at t; NaN outside of [start(), end()] and where nothing was recorded.
    [[nodiscard]] State operator()(const Real& t) const
    {
        if (!empty() && t == ends_.front()) return values_.front();
        if (ends_.size() < 2 || !(before_or_at(ends_.front(), t) && before_or_at(t, ends_.back()))) return nowhere();
        std::size_t first = 0, last = ends_.size() - 1;
        while (last - first > 1) {
            const std::size_t middle = first + (last - first) / 2;
            (before_or_at(t, ends_[middle]) ? last : first) = middle;
        }
        return interpolated(first * degree(), place_of(t, first));
    }

    [[nodiscard]] bool empty() const noexcept { return ends_.empty(); }
    [[nodiscard]] Real start() const noexcept { return empty() ? Real(0) : ends_.front(); }
    [[nodiscard]] Real end() const noexcept { return empty() ? Real(0) : ends_.back(); }
    /// The ends of the steps in the order of the run, the start first.
    [[nodiscard]] const std::vector<Real>& times() const noexcept { return ends_; }

    // ---- for the march ----

    void begin(const Real& t, const State& s, std::size_t degree)
    {
        using std::acos;
        using std::cos;
        const Real pi = acos(Real(-1));
        for (std::size_t k = 0; k <= degree; ++k)
            nodes_.push_back(k == degree ? Real(1) : Real((Real(1) - cos(pi * Real(k) / Real(degree))) / Real(2)));
        nodes_.front() = Real(0);
        ends_.push_back(t);
        values_.push_back(s);
    }

    /// A step that ends at t1; inside(theta) are its states, 0 < theta <= 1. It is `length` long and begins earlier by
    /// `lost` than the last one ended, whose time is rounded.
    template <class Inside>
    void add(const Real& t1, const Real& length, const Real& lost, const Inside& inside)
    {
        for (std::size_t k = 1; k < nodes_.size(); ++k) values_.push_back(inside(nodes_[k]));
        ends_.push_back(t1);
        steps_.push_back({length, lost});
    }

    /// The next step begins at s: a step of no length, within which nothing is asked for.
    void jump(const State& s)
    {
        values_.insert(values_.end(), degree(), s);
        ends_.push_back(ends_.back());
        steps_.push_back({Real(0), Real(0)});
    }

  private:
    struct Step {
        Real length, lost;
    };

    /// Where t is in a step, which goes from 0 to 1; its end is what is nearer to it than the rounding errors of times.
    [[nodiscard]] Real place_of(const Real& t, std::size_t step) const noexcept
    {
        using std::abs;
        const auto& [length, lost] = steps_[step];
        const Real way = abs(Real(ends_[step + 1] - ends_.front())), passed = (t - ends_[step]) + lost;
        const bool ends = abs(Real(passed - length)) <= Real(4) * std::numeric_limits<Real>::epsilon() * way;
        return ends ? Real(1) : Real(passed / length);
    }

    [[nodiscard]] std::size_t degree() const noexcept { return nodes_.size() - 1; }
    [[nodiscard]] bool before_or_at(const Real& a, const Real& b) const noexcept
    {
        return ends_.back() < ends_.front() ? a >= b : a <= b;
    }

    [[nodiscard]] State nowhere() const
    {
        const auto none = typename State::Scalar(std::numeric_limits<Real>::quiet_NaN());
        if constexpr (State::SizeAtCompileTime > 0)
            return State::Constant(none);
        else
            return State::Constant(empty() ? Eigen::Index(0) : values_.front().size(), none);
    }

    /// Lagrange's polynomial of the values from `first` on, in the barycentric form: weights (-1)^k, those of the two
    /// ends halved.
    [[nodiscard]] State interpolated(std::size_t first, const Real& theta) const
    {
        Real denominator = Real(0);
        State sum = State::Zero(values_[first].size());
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Real distance = theta - nodes_[k];
            if (distance == Real(0)) return values_[first + k];
            const Real sign = k % 2 == 0 ? Real(1) : Real(-1), end = k == 0 || k == degree() ? Real(0.5) : Real(1);
            const Real weight = sign * end / distance;
            denominator += weight;
            sum += weight * values_[first + k];
        }
        return sum / denominator;
    }

    std::vector<Real> nodes_, ends_;
    std::vector<Step> steps_;
    std::vector<State> values_; ///< those of the start, then degree() of every step
};

} // namespace lagen
