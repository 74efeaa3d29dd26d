// SPDX-License-Identifier: MIT
/// Newton's method damped by the natural monotonicity test [Deuflhard 2004, section 2.1], to round-off. On packs every
/// lane goes its own way, by selection. Unknowns may have different units: what counts as round-off is decided for
/// every equation, or every unknown, by itself.
#pragma once

#include "lagen/linear.hpp"
#include "lagen/newton/values.hpp"

namespace lagen {

/// Most Newton steps (to creep up to a root beside a singularity takes one for every halving of the distance), most
/// halvings of one of them where F and dF/dz are finite, most reductions of it where they are not (halvings too at
/// first, then to a sixteenth), and how often undamped ones get no shorter where nothing but round-off is left.
constexpr int newton_steps = 200;
constexpr int newton_halvings = 40;
constexpr int newton_reductions = 300;
constexpr int newton_first_reductions = 10;
constexpr int newton_patience = 3;
/// Most damped steps before the path is followed instead.
constexpr int newton_damped = 10;

namespace detail {

/// Damped Newton steps from where the iteration stands.
template <class S, std::size_t N, class Function>
class DampedNewton {
  public:
    using Mask = typename StatusOf<S>::mask;
    using Unknowns = std::array<S, N>;
    using Lu = PivotedLu<S, static_cast<int>(N)>;

    /// `first` is the factorised Jacobian at the guess, and `most` the size of first^-1 F there: lengths in the metric
    /// of the guess, where no singularity hides them.
    DampedNewton(Unknowns& z, const Function& function, const Lu& first, const S& most) noexcept
        : z_(z), function_(function), first_(first), most_(most)
    {
    }

    /// Where it has converged, from the values at z, of the lanes that are `active`; z is not changed elsewhere.
    [[nodiscard]] Mask run(const Mask& active, const NewtonValues<S, N>& values) noexcept
    {
        active_ = active;
        converged_ = S(1) < S(0);
        here_ = values;
        for (int count = 0; count < newton_steps && !none(active_); ++count) {
            judge_rows();
            const Mask regular = !lu_.factor(here_.jacobian);
            step_ = lu_.solve(here_.residual);
            before_ = select(length_ <= S(Real(0.25)) * before_, S(Real(0.25)) * before_, length_);
            length_ = largest_of(step_);
            small_ = regular & is_within(step_, S(tight()));
            converged_ = converged_ | (active_ & zero_);
            // A step that is not finite leads nowhere.
            active_ = active_ & !zero_ & both<Mask>(regular, length_ <= S(largest));
            search();
            move();
        }
        return converged_;
    }

  private:
    using Real = real_t<S>;
    static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
    static constexpr Real largest = std::numeric_limits<Real>::max();

    static Real tight() noexcept { return Real(4) * epsilon; }

    /// |F_i| against sum_j |dF_i/dz_j| |z_j| and the terms of F_i, row by row: `rounding_` where every row is a
    /// rounding error of them [Oettli, Prager 1964], `close_` where it is small against them.
    void judge_rows() noexcept
    {
        using std::abs;
        using std::sqrt;
        rounding_ = close_ = S(0) <= S(0);
        for (std::size_t i = 0; i < N; ++i) {
            S terms(0);
            for (std::size_t j = 0; j < N; ++j) terms += abs(here_.jacobian[i * N + j]) * abs(z_[j]);
            terms = select(terms <= S(largest), terms, S(0));
            const Mask measured = both<Mask>(here_.size[i] > S(0), here_.size[i] <= S(largest));
            const S sizes = select(measured, here_.size[i], S(0));
            const S f = abs(here_.residual[i]);
            const S rounding = S(tight()) * select(terms <= sizes, sizes, terms);
            const S noise = select(measured, S(Real(16) * epsilon) * sizes, S(sqrt(epsilon)) * terms);
            rounding_ = rounding_ & (f <= rounding);
            close_ = close_ & (f <= noise);
        }
        zero_ = largest_of(here_.residual) <= S(0);
        progressed_ = largest_of(first_.solve(here_.residual)) <= S(Real(0.01)) * most_;
    }

    /// Where a step changes every unknown by `share` of it at most.
    [[nodiscard]] Mask is_within(const Unknowns& step, const S& share) const noexcept
    {
        using std::abs;
        Mask all = S(0) <= S(0);
        for (std::size_t k = 0; k < N; ++k) all = all & (abs(step[k]) <= share * abs(z_[k]));
        return all;
    }

