// SPDX-License-Identifier: MIT
/// Newton's method for the few unknowns of a generated kernel (the velocities of a Legendre transform, the controls of
/// a Hamiltonian): damped by the natural monotonicity test [Deuflhard 2004, section 2.1], to round-off, without
/// allocation. On packs every lane goes its own way, by selection.
/// Unknowns may have different units: what counts as round-off is decided for every equation, or every unknown, by
/// itself.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen/linear.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen {

/// Most Newton steps (to creep up to a root beside a singularity takes one for every halving of the distance), most
/// halvings of one of them, and how often undamped ones get no shorter where nothing but round-off is left.
constexpr int newton_steps = 200;
constexpr int newton_halvings = 40;
constexpr int newton_patience = 3;

namespace detail {

[[nodiscard]] inline bool none(bool mask) noexcept
{
    return !mask;
}

template <class Mask>
[[nodiscard]] bool none(const Mask& mask) noexcept
{
    return !any(mask);
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

/// Which unknowns get nearer no more: newton_patience undamped steps were no shorter than the one before, and none less
/// than half as long as the shortest. (A step that leads too close to a singularity is followed by steps that get
/// shorter all the way, if slowly; round-off goes up and down.)
template <class S, std::size_t N>
class Stagnation {
  public:
    using Mask = typename StatusOf<S>::mask;

    /// After a step `from` whose successor (with the same Jacobian) is `to`; where it does not count, all begins anew.
    void look(Mask counts, const std::array<S, N>& from, const std::array<S, N>& to) noexcept
    {
        using std::abs;
        for (std::size_t k = 0; k < N; ++k) {
            const S size = abs(from[k]), next = abs(to[k]);
            const S length = select(size > S(0), length_[k] * next / size, S(1));
            const Mask goes_on = counts & (length >= S(Real(0.5)));
            const S rounds = rounds_[k] + select(next >= size, S(1), S(0));
            length_[k] = select(goes_on, length, S(1));
            rounds_[k] = select(goes_on, rounds, S(0));
        }
    }

    /// Where every unknown stagnates or has a `step` of rounding size.
    [[nodiscard]] Mask is_complete(const std::array<S, N>& step, const std::array<S, N>& z, const S& tight) noexcept
    {
        using std::abs;
        Mask complete = S(0) <= S(0);
        for (std::size_t k = 0; k < N; ++k) {
            const Mask wanders = rounds_[k] >= S(newton_patience), rests = abs(step[k]) <= tight * abs(z[k]);
            complete = complete & (wanders | rests);
        }
        return complete;
    }

  private:
    using Real = real_t<S>;
    std::array<S, N> length_ = ones(); ///< of the last step, in units of the shortest
    std::array<S, N> rounds_{};

    static std::array<S, N> ones() noexcept
    {
        std::array<S, N> values;
        values.fill(S(1));
        return values;
    }
};

/// The iteration of newton().
template <class S, std::size_t N, class Function>
class NewtonIteration {
  public:
    using Mask = typename StatusOf<S>::mask;

    NewtonIteration(std::array<S, N>& z, const Function& function) noexcept : z_(z), function_(function) {}

    /// Where it has converged.
    [[nodiscard]] Mask run() noexcept
    {
        function_(z_, residual_, jacobian_);
        for (int count = 0; count < newton_steps && !none(active_); ++count) {
            judge_rows();
            const Mask regular = !lu_.factor(jacobian_);
            step_ = lu_.solve(residual_);
            before_ = select(length_ <= S(Real(0.25)) * before_, S(Real(0.25)) * before_, length_);
            length_ = largest_of(step_);
            done_ = active_ & (done_ | (regular & is_within(step_, S(tight()))));
            // A step that is not finite leads nowhere.
            active_ = active_ & (done_ | (regular & (length_ <= S(largest))));
            search();
            move();
        }
        return converged_;
    }

  private:
    using Real = real_t<S>;
    static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
    static constexpr Real largest = std::numeric_limits<Real>::max();

    /// |F_i| against sum_j |dF_i/dz_j| |z_j|, row by row: `done_` where every row is a rounding error of its own terms
    /// [Oettli, Prager 1964], `close_` where it is small against them.
    void judge_rows() noexcept
    {
        using std::abs;
        using std::sqrt;
        done_ = close_ = S(0) <= S(0);
        for (std::size_t i = 0; i < N; ++i) {
            S terms(0);
            for (std::size_t j = 0; j < N; ++j) terms += abs(jacobian_[i * N + j]) * abs(z_[j]);
            const S size = abs(residual_[i]);
            const Mask finite = terms <= S(largest);
            const Mask zero = size <= S(0);
            done_ = done_ & (zero | (finite & (size <= S(tight()) * terms)));
            close_ = close_ & (zero | (finite & (size <= S(sqrt(epsilon)) * terms)));
        }
    }

    static Real tight() noexcept { return Real(4) * epsilon; }

    /// Where a step changes every unknown by `share` of it at most.
    [[nodiscard]] Mask is_within(const std::array<S, N>& step, const S& share) const noexcept
    {
        using std::abs;
        Mask all = S(0) <= S(0);
        for (std::size_t k = 0; k < N; ++k) all = all & (abs(step[k]) <= share * abs(z_[k]));
        return all;
    }

    /// The trial point where `where` holds, F there, and the length of the step from it with the old Jacobian.
    void try_at(Mask where, const S& damping) noexcept
    {
        for (std::size_t k = 0; k < N; ++k) trial_[k] = select(where, z_[k] - damping * step_[k], trial_[k]);
        function_(trial_, next_residual_, jacobian_);
        next_ = lu_.solve(next_residual_);
        next_length_ = largest_of(next_);
    }

    /// Finds the longest damped step that shortens the next one. Near a root an undamped step need not: there one that
    /// is not much worse than the last ones, or that no damped one is better than, is taken; it may be round-off
    /// that compares them.
    void search() noexcept
    {
        damping_ = S(1);
        trial_ = z_;
        Mask searching = active_;
        const S tolerable = S(16) * select(length_ <= before_, before_, length_);
        for (int halving = 0; halving <= newton_halvings && !none(searching); ++halving) {
            try_at(searching, damping_);
            const S bound = (S(1) - S(Real(0.25)) * damping_) * length_ + S(epsilon) * largest_of(trial_);
            Mask good = next_length_ <= bound;
            if (halving == 0) good = good | done_ | (close_ & (next_length_ <= tolerable));
            const Mask worse = !good;
            searching = searching & worse;
            damping_ = select(searching, S(Real(0.5)) * damping_, damping_);
        }
        const Mask forced = searching & close_;
        if (!none(forced)) {
            damping_ = select(forced, S(1), damping_);
            try_at(forced, damping_);
            const Mask bad = !(close_ & (next_length_ <= S(largest)));
            searching = searching & bad;
        }
        const Mask found = !searching;
        active_ = active_ & found;
    }

    void move() noexcept
    {
        const Mask undamped = active_ & close_ & (damping_ >= S(1));
        stagnation_.look(undamped, step_, next_);
        // Beside a singularity the last places may still be some steps away, each shorter than the one before.
        const Mask falls = next_length_ <= S(Real(0.75)) * length_;
        const Mask at_last_places = is_within(step_, S(epsilon)), near = is_within(next_, S(epsilon / Real(4)));
        const Mask far = !(at_last_places | near);
        const Mask ends = !(falls & far);
        const Mask unfinished = !done_;
        const Mask stagnates = undamped & unfinished & stagnation_.is_complete(step_, z_, S(tight()));
        done_ = active_ & (done_ | stagnates);
        // The last step is taken where it does not lead away again (out of the domain, for one).
        const Mask open = !done_;
        const Mask moves = active_ & (open | (next_length_ <= length_));
        for (std::size_t k = 0; k < N; ++k) {
            z_[k] = select(moves, trial_[k], z_[k]);
            residual_[k] = select(moves, next_residual_[k], residual_[k]);
        }
        converged_ = converged_ | done_;
        const Mask goes_on = !(done_ & (ends | stagnates));
        active_ = active_ & goes_on;
    }

    std::array<S, N>& z_;
    const Function& function_;
    std::array<S, N> residual_{}, step_{}, trial_{}, next_residual_{}, next_{};
    std::array<S, N * N> jacobian_{};
    PivotedLu<S, static_cast<int>(N)> lu_;
    Stagnation<S, N> stagnation_;
    S length_ = S(0), before_ = S(0), next_length_ = S(0), damping_ = S(1);
    Mask active_ = S(0) <= S(0), converged_ = S(1) < S(0);
    Mask done_ = S(1) < S(0), close_ = S(1) < S(0);
};

} // namespace detail

/// Solves F(z) = 0 from the guess in `z`.
/// @param function function(z, residual, jacobian): F (N entries) and dF/dz (N * N entries by rows) at z
/// @return newton_diverged, a lane, where no z was found to round-off: then z is NaN. Convergence is declared where
///         - every row is a rounding error of its own terms, |F_i| <= 4 epsilon sum_j |dF_i/dz_j| |z_j|, zero included
///           (the componentwise backward error of the linearised equations [Oettli, Prager 1964]), or
///         - the undamped step changes every unknown by a rounding error, |dz_k| <= 4 epsilon |z_k|, or
///         - |F_i| <= sqrt(epsilon) sum_j |dF_i/dz_j| |z_j| in every row, and undamped steps have not got shorter, for
///           any unknown, newton_patience times: F is not computed to its last places, and only that error is left.
///         A step that has to be damped is never the last one, and steps that still get shorter are made.
template <class S, std::size_t N, class Function>
[[nodiscard]] status_t<S> newton(std::array<S, N>& z, const Function& function) noexcept
{
    detail::NewtonIteration<S, N, Function> iteration(z, function);
    const auto converged = iteration.run();
    auto status = StatusOf<S>::good();
    StatusOf<S>::fail(status, !converged, Status::newton_diverged);
    for (S& entry : z) entry = select(converged, entry, S(std::numeric_limits<real_t<S>>::quiet_NaN()));
    return status;
}

} // namespace lagen
