// SPDX-License-Identifier: MIT
/// Newton's method for the few unknowns of a generated kernel (the velocities of a Legendre transform, the controls of
/// a Hamiltonian), to round-off, without allocation: damped steps, and where they do not lead to the root the path.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen/linear.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace lagen::detail {

// What the iterations of newton() know of a point, and masks of lanes.

[[nodiscard]] inline bool none(bool mask) noexcept
{
    return !mask;
}

template <class Mask>
[[nodiscard]] bool none(const Mask& mask) noexcept
{
    return !any(mask);
}

// Of masks, a bool or one a lane; both operands are computed.
template <class Mask>
[[nodiscard]] Mask both(const Mask& a, const Mask& b) noexcept
{
    return a & b;
}

template <class Mask>
[[nodiscard]] Mask either(const Mask& a, const Mask& b) noexcept
{
    return a | b;
}

/// The largest |x_i|; NaN where one of them is NaN.
template <class S, std::size_t N>
[[nodiscard]] S largest_of(const std::array<S, N>& x) noexcept
{
    using std::abs;
    S largest(0);
    for (const S& entry : x) {
        const S size = abs(entry);
        largest = select(size <= largest, largest, size); // a NaN is not <= anything: it is taken, and kept
    }
    return largest;
}

/// F and its derivatives at z; the sizes of its terms where the function answers them, else they stay.
template <class S, std::size_t N, std::size_t M, class Function>
void call_with_sizes(const Function& function, const std::array<S, N>& z, std::array<S, N>& residual,
                     std::array<S, M>& derivative, std::array<S, N>& size) noexcept
{
    if constexpr (std::is_invocable_v<const Function&, const std::array<S, N>&, std::array<S, N>&, std::array<S, M>&,
                                      std::array<S, N>&>)
        function(z, residual, derivative, size);
    else
        function(z, residual, derivative);
}

/// F, its Jacobian and the sizes of its terms, 0 where the function does not answer them.
template <class S, std::size_t N>
struct NewtonValues {
    std::array<S, N> residual{}, size{};
    std::array<S, N * N> jacobian{};

    template <class Function>
    void evaluate(const Function& function, const std::array<S, N>& z) noexcept
    {
        call_with_sizes(function, z, residual, jacobian, size);
    }

    /// Those of `other` where the mask holds.
    void take(const typename StatusOf<S>::mask& where, const NewtonValues& other) noexcept
    {
        for (std::size_t k = 0; k < N; ++k) {
            residual[k] = select(where, other.residual[k], residual[k]);
            size[k] = select(where, other.size[k], size[k]);
        }
        for (std::size_t k = 0; k < N * N; ++k) jacobian[k] = select(where, other.jacobian[k], jacobian[k]);
    }

    [[nodiscard]] typename StatusOf<S>::mask is_finite() const noexcept
    {
        const S most(std::numeric_limits<real_t<S>>::max());
        return both<typename StatusOf<S>::mask>(largest_of(residual) <= most, largest_of(jacobian) <= most);
    }
};

} // namespace lagen::detail

namespace lagen {

// Newton's method damped by the natural monotonicity test [Deuflhard 2004, section 2.1], to round-off. On packs every
// lane goes its own way, by selection. Unknowns may have different units: what counts as round-off is decided for
// every equation, or every unknown, by itself.

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

// The Newton path from a guess to a root [Deuflhard 2004, section 3.1]. Where F is the gradient of a convex function
// that grows without bound towards the ends of its convex domain, it leads to the root inside that domain.

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

/// NaN in the residual where a condition is not positive: no solution is there.
template <class S, std::size_t M, std::size_t N>
void require_positive(const std::array<S, M>& conditions, std::array<S, N>& residual) noexcept
{
    for (const S& condition : conditions)
        residual[0] = select(condition > S(0), residual[0], S(std::numeric_limits<real_t<S>>::quiet_NaN()));
}

namespace detail {

/// The iteration of newton(): damped steps; where they do not converge the path, and damped steps from its end.
template <class S, std::size_t N, class Function>
[[nodiscard]] typename StatusOf<S>::mask solve_by_newton(std::array<S, N>& z, const Function& function) noexcept
{
    using Mask = typename StatusOf<S>::mask;
    const std::array<S, N> guess = z;
    NewtonValues<S, N> start;
    start.evaluate(function, guess);
    PivotedLu<S, static_cast<int>(N)> first;
    const Mask singular = first.factor(start.jacobian);
    const S most = largest_of(first.solve(start.residual));
    Mask converged = largest_of(start.residual) <= S(0);
    const Mask starts = both<Mask>(start.is_finite() & !singular, most <= S(std::numeric_limits<real_t<S>>::max()));
    const Mask open = starts & !converged;
    if (none(open)) return converged;
    converged = converged | DampedNewton<S, N, Function>(z, function, first, most).run(open, start);
    const Mask stuck = open & !converged;
    if (none(stuck)) return converged;
    NewtonPath<S, N, Function>(z, function, first, most).run(stuck, guess, start);
    return converged | DampedNewton<S, N, Function>(z, function, first, most).run(stuck, start);
}

} // namespace detail

/// Solves F(z) = 0 from the guess in `z`.
/// @param function function(z, residual, jacobian): F (N entries) and dF/dz (N * N entries by rows) at z; or
///        function(z, residual, jacobian, size), with the rounding error of each F_i in units of epsilon
/// @return newton_diverged, a lane, where no z was found to round-off: then z is NaN. Convergence is declared where
///         undamped steps have got shorter down to the last places, or no damped one gets shorter any more, and
///         - every row is a rounding error of its own terms, |F_i| <= 4 epsilon sum_j |dF_i/dz_j| |z_j| or 4 epsilon
///           size_i, zero included (the componentwise backward error [Oettli, Prager 1964]), or
///         - the step changes every unknown by a rounding error, |dz_k| <= 4 epsilon |z_k|, or
///         - F is not computed to its last places, and only that error is left: |F_i| <= 16 epsilon size_i in every row
///           (sqrt(epsilon) sum_j |dF_i/dz_j| |z_j| where no size is answered), a hundredth of F at the guess or less
///           (in the metric of the Jacobian there), and a step of sqrt(epsilon) |z| or less.
template <class S, std::size_t N, class Function>
[[nodiscard]] status_t<S> newton(std::array<S, N>& z, const Function& function) noexcept
{
    const auto converged = detail::solve_by_newton(z, function);
    auto status = StatusOf<S>::good();
    StatusOf<S>::fail(status, !converged, Status::newton_diverged);
    for (S& entry : z) entry = select(converged, entry, S(std::numeric_limits<real_t<S>>::quiet_NaN()));
    return status;
}

} // namespace lagen
