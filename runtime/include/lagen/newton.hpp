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
#include <type_traits>

namespace lagen {

/// Most Newton steps (to creep up to a root beside a singularity takes one for every halving of the distance), most
/// halvings of one of them where F and dF/dz are finite, most reductions of it where they are not (halvings too at
/// first, then to a sixteenth), and how often undamped ones get no shorter where nothing but round-off is left.
constexpr int newton_steps = 200;
constexpr int newton_halvings = 40;
constexpr int newton_reductions = 300;
constexpr int newton_first_reductions = 10;
constexpr int newton_patience = 3;

/// NaN in the residual where a condition is not positive: no solution is there.
template <class S, std::size_t M, std::size_t N>
void require_positive(const std::array<S, M>& conditions, std::array<S, N>& residual) noexcept
{
    for (const S& condition : conditions)
        residual[0] = select(condition > S(0), residual[0], S(std::numeric_limits<real_t<S>>::quiet_NaN()));
}

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
        evaluate(z_, residual_);
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

    void evaluate(const std::array<S, N>& at, std::array<S, N>& residual) noexcept
    {
        if constexpr (std::is_invocable_v<const Function&, const std::array<S, N>&, std::array<S, N>&,
                                          std::array<S, N * N>&, std::array<S, N>&>)
            function_(at, residual, jacobian_, size_);
        else
            function_(at, residual, jacobian_);
    }

    /// |F_i| against sum_j |dF_i/dz_j| |z_j| and the terms of F_i, row by row: `done_` where every row is a rounding
    /// error of them [Oettli, Prager 1964], `close_` where it is small against them.
    void judge_rows() noexcept
    {
        using std::abs;
        using std::sqrt;
        done_ = close_ = S(0) <= S(0);
        for (std::size_t i = 0; i < N; ++i) {
            S terms(0);
            for (std::size_t j = 0; j < N; ++j) terms += abs(jacobian_[i * N + j]) * abs(z_[j]);
            const S size = abs(residual_[i]);
            const Mask zero = size <= S(0);
            const Mask finite = both<Mask>(terms <= S(largest), size_[i] <= S(largest));
            const Mask done = either<Mask>(size <= S(tight()) * terms, size <= S(tight()) * size_[i]);
            const Mask close = either<Mask>(size <= S(sqrt(epsilon)) * terms, size <= S(Real(16) * epsilon) * size_[i]);
            done_ = done_ & (zero | (finite & done));
            close_ = close_ & (zero | (finite & close));
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
        evaluate(trial_, next_residual_);
        next_ = lu_.solve(next_residual_);
        next_length_ = largest_of(next_);
    }

    /// Finds a damped step that shortens the next one, at a point where F and dF/dz are finite. Near a root an undamped
    /// step need not: there one that is not much worse than the last ones, or that no damped one is better than, is
    /// taken; it may be round-off that compares them.
    void search() noexcept
    {
        damping_ = S(1);
        trial_ = z_;
        Mask searching = active_, found = S(1) < S(0);
        S halvings(0);
        const S tolerable = S(16) * select(length_ <= before_, before_, length_);
        for (int count = 0; count <= newton_reductions && !none(searching); ++count) {
            try_at(searching, damping_);
            const S bound = (S(1) - S(Real(0.25)) * damping_) * length_ + S(epsilon) * largest_of(trial_);
            const Mask finite = both<Mask>(next_length_ <= S(largest), largest_of(jacobian_) <= S(largest));
            Mask good = finite & (next_length_ <= bound);
            if (count == 0) good = good | done_ | (finite & close_ & (next_length_ <= tolerable));
            found = found | (searching & good);
            halvings = halvings + select(finite, S(1), S(0));
            searching = both<Mask>(searching & !good, halvings <= S(newton_halvings));
            const S share = select(finite, S(Real(0.5)), S(Real(count < newton_first_reductions ? 0.5 : 0.0625)));
            damping_ = select(searching, share * damping_, damping_);
        }
        const Mask unsuccessful = !found;
        const Mask forced = active_ & close_ & unsuccessful;
        if (!none(forced)) {
            damping_ = select(forced, S(1), damping_);
            try_at(forced, damping_);
            found = found | both<Mask>(forced, next_length_ <= S(largest));
        }
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
    std::array<S, N> size_{};
    PivotedLu<S, static_cast<int>(N)> lu_;
    Stagnation<S, N> stagnation_;
    S length_ = S(0), before_ = S(0), next_length_ = S(0), damping_ = S(1);
    Mask active_ = S(0) <= S(0), converged_ = S(1) < S(0);
    Mask done_ = S(1) < S(0), close_ = S(1) < S(0);
};

} // namespace detail

/// Solves F(z) = 0 from the guess in `z`.
/// @param function function(z, residual, jacobian): F (N entries) and dF/dz (N * N entries by rows) at z; or
///        function(z, residual, jacobian, size), with the sum of the absolute values of the terms of each F_i
/// @return newton_diverged, a lane, where no z was found to round-off: then z is NaN. Convergence is declared where
///         - every row is a rounding error of its own terms, |F_i| <= 4 epsilon sum_j |dF_i/dz_j| |z_j| or 4 epsilon
///           size_i, zero included (the componentwise backward error [Oettli, Prager 1964]), or
///         - the undamped step changes every unknown by a rounding error, |dz_k| <= 4 epsilon |z_k|, or
///         - |F_i| <= sqrt(epsilon) sum_j |dF_i/dz_j| |z_j| or 16 epsilon size_i in every row, and undamped steps have
///           not got shorter, for any unknown, newton_patience times: F is not computed to its last places, and only
///           that error is left.
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