    /// The trial point where `where` holds, F there, and the length of the step from it with the old Jacobian.
    void try_at(const Mask& where, const S& damping) noexcept
    {
        for (std::size_t k = 0; k < N; ++k) trial_[k] = select(where, z_[k] - damping * step_[k], trial_[k]);
        there_.evaluate(function_, trial_);
        next_ = lu_.solve(there_.residual);
        next_length_ = largest_of(next_);
    }

    /// Finds a damped step that shortens the next one [Deuflhard 2004, section 2.1], at a point where F and dF/dz are
    /// finite and F is not larger than twice that of the guess. Near a root an undamped step need not shorten the next
    /// one: round-off may be what compares them.
    void search() noexcept
    {
        damping_ = S(1);
        trial_ = z_;
        Mask searching = active_;
        found_ = S(1) < S(0);
        S halvings(0);
        const S tolerable = S(16) * select(length_ <= before_, before_, length_);
        for (int count = 0; count <= newton_reductions && !none(searching); ++count) {
            try_at(searching, damping_);
            const S bound = (S(1) - S(Real(0.25)) * damping_) * length_ + S(epsilon) * largest_of(trial_);
            const Mask finite = both<Mask>(there_.is_finite(), next_length_ <= S(largest));
            const Mask bounded = largest_of(first_.solve(there_.residual)) <= S(2) * most_;
            Mask good = finite & bounded & (next_length_ <= bound);
            if (count == 0) good = good | (finite & (small_ | (close_ & progressed_ & (next_length_ <= tolerable))));
            found_ = found_ | (searching & good);
            halvings = halvings + select(finite, S(1), S(0));
            searching = both<Mask>(searching & !good, halvings <= S(newton_halvings));
            const S share = select(finite, S(Real(0.5)), S(Real(count < newton_first_reductions ? 0.5 : 0.0625)));
            damping_ = select(searching, share * damping_, damping_);
        }
    }

    void move() noexcept
    {
        using std::sqrt;
        const Mask undamped = found_ & (damping_ >= S(1));
        // Beside a singularity the last places may still be some steps away, each shorter than the one before.
        const Mask falls = next_length_ <= S(Real(0.75)) * length_;
        const Mask at_last_places = is_within(step_, S(epsilon)), near = is_within(next_, S(epsilon / Real(4)));
        const Mask far = !(at_last_places | near), goes_on = falls & far;
        const Mask noisy = close_ & progressed_ & (length_ <= S(sqrt(epsilon)) * largest_of(trial_));
        rounds_ = rounds_ + select(undamped & !falls, S(1), S(0));
        const Mask wanders = noisy & (rounds_ >= S(newton_patience));
        const Mask over = !goes_on, ends = undamped & over & (rounding_ | small_ | wanders);
        // Nothing shortens the steps any more: what is left is the error of the computed F.
        const Mask lost = !found_, rests = active_ & lost & (rounding_ | small_ | noisy);
        converged_ = converged_ | ends | rests;
        damped_ = damped_ + select(undamped, S(0), S(1));
        // The last step is taken where it does not lead away again (out of the domain, for one).
        const Mask open = !ends, moves = found_ & (open | (next_length_ <= length_));
        for (std::size_t k = 0; k < N; ++k) z_[k] = select(moves, trial_[k], z_[k]);
        here_.take(moves, there_);
        active_ = both<Mask>(found_ & open, damped_ <= S(newton_damped));
    }

    Unknowns& z_;
    const Function& function_;
    const Lu& first_;
    S most_;
    NewtonValues<S, N> here_, there_;
    Unknowns step_{}, trial_{}, next_{};
    Lu lu_;
    S length_ = S(0), before_ = S(0), next_length_ = S(0), damping_ = S(1), rounds_ = S(0), damped_ = S(0);
    Mask active_ = S(1) < S(0), converged_ = S(1) < S(0), found_ = S(1) < S(0);
    Mask rounding_ = S(1) < S(0), close_ = S(1) < S(0), small_ = S(1) < S(0), zero_ = S(1) < S(0);
    Mask progressed_ = S(1) < S(0);
};

} // namespace detail

} // namespace lagen
