// SPDX-License-Identifier: MIT
/// The Stumpff functions c_k(z) = sum_j (-z)^j / (2j+k)!: c_0 = cos sqrt z, c_1 = sin(sqrt z)/sqrt z, hyperbolic for
/// z < 0, entire in z. z c_{k+2} = 1/k! - c_k, c_0^2 + z c_1^2 = 1, c_k' = (k c_{k+2} - c_{k+1})/2.
/// Where |z| is small against k^2 the series serves; beyond, c_1 and c_2 from the half angle (no cancellation at
/// the double zeros of c_2) and the recurrence upwards, which divides its errors by z/k^2. [Stumpff 1959]
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace lagen {

namespace detail {

/// Above this order the terms of the series leave the range of float, which then is computed in double.
inline constexpr int highest_float = 12;

/// Up to this |z| the series of c_k loses no digits, and the recurrence from above may not be used.
[[nodiscard]] constexpr int stumpff_radius(int k) noexcept
{
    return k < 2 ? 1 : k * (k - 1);
}

/// Terms after which the rest of the series of c_k is below 2^-(digits+2) of c_k, |z| <= stumpff_radius(k).
[[nodiscard]] constexpr int stumpff_terms(int k, int digits) noexcept
{
    int count = 0;
    int bits = 0;
    for (double term = 1; bits < digits + 4; ++count) {
        term *= static_cast<double>(stumpff_radius(k)) / ((2.0 * count + k + 1) * (2.0 * count + k + 2));
        for (; term < 0.5; term *= 2) ++bits;
    }
    return count;
}

/// 1/n!, n <= 64 + 2 * terms.
template <class S>
[[nodiscard]] constexpr S inverse_factorial(int n) noexcept
{
    using Wide = std::conditional_t<std::is_floating_point_v<real_t<S>>, long double, S>;
    Wide product(1);
    for (int i = 2; i <= n; ++i) product *= Wide(i);
    const Wide quotient = Wide(1) / product;
    if constexpr (std::is_floating_point_v<real_t<S>>)
        return S(static_cast<real_t<S>>(quotient));
    else
        return quotient;
}

/// 1/n! for n <= last; of built-in scalars from a table.
template <int last, class S>
[[nodiscard]] S inverse_factorial_up_to(int n) noexcept
{
    using T = real_t<S>;
    if constexpr (std::is_floating_point_v<T>) {
        static constexpr auto table = [] {
            std::array<T, static_cast<std::size_t>(last) + 1> values{};
            for (int i = 0; i <= last; ++i) values[static_cast<std::size_t>(i)] = inverse_factorial<T>(i);
            return values;
        }();
        return S(table[static_cast<std::size_t>(n)]);
    } else {
        return inverse_factorial<S>(n);
    }
}

template <int k, class T>
[[nodiscard]] constexpr auto stumpff_coefficients() noexcept
{
    std::array<T, static_cast<std::size_t>(stumpff_terms(k, std::numeric_limits<T>::digits))> result{};
    for (std::size_t j = 0; j < result.size(); ++j) result[j] = inverse_factorial<T>(2 * static_cast<int>(j) + k);
    return result;
}

/// c_k(z) by its series, |z| <= stumpff_radius(k) in every lane.
template <int k, class S>
[[nodiscard]] S stumpff_series(const S& z) noexcept
{
    using T = real_t<S>;
    S sum(1);
    if constexpr (std::is_floating_point_v<T>) {
        static constexpr auto coefficients = stumpff_coefficients<k, T>();
        sum = S(coefficients.back());
        for (std::size_t j = coefficients.size() - 1; j-- > 0;) sum = S(coefficients[j]) - z * sum;
        return sum;
    } else if constexpr (std::numeric_limits<T>::digits > 0) {
        for (int j = stumpff_terms(k, std::numeric_limits<T>::digits); j-- > 0;)
            sum = S(1) - z * sum / S((2 * j + k + 1) * (2 * j + k + 2));
        return sum * inverse_factorial<S>(k);
    } else { // the precision is known at run time only: until nothing changes
        S term(1);
        for (int n = k; n < 100'000; n += 2) {
            term *= -z / S((n + 1) * (n + 2));
            const S next = sum + term;
            if (next == sum) break;
            sum = next;
        }
        return sum * inverse_factorial<S>(k);
    }
}

/// sqrt|z| = root + rest, and the circular or hyperbolic sine and cosine of half of it. |z| >= 1.
template <class S>
struct HalfAngle {
    S root, rest, sine, cosine;

    explicit HalfAngle(const S& z) noexcept
    {
        using std::abs, std::sqrt, std::sin, std::cos, std::sinh, std::cosh;
        const S size = abs(z);
        root = sqrt(size);
        rest = S(0);
        if constexpr (std::is_floating_point_v<S>) rest = std::fma(-root, root, size) / (2 * root);
        const S half = root / S(2);
        const S turn = rest / S(2);
        if (z > S(0)) {
            sine = sin(half) + cos(half) * turn;
            cosine = cos(half) - sin(half) * turn;
        } else {
            // Beyond 25, sinh and cosh are one number, which may be infinite.
            const S s = sinh(half);
            const S c = cosh(half);
            sine = half < S(25) ? S(s + c * turn) : S(s * (S(1) + turn));
            cosine = half < S(25) ? S(c + s * turn) : S(c * (S(1) + turn));
        }
    }
};

template <class S>
[[nodiscard]] S stumpff_closed_0(const S& z) noexcept
{
    using std::abs, std::sqrt, std::sin, std::cos, std::sinh, std::cosh;
    const S size = abs(z);
    const S root = sqrt(size);
    S rest(0);
    if constexpr (std::is_floating_point_v<S>) rest = std::fma(-root, root, size) / (2 * root);
    if (z > S(0)) return cos(root) - sin(root) * rest;
    if (root < S(25)) return cosh(root) + sinh(root) * rest;
    return cosh(root) * (S(1) + rest);
}

/// Orders 1 .. K by the closed forms and the recurrence; `values[k - first]` for those below `end`.
template <int first, std::size_t N, class S>
void stumpff_climb(const S& z, int end, std::array<S, N>& values) noexcept
{
    using std::abs;
    constexpr int last = first + static_cast<int>(N) - 1;
    const auto store = [&](int k, const S& value) {
        if (k >= first && k < end) values[static_cast<std::size_t>(k - first)] = value;
    };
    if constexpr (first == 0)
        if (end > 0) store(0, stumpff_closed_0(z));
    if (last == 0 || end <= 1) return;
    const HalfAngle<S> half(z);
    S odd = S(2) * half.sine * half.cosine * (S(1) - half.rest / half.root) / half.root;
    S even = S(2) * half.sine * half.sine / abs(z);
    store(1, odd);
    store(2, even);
    for (int k = 3; k <= last && k < end; ++k) {
        S& low = k % 2 == 0 ? even : odd;
        low = (inverse_factorial_up_to<last, S>(k - 2) - low) / z;
        store(k, low);
    }
}

/// One order of one lane.
template <int k, class S>
[[nodiscard]] S stumpff_lane(const S& z) noexcept
{
    using std::abs;
    if (abs(z) <= S(stumpff_radius(k))) return stumpff_series<k>(z);
    if constexpr (k == 0) {
        return stumpff_closed_0(z);
    } else {
        using std::abs;
        const HalfAngle<S> half(z);
        S value = k % 2 == 0 ? S(S(2) * half.sine * half.sine / abs(z))
                             : S(S(2) * half.sine * half.cosine * (S(1) - half.rest / half.root) / half.root);
        for (int j = 2 - k % 2; j < k; j += 2) value = (inverse_factorial_up_to<k, S>(j) - value) / z;
        return value;
    }
}

/// The orders first .. last of one lane: the highest two by the series where it serves, those below them by the
/// recurrence downwards, the lowest by closed forms and upwards.
template <int first, int last, class S>
[[nodiscard]] auto stumpff_lanes(const S& z, int low) noexcept
{
    std::array<S, static_cast<std::size_t>(last - first + 1)> values{};
    if (low > first) {
        if constexpr (!is_pack<S>) stumpff_climb<first>(z, low, values);
    }
    if (low <= last) values[static_cast<std::size_t>(last - first)] = stumpff_series<last>(z);
    if constexpr (last > first)
        if (low < last) values[static_cast<std::size_t>(last - 1 - first)] = stumpff_series<last - 1>(z);
    for (int k = last - 2; k >= first && k >= low; --k) {
        const auto at = static_cast<std::size_t>(k - first);
        values[at] = inverse_factorial_up_to<last, S>(k) - z * values[at + 2];
    }
    return values;
}

} // namespace detail

/// c_k(z) to a few units in the last place (of c_k, but for the neighbourhood of the simple zeros of c_0 and c_1, where
/// those of z count). A pack whose lanes are all small takes the series at once, any other goes a lane at a time.
template <int k, class S>
[[nodiscard]] S stumpff(const S& z) noexcept
{
    static_assert(k >= 0 && k <= 64, "the order of a Stumpff function is 0 .. 64");
    if constexpr (std::is_same_v<S, float> && k > detail::highest_float) {
        return static_cast<float>(detail::stumpff_lane<k>(static_cast<double>(z)));
    } else if constexpr (is_pack<S>) {
        using std::abs;
        if constexpr (!std::is_same_v<real_t<S>, float> || k <= detail::highest_float)
            if (all(abs(z) <= S(detail::stumpff_radius(k)))) return detail::stumpff_series<k>(z);
        S result;
        for (int lane = 0; lane < RealOf<S>::lanes; ++lane) result.set(lane, stumpff<k>(z[lane]));
        return result;
    } else {
        return detail::stumpff_lane<k>(z);
    }
}

/// c_first(z), ..., c_last(z) together: one root, one sine and one cosine for all of them.
template <int first, int last, class S>
[[nodiscard]] std::array<S, static_cast<std::size_t>(last - first + 1)> stumpff_orders(const S& z) noexcept
{
    static_assert(first >= 0 && first <= last && last <= 64, "the orders of Stumpff functions are 0 .. 64");
    using std::abs;
    std::array<S, static_cast<std::size_t>(last - first + 1)> result;
    if constexpr (std::is_same_v<S, float> && last > detail::highest_float) {
        const auto values = stumpff_orders<first, last>(static_cast<double>(z));
        for (std::size_t k = 0; k < values.size(); ++k) result[k] = static_cast<float>(values[k]);
        return result;
    } else if constexpr (is_pack<S>) {
        if constexpr (!std::is_same_v<real_t<S>, float> || last <= detail::highest_float)
            if (all(abs(z) <= S(detail::stumpff_radius(first)))) return detail::stumpff_lanes<first, last>(z, first);
        for (int lane = 0; lane < RealOf<S>::lanes; ++lane) {
            const auto values = stumpff_orders<first, last>(z[lane]);
            for (std::size_t k = 0; k < values.size(); ++k) result[k].set(lane, values[k]);
        }
        return result;
    } else {
        int low = first; // the first order whose series serves
        while (low <= last && !(abs(z) <= S(detail::stumpff_radius(low)))) ++low;
        return detail::stumpff_lanes<first, last>(z, low);
    }
}

} // namespace lagen
