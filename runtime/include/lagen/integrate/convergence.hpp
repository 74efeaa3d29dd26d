// SPDX-License-Identifier: MIT
/// Decides where an iteration has reached rounding: of the increments of every lane, the sizes so far and what a
/// rounding error of that lane is.
#pragma once

#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagen::detail {

template <class State>
class Convergence {
  public:
    using Real = typename State::Scalar;
    enum class Verdict { goes_on, slow, done, diverged };

    /// With the lanes of `zero`.
    void begin(const State& zero) noexcept { scale = steps_ = relative_ = least_ = rounds_ = zero; }

    /// Before the first increments.
    void start() noexcept
    {
        least_.setConstant(std::numeric_limits<Real>::max());
        rounds_.setZero();
        least_size_ = std::numeric_limits<Real>::max();
        standing_ = 0;
        fast_ = true;
        renew();
    }

    /// The increments before and after are of two Jacobians, and are not compared.
    void renew() noexcept { judged_ = false; }

    /// The largest increment of a lane (or of two) and the largest increment since the iteration's origin; answers the
    /// first relative to what it is a rounding error of.
    template <int width>
    [[gnu::always_inline]] Slice<State, width> note(Eigen::Index lane, const Slice<State, width>& step,
                                                    const Slice<State, width>& reach) noexcept
    {
        // Where everything is zero the quotient is, too.
        const Slice<State, width> least = uniform<State, width>(std::numeric_limits<Real>::min());
        const Slice<State, width> relative = step / (load<width>(scale, lane) + reach + least);
        store(steps_, lane, step);
        store(relative_, lane, relative);
        return relative;
    }

    /// After all lanes were noted, the largest relative increment being `size`. Done where every lane rests, or wanders
    /// while the largest increment stands still; slow where increments that are no rounding errors fall by less than
    /// half; diverged where they do not fall.
    Verdict judge(const Real& size) noexcept
    {
        bool rests = false, wanders = false;
        if (size <= noise_) look(rests, wanders);
        remember();
        standing_ = size < least_size_ ? 0 : standing_ + 1;
        least_size_ = std::min<Real>(size, least_size_);
        if (rests || (wanders && standing_ >= 2)) return Verdict::done;
        if (judged_ && size >= before_ && size > noise_) return Verdict::diverged;
        if (judged_ && size > Real(4) * rounding()) fast_ = size <= slow_rate() * before_;
        const bool slow = judged_ && !fast_ && size > noise_;
        before_ = size;
        judged_ = true;
        return slow ? Verdict::slow : Verdict::goes_on;
    }

    State scale; ///< what increments are rounding errors of, but for how far the iteration has come

  private:
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }
    static Real rounding() noexcept { return Real(2) * epsilon(); }
    static Real slow_rate() noexcept { return Real(0.5); }
    /// epsilon^(5/8), 1.6e-10 in double: increments that stop decreasing below this size are taken for rounding errors
    /// of a right-hand side that is not computed to the last place.
    static Real largest_noise() noexcept
    {
        using std::sqrt;
        const Real half = sqrt(epsilon());
        const Real quarter = sqrt(half);
        return half * sqrt(quarter);
    }

    /// Of all increments (of a lane the largest of its stages):
    ///   `rests` says that they are zero, or a few units of the last place and fell by less than a quarter after a fast
    ///     convergence. (To stop at two units instead saves a tenth of the calls and lets invariants drift: what is
    ///     left of Newton's method's error has a sign.)
    ///   `wanders` says that they do so, or are below noise and reached no new minimum for two rounds: after a slow
    ///     convergence, or with a right-hand side that is not computed to the last place. An oscillation comes close to
    ///     zero in one lane or another: the largest increment has to stand still as well.
    void look(bool& rests, bool& wanders) const noexcept
    {
        rests = wanders = true;
        for_each_lane(scale, [&](Eigen::Index lane) {
            const bool small = steps_[lane] == Real(0) || (relative_[lane] <= rounding() && fast_ &&
                                                           !(Real(4) * steps_[lane] < Real(3) * least_[lane]));
            const bool stands = steps_[lane] >= least_[lane] && rounds_[lane] >= Real(1);
            rests = rests && small;
            wanders = wanders && (small || (stands && relative_[lane] <= noise_));
        });
    }

    /// Keeps the least increment of every lane, and for how many rounds there has been no new one.
    void remember() noexcept
    {
        for_lanes(scale, [&]<int width>(Width<width>, Eigen::Index lane) {
            using Lanes = Slice<State, width>;
            const Lanes step = load<width>(steps_, lane), least = load<width>(least_, lane);
            const Lanes more = load<width>(rounds_, lane) + Real(1);
            store(rounds_, lane, step < least ? uniform<State, width>(Real(0)) : more);
            store(least_, lane, step < least ? step : least);
        });
    }

    State steps_, relative_, least_, rounds_;
    Real noise_ = largest_noise();
    Real before_ = Real(0), least_size_ = Real(0);
    int standing_ = 0;    ///< rounds since the largest increment reached a new minimum
    bool judged_ = false; ///< `before_` may be compared with
    bool fast_ = true;    ///< the increments of this iteration fall well
};

} // namespace lagen::detail
