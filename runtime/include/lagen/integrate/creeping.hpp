// SPDX-License-Identifier: MIT
/// When an adaptive run gets nowhere: a right-hand side that changes or fails without a pattern has its steps rejected
/// at every length, between lengths that are still accepted.
#pragma once

#include "lagen/requirements.hpp"

#include <cstddef>

namespace lagen::detail {

/// Counts rejected steps and what they bring. Without it such a run would end after Options::max_steps, which may be
/// years.
template <class Real>
class CreepingWatch {
  public:
    static constexpr std::size_t rejections = 10'000;
    static constexpr double share = 1e-4; ///< at this pace an interval takes 10^8 rejections

    explicit CreepingWatch(const Real& start) noexcept : from_(start) {}

    /// After a rejected step at `t` of a run with so many accepted and rejected ones: true where its last `rejections`,
    /// at least one in five of the steps that were tried, covered no more than `share` of the interval's length.
    [[nodiscard]] bool creeps(const Real& t, const Real& length, std::size_t accepted, std::size_t rejected) noexcept
    {
        if (rejected - rejected_ < rejections) return false;
        const Real way = t < from_ ? Real(from_ - t) : Real(t - from_);
        const Real whole = length < Real(0) ? Real(-length) : length;
        const bool slow = accepted - accepted_ <= 4 * rejections && way <= static_cast<Real>(share) * whole;
        from_ = t;
        accepted_ = accepted;
        rejected_ = rejected;
        return slow;
    }

  private:
    Real from_;
    std::size_t accepted_ = 0, rejected_ = 0;
};

} // namespace lagen::detail
