// SPDX-License-Identifier: MIT
/// Exact coefficients, and the stage sums of an explicit Runge-Kutta method:
///   X_i = s + h sum_{j<i} a_ij K_j,   K_i = f(t + c_i h, X_i),   s1 = s + h sum_i b_i K_i.
/// A tableau is a type with constexpr members: stages, order, a (rows of the strict lower triangle one after another),
/// b, c.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace lagen {

/// numerator / denominator, rounded once to the scalar (both must be below 2^53).
struct Fraction {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;

    [[nodiscard]] constexpr bool is_zero() const noexcept { return numerator == 0; }

    template <class Real>
    [[nodiscard]] constexpr Real as() const noexcept
    {
        // A quotient of two exact doubles rounded to float is rounded correctly, one of two floats is not.
        if constexpr (std::is_same_v<Real, float>)
            return static_cast<float>(static_cast<double>(numerator) / static_cast<double>(denominator));
        else
            return static_cast<Real>(numerator) / static_cast<Real>(denominator);
    }
};

/// A coefficient that is published as a decimal fraction only; exact to the digits of a long double (19 on x86), also
/// where the scalar has more: methods made of Decimals (Tsit5, Dop853, McLachlan4, Yoshida6) satisfy their order
/// conditions to about 1e-18 in any wider scalar, those made of Fractions to all its digits.
struct Decimal {
    long double value = 0.0L;

    [[nodiscard]] constexpr bool is_zero() const noexcept { return value == 0.0L; }

    template <class Real>
    [[nodiscard]] constexpr Real as() const noexcept
    {
        return static_cast<Real>(value);
    }
};

namespace detail {

/// Where a_ij lies in the strict lower triangle, by rows.
constexpr std::size_t lower_index(std::size_t i, std::size_t j) noexcept
{
    return i * (i - 1) / 2 + j;
}

/// f(lane) for every lane of a state. Short states are written out: at -O2 g++ 12 neither unrolls nor vectorises the
/// loop (heavy top, RK4: a quarter of a step's instructions).
template <class State, class Function>
[[gnu::always_inline]] inline void for_each_lane(const State& s, const Function& f) noexcept
{
    constexpr Eigen::Index longest = 8;
    constexpr Eigen::Index size = State::SizeAtCompileTime;
    if constexpr (size > 0 && size <= longest) {
        [&]<Eigen::Index... lane>(std::integer_sequence<Eigen::Index, lane...>)
        {
            (f(lane), ...);
        }
        (std::make_integer_sequence<Eigen::Index, size>{});
    } else {
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) f(lane);
    }
}

/// The first of `count` weights from `offset` on that is not zero; `count` where all are.
template <auto& weights, std::size_t offset, std::size_t count>
constexpr std::size_t first_weight() noexcept
{
    std::size_t j = 0;
    while (j < count && weights[offset + j].is_zero()) ++j;
    return j;
}

/// sum_j weights[offset + j] k[j][lane], j < count; coefficients that are exactly zero cost nothing, and the sum begins
/// with its first term, since a compiler may not drop 0 + x.
template <auto& weights, std::size_t offset, std::size_t... j, class Stages>
[[gnu::always_inline]] inline auto weighted_lane(const Stages& k, Eigen::Index lane, std::index_sequence<j...>) noexcept
{
    using State = typename Stages::value_type;
    using Scalar = typename State::Scalar;
    using Real = real_t<Scalar>;
    constexpr std::size_t first = first_weight<weights, offset, sizeof...(j)>();
    if constexpr (first == sizeof...(j)) {
        return Scalar(0);
    } else {
        Scalar sum = weights[offset + first].template as<Real>() * k[first][lane];
        const auto add = [&]<std::size_t stage>() {
            if constexpr (stage > first && !weights[offset + stage].is_zero())
                sum += weights[offset + stage].template as<Real>() * k[stage][lane];
        };
        (add.template operator()<j>(), ...);
        return sum;
    }
}

/// out = s + h sum_j weights[offset + j] k[j], j < count, lane by lane: one pass and no temporaries. (Measured: the
/// same sums as Eigen expressions execute a tenth fewer instructions in RK4 and half as many again in DOP853.)
template <auto& weights, std::size_t offset, std::size_t count, class State, class Stages>
void add_weighted(const State& s, const real_t<typename State::Scalar>& h, const Stages& k, State& out) noexcept
{
    for_each_lane(s, [&](Eigen::Index lane) {
        out[lane] = s[lane] + h * weighted_lane<weights, offset>(k, lane, std::make_index_sequence<count>{});
    });
}

/// out = h sum_j weights[j] k[j].
template <auto& weights, class State, class Stages>
void weighted_sum(const real_t<typename State::Scalar>& h, const Stages& k, State& out) noexcept
{
    for_each_lane(out, [&](Eigen::Index lane) {
        out[lane] = h * weighted_lane<weights, 0>(k, lane, std::make_index_sequence<weights.size()>{});
    });
}

/// A status good or `non_finite`: x - x is zero exactly where x is finite, in every scalar and lane.
template <class State>
[[gnu::always_inline]] inline status_t<typename State::Scalar> check_finite(const State& s) noexcept
{
    using Scalar = typename State::Scalar;
    Scalar sum = Scalar(0);
    for_each_lane(s, [&](Eigen::Index lane) { sum += s[lane] - s[lane]; });
    auto status = StatusOf<Scalar>::good();
    StatusOf<Scalar>::fail(status, sum != Scalar(0), Status::non_finite);
    return status;
}

/// Stages first..last-1 (from 0) of `Tableau`: X_i, then K_i. Returns the first failure; goes on after one (packs have
/// other lanes).
template <class Tableau, std::size_t first, std::size_t last, class M, class Stages>
[[gnu::always_inline]] inline status_t<typename M::Scalar>
evaluate_stages(const M& model, const real_t<typename M::Scalar>& t, const typename M::State& s,
                const real_t<typename M::Scalar>& h, typename M::State& x, Stages& k) noexcept
{
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    auto status = StatusOf<Scalar>::good();
    if constexpr (first < last) {
        add_weighted<Tableau::a, lower_index(first, 0), first>(s, h, k, x);
        const Real time = t + Tableau::c[first].template as<Real>() * h;
        status = model.rhs(Scalar(time), x, k[first]);
        if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) return status;
        status = StatusOf<Scalar>::first(status, evaluate_stages<Tableau, first + 1, last>(model, t, s, h, x, k));
    }
    return status;
}

} // namespace detail

} // namespace lagen
