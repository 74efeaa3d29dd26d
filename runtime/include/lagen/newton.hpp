// SPDX-License-Identifier: MIT
/// Newton's method for the few unknowns of a generated kernel (the velocities of a Legendre transform, the controls of
/// a Hamiltonian): damped by the natural monotonicity test [Deuflhard 2004, section 2.1], to round-off, without
/// allocation. On packs every lane goes its own way, by selection.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen/linear.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen {

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

} // namespace detail

/// Most Newton steps, and most halvings of one of them.
constexpr int newton_steps = 100;
constexpr int newton_halvings = 40;

/// Solves F(z) = 0 from the guess in `z`.
/// @param function function(z, residual, jacobian): F (N entries) and dF/dz (N * N entries by rows) at z
/// @return newton_diverged, a lane, where no z was found to round-off: then z is NaN. Convergence is declared where the
///         last step is at most 4 epsilon |z|, or where steps below sqrt(epsilon) |z| do not get smaller any more.
template <class S, std::size_t N, class Function>
[[nodiscard]] status_t<S> newton(std::array<S, N>& z, const Function& function) noexcept
{
    using Mask = typename StatusOf<S>::mask;
    using Real = real_t<S>;
    using std::sqrt;
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    const S tight(Real(4) * epsilon);
    const S loose(sqrt(epsilon));

    std::array<S, N> residual{}, step{}, trial = z, next{}, next_residual{};
    std::array<S, N * N> jacobian{};
    PivotedLu<S, static_cast<int>(N)> lu;
    function(z, residual, jacobian);
    Mask active = S(0) <= S(0);
    Mask converged = S(1) < S(0);
    for (int count = 0; count < newton_steps && !detail::none(active); ++count) {
        const Mask regular = !lu.factor(jacobian);
        active = active & regular;
        step = lu.solve(residual);
        const S length = detail::largest_of(step);
        // A step that is not finite leads nowhere; a lane that stops here has diverged.
        active = active & (length <= S(std::numeric_limits<Real>::max()));
        S damping(1);
        Mask searching = active;
        S next_length = length;
        for (int halving = 0; halving < newton_halvings && !detail::none(searching); ++halving) {
            for (std::size_t i = 0; i < N; ++i) trial[i] = select(searching, z[i] - damping * step[i], trial[i]);
            function(trial, next_residual, jacobian);
            next = lu.solve(next_residual);
            const S simplified = detail::largest_of(next);
            next_length = select(searching, simplified, next_length);
            const S bound = (S(1) - S(Real(0.25)) * damping) * length + loose * loose * detail::largest_of(trial);
            const Mask worse = !(simplified <= bound);
            searching = searching & worse;
            damping = select(searching, S(Real(0.5)) * damping, damping);
        }
        // No shorter step was better: only round-off may be the reason.
        const S size = detail::largest_of(z);
        const Mask stuck = !(next_length <= S(Real(0.5)) * length);
        const Mask done = active & ((length <= tight * size) | ((length <= loose * size) & (searching | stuck)));
        const Mask moved = !searching;
        active = active & moved;
        for (std::size_t i = 0; i < N; ++i) {
            z[i] = select(active, trial[i], z[i]);
            residual[i] = select(active, next_residual[i], residual[i]);
        }
        converged = converged | done;
        const Mask open = !done;
        active = active & open;
    }
    auto status = StatusOf<S>::good();
    StatusOf<S>::fail(status, !converged, Status::newton_diverged);
    for (S& entry : z) entry = select(converged, entry, S(std::numeric_limits<Real>::quiet_NaN()));
    return status;
}

} // namespace lagen
