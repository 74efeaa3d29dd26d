// SPDX-License-Identifier: MIT
/// Newton's method for the few unknowns of a generated kernel (the velocities of a Legendre transform, the controls of
/// a Hamiltonian), to round-off, without allocation: damped steps, and where they do not lead to the root the path.
#pragma once

#include "lagen/newton/damped.hpp"
#include "lagen/newton/path.hpp"

namespace lagen {

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
