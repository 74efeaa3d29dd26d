// SPDX-License-Identifier: MIT
/// The Newton path from a guess to a root [Deuflhard 2004, section 3.1]. Where F is the gradient of a convex function
/// that grows without bound towards the ends of its convex domain, it leads to the root inside that domain.
#pragma once

#include "lagen/linear.hpp"
#include "lagen/newton/values.hpp"

namespace lagen {

/// Most parts of a path.
constexpr int newton_path_parts = 2000;

namespace detail {

/// Follows the Newton path F(z(s)) = (1 - s) F(guess) from s = 0 to 1: where damped steps creep along a singularity, it
/// leads past. Two Newton steps for each part of it, which is as long as they converge.
template <class S, std::size_t N, class Function>
class NewtonPath {
  public:
    using Mask = typename StatusOf<S>::mask;
    using Unknowns = std::array<S, N>;
    using Lu = PivotedLu<S, static_cast<int>(N)>;

    NewtonPath(Unknowns& z, const Function& function, const Lu& first, const S& most) noexcept
        : z_(z), function_(function), first_(first), most_(most)
    {
    }

    /// From `start`, the values at `guess`, for the lanes that are `active`: z as far as the path could be followed,
    /// and its values in `start`.
    void run(const Mask& active, const Unknowns& guess, NewtonValues<S, N>& start) noexcept
    {
        Mask open = active;
        at_ = guess;
        here_ = start;
        start_ = here_.residual;
        Mask singular = lu_.factor(here_.jacobian);
        S part = S(Real(0.25)), done(0);
        for (int count = 0; count < newton_path_parts && !none(open); ++count) {
            const S target = select(done + part >= S(1), S(1), done + part);
            const Mask good = open & !singular & follow(target, target - done);
            for (std::size_t k = 0; k < N; ++k) at_[k] = select(good, trial_[k], at_[k]);
            here_.take(good, there_);
            done = select(good, target, done);
            singular = lu_.factor(here_.jacobian);
            const S longer = select(contraction_ <= S(Real(0.125)), S(4), S(1));
            part = part * select(good, longer, S(Real(0.25)));
            open = open & both<Mask>(done<S(1), done + part> done);
        }
        for (std::size_t k = 0; k < N; ++k) z_[k] = select(active, at_[k], z_[k]);
        start = here_;
    }

  private:
    using Real = real_t<S>;

    /// F - (1 - s) F(guess) at the trial point.
    [[nodiscard]] Unknowns off_path(const NewtonValues<S, N>& values, const S& s) const noexcept
    {
        Unknowns result;
        for (std::size_t k = 0; k < N; ++k) result[k] = values.residual[k] - (S(1) - s) * start_[k];
        return result;
    }

    /// Two Newton steps to the point `s`, `part` ahead: where both shorten the next one, and F comes near.
    [[nodiscard]] Mask follow(const S& s, const S& part) noexcept
    {
        const Unknowns first_step = lu_.solve(off_path(here_, s));
        for (std::size_t k = 0; k < N; ++k) trial_[k] = at_[k] - first_step[k];
        there_.evaluate(function_, trial_);
        const S first_length = largest_of(first_step), second_length = largest_of(lu_.solve(off_path(there_, s)));
        contraction_ = second_length / first_length;
        const Mask shorter = both<Mask>(there_.is_finite(), second_length <= S(Real(0.5)) * first_length);
        if (none(shorter)) return shorter;
        const Mask singular = second_.factor(there_.jacobian);
        const Unknowns second_step = second_.solve(off_path(there_, s));
        for (std::size_t k = 0; k < N; ++k) trial_[k] = trial_[k] - second_step[k];
        there_.evaluate(function_, trial_);
        const Unknowns rest = off_path(there_, s);
        const Mask again =
            largest_of(second_.solve(rest)) <=
            S(Real(0.25)) * largest_of(second_step) + S(std::numeric_limits<Real>::epsilon()) * largest_of(trial_);
        // Into a tube about the path that is as wide as the part is long, or half as far from the path as before.
        const S off = largest_of(first_.solve(rest)), off_here = largest_of(first_.solve(off_path(here_, s - part)));
        const Mask near = either<Mask>(off <= S(Real(0.25)) * part * most_, off <= S(Real(0.5)) * off_here);
        return shorter & !singular & there_.is_finite() & again & near;
    }

    Unknowns& z_;
    const Function& function_;
    const Lu& first_;
    S most_;
    NewtonValues<S, N> here_, there_;
    Unknowns at_{}, trial_{}, start_{};
    Lu lu_, second_;
    S contraction_ = S(0);
};

} // namespace detail

} // namespace lagen
