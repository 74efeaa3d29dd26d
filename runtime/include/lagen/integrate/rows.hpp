// SPDX-License-Identifier: MIT
/// The rows of a run, in the direction of the run: to the observer where it takes them, else into the result.
#pragma once

#include "lagen/integrate/options.hpp"
#include "lagen/lanes/lanes.hpp"

#include <cstddef>

namespace lagen::detail {

template <class M, class Observer>
class Rows {
  public:
    using Real = real_t<typename M::Scalar>;
    using State = typename M::State;

    Rows(std::span<const Real> at, const Interval<Real>& span, Observer& observer)
        : at_(at), span_(span), observer_(observer), forward_(!(span.end - span.start < Real(0)))
    {
    }

    /// Those asked for are in the direction of the run, and none of them is NaN.
    [[nodiscard]] bool are_in_order() const noexcept
    {
        for (std::size_t k = 0; k < at_.size(); ++k) {
            if (at_[k] != at_[k]) return false;
            if (k > 0 && is_after(at_[k - 1], at_[k])) return false;
        }
        return true;
    }

    /// None before the start.
    void begin() noexcept
    {
        while (next_ < at_.size() && is_after(span_.start, at_[next_])) ++next_;
    }

    /// Those at times up to `end`, and behind it by at most `slack`; at(time) points to the state there.
    template <class At>
    void until(const Real& end, const Real& slack, Run<M>& run, const At& at)
    {
        for (; next_ < at_.size(); ++next_) {
            const Real time = at_[next_];
            if (is_after(time, end) && size_of(Real(time - end)) > slack) return;
            if (is_after(time, span_.end)) return;
            put(time, *at(time), run);
        }
    }

    void put(const Real& time, const State& state, Run<M>& run)
    {
        if constexpr (requires { observer_.row(time, state); }) {
            observer_.row(time, state);
        } else {
            run.times.push_back(time);
            run.states.push_back(state);
        }
    }

  private:
    [[nodiscard]] bool is_after(const Real& a, const Real& b) const noexcept { return forward_ ? a > b : a < b; }

    std::span<const Real> at_;
    Interval<Real> span_;
    Observer& observer_;
    bool forward_;
    std::size_t next_ = 0;
};

} // namespace lagen::detail
