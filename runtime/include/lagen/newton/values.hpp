// SPDX-License-Identifier: MIT
/// What the iterations of newton() know of a point, and masks of lanes.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace lagen::detail {

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
