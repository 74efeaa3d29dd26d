// SPDX-License-Identifier: MIT
/// Controls that a generated kernel follows along a run: angles that maximise H in closed form, and the watch over
/// stationary controls of which no maximum is proved. Any scalar; on packs every lane goes its own way, by selection.
#pragma once

#include "lagen/newton.hpp"

namespace lagen {

/// At how many points, its end included, the way from one maximum to the next is looked at.
constexpr int controls_points = 8;

/// `value`, or `otherwise` where that is NaN.
template <class S>
[[nodiscard]] S number_or(const S& value, const S& otherwise) noexcept
{
    return select(detail::is_number(value), value, otherwise);
}

/// The angles that maximise a + sum_k (b_k cos u_k + c_k sin u_k):
///   cos u_k = b_k / sqrt(b_k^2 + c_k^2),   sin u_k = c_k / sqrt(b_k^2 + c_k^2),
/// each as near as can be to the one in `u`: within half a turn.
/// @return singular_control, a lane, where b_k = c_k = 0, so that each u_k is a maximum: then it is NaN.
template <class S, std::size_t N>
[[nodiscard]] status_t<S> nearest_angles(const std::array<S, N>& b, const std::array<S, N>& c,
                                         std::array<S, N>& u) noexcept
{
    using std::atan2;
    using std::cos;
    using std::sin;
    using Mask = typename StatusOf<S>::mask;
    auto status = StatusOf<S>::good();
    for (std::size_t k = 0; k < N; ++k) {
        const Mask flat = detail::both<Mask>(b[k] == S(0), c[k] == S(0));
        StatusOf<S>::fail(status, flat, Status::singular_control);
        // The angle from u to (b, c), in the frame that is turned by u.
        const S cosine = cos(u[k]), sine = sin(u[k]);
        const S turn = atan2(c[k] * cosine - b[k] * sine, b[k] * cosine + c[k] * sine);
        u[k] = select(flat, S(std::numeric_limits<real_t<S>>::quiet_NaN()), u[k] + turn);
    }
    return status;
}

/// Where a symmetric matrix, by rows, is negative definite: all pivots of its LDL^T are negative.
template <class S, std::size_t N, std::size_t M>
[[nodiscard]] typename StatusOf<S>::mask is_negative_definite(std::array<S, M> matrix) noexcept
{
    static_assert(M == N * N);
    typename StatusOf<S>::mask definite = S(0) <= S(0);
    for (std::size_t k = 0; k < N; ++k) {
        const S pivot = matrix[k * N + k];
        definite = definite & (pivot < S(0)); // and not NaN
        for (std::size_t i = k + 1; i < N; ++i) {
            const S multiplier = matrix[i * N + k] / pivot;
            for (std::size_t j = k + 1; j < N; ++j) matrix[i * N + j] -= multiplier * matrix[k * N + j];
        }
    }
    return definite;
}

/// Is the stationary point `to` of H a maximum, and the one that the maximum near `from` has become? d2H/du2 is
/// negative definite at `to` and at points of the segment from `from` to it, so that no other stationary point was
/// passed; where `from` is not a number, at `to`.
/// @param curvature curvature(u, matrix): d2H/du2 at u, N * N entries by rows
template <class S, std::size_t N, class Curvature>
[[nodiscard]] typename StatusOf<S>::mask is_same_maximum(const std::array<S, N>& from, const std::array<S, N>& to,
                                                         const Curvature& curvature) noexcept
{
    using Mask = typename StatusOf<S>::mask;
    const auto definite_at = [&](const std::array<S, N>& u) noexcept {
        std::array<S, N * N> matrix;
        curvature(u, matrix);
        return is_negative_definite<S, N>(matrix);
    };
    Mask same = definite_at(to);
    Mask begins = S(1) < S(0);
    for (const S& entry : from) begins = begins | !detail::is_number(entry);
    for (int point = 1; point <= controls_points; ++point) {
        const S share = S(point) / S(controls_points);
        std::array<S, N> between;
        for (std::size_t k = 0; k < N; ++k) between[k] = to[k] + share * (from[k] - to[k]);
        const Mask definite = definite_at(between);
        same = same & (begins | definite);
    }
    return same;
}

} // namespace lagen
