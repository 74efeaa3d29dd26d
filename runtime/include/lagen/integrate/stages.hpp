// SPDX-License-Identifier: MIT
/// The stage sums of an explicit Runge-Kutta method:
///   X_i = s + h sum_{j<i} a_ij K_j,   K_i = f(t + c_i h, X_i),   s1 = s + h sum_i b_i K_i,
/// where "s + .." is the retraction of the model (retract.hpp) if it has one.
#pragma once

#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/tableau.hpp"
#include "lagen/lanes/lanes.hpp"

namespace lagen::detail {

/// Where a_ij lies in the strict lower triangle, by rows.
constexpr std::size_t lower_index(std::size_t i, std::size_t j) noexcept
{
    return i * (i - 1) / 2 + j;
}

/// The first of `count` weights from `offset` on that is not zero; `count` where all are.
template <auto& weights, std::size_t offset, std::size_t count>
constexpr std::size_t first_weight() noexcept
{
    std::size_t j = 0;
    while (j < count && weights[offset + j].is_zero()) ++j;
    return j;
}

/// True where the weights are whole multiples of their first one, as those of the classical methods are.
template <auto& weights, std::size_t offset, std::size_t count>
constexpr bool have_a_measure() noexcept
{
    constexpr std::size_t first = first_weight<weights, offset, count>();
    for (std::size_t j = first; j < count; ++j)
        if (!weights[offset + j].is_zero() && weights[offset + j].count_of(weights[offset + first]) == 0) return false;
    return true;
}

/// h sum_j weights[offset + j] k[j] in lane `lane` (and the next one, of width 2), j < count; coefficients that are
/// exactly zero cost nothing, and the sum begins with its first term, since a compiler may not drop 0 + x. Where the
/// weights have a measure it is taken out of the sum, as h/6 (k_1 + 2 k_2 + 2 k_3 + k_4). The last slope was just
/// written.
template <auto& weights, std::size_t offset, int width, std::size_t... j, class Time, class Stages>
[[gnu::always_inline]] inline auto weighted_lanes(const Time& h, const Stages& k, Eigen::Index lane,
                                                  std::index_sequence<j...>) noexcept
{
    using Column = typename Stages::value_type;
    using Real = real_t<typename Column::Scalar>;
    using Sum = Slice<Column, width>;
    constexpr std::size_t first = first_weight<weights, offset, sizeof...(j)>();
    constexpr bool measured = have_a_measure<weights, offset, sizeof...(j)>();
    const auto slope = [&]<std::size_t stage>() {
        if constexpr (stage + 1 == sizeof...(j))
            return load_fresh<width>(k[stage], lane);
        else
            return load<width>(k[stage], lane);
    };
    const auto weight = []<std::size_t stage>() {
        if constexpr (measured)
            return static_cast<Real>(weights[offset + stage].count_of(weights[offset + first]));
        else
            return weights[offset + stage].template as<Real>();
    };
    if constexpr (first == sizeof...(j)) {
        return Sum{};
    } else {
        Sum sum = weight.template operator()<first>() * slope.template operator()<first>();
        const auto add = [&]<std::size_t stage>() {
            if constexpr (stage > first && !weights[offset + stage].is_zero())
                sum += weight.template operator()<stage>() * slope.template operator()<stage>();
        };
        (add.template operator()<j>(), ...);
        if constexpr (measured)
            return Sum(Time(h * weights[offset + first].template as<Real>()) * sum);
        else
            return Sum(h * sum);
    }
}

/// out = h sum_j weights[j] k[j].
template <auto& weights, std::size_t offset = 0, std::size_t count = weights.size(), class Time, class Column,
          class Stages>
[[gnu::always_inline]] inline void weighted_sum(const Time& h, const Stages& k, Column& out) noexcept
{
    auto&& to = held(out);
    const auto& slopes = held<first_weight<weights, offset, count>(), count>(k);
    for_lanes(
        out, [&]<int width>(Width<width>, Eigen::Index lane) __attribute__((always_inline)) {
            store(to, lane, weighted_lanes<weights, offset, width>(h, slopes, lane, std::make_index_sequence<count>{}));
        });
}

/// out = s + h sum_j weights[offset + j] k[j], j < count: of vectors in one pass without temporaries. (Measured: the
/// same sums as Eigen expressions execute half as many instructions again in DOP853.)
template <auto& weights, std::size_t offset, std::size_t count, class M, class Stages>
[[gnu::always_inline]] inline void move_along(const M& model, const typename M::State& s, const step_time_t<M>& h,
                                              const Stages& k, typename M::State& out) noexcept
{
    if constexpr (moves_by_sums<M>) {
        auto&& to = held(out);
        auto&& from = held(s);
        const auto& slopes = held<first_weight<weights, offset, count>(), count>(k);
        for_lanes(
            s, [&]<int width>(Width<width>, Eigen::Index lane) __attribute__((always_inline)) {
                const auto sum =
                    weighted_lanes<weights, offset, width>(h, slopes, lane, std::make_index_sequence<count>{});
                store(to, lane, load<width>(from, lane) + sum);
            });
    } else {
        tangent_t<M> delta;
        weighted_sum<weights, offset, count>(h, k, delta);
        out = retracted(model, s, delta);
    }
}

/// move_along, and whether the result is finite.
template <auto& weights, std::size_t offset, std::size_t count, class M, class Stages>
[[gnu::always_inline]] inline status_t<typename M::Scalar> move_checked(const M& model, const typename M::State& s,
                                                                        const step_time_t<M>& h, const Stages& k,
                                                                        typename M::State& out) noexcept
{
    if constexpr (moves_by_sums<M>) {
        move_along<weights, offset, count>(model, s, h, k, out);
        return check_finite(out);
    } else {
        tangent_t<M> delta;
        weighted_sum<weights, offset, count>(h, k, delta);
        out = retracted(model, s, delta);
        return check_finite(delta);
    }
}

/// Slopes K and a stage X.
template <class M, std::size_t stages>
struct StageScratch {
    std::array<tangent_t<M>, stages> k;
    typename M::State x;
};

/// Stages first..last-1 (from 0) of `Tableau`: X_i, then K_i. Returns the first failure; goes on after one of a pack,
/// which has other lanes.
template <class Tableau, std::size_t first, std::size_t last, class M, class Stages>
[[gnu::always_inline]] inline status_t<typename M::Scalar>
evaluate_stages(const M& model, const step_time_t<M>& t, const typename M::State& s, const step_time_t<M>& h,
                typename M::State& x, Stages& k) noexcept
{
    using Scalar = typename M::Scalar;
    using Time = step_time_t<M>;
    auto status = StatusOf<Scalar>::good();
    if constexpr (first < last) {
        move_along<Tableau::a, lower_index(first, 0), first>(model, s, h, k, x);
        const Time time = t + Tableau::c[first].template as<real_t<Scalar>>() * h;
        status = model.rhs(Scalar(time), x, k[first]);
        if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) return status;
        status = StatusOf<Scalar>::first(status, evaluate_stages<Tableau, first + 1, last>(model, t, s, h, x, k));
    }
    return status;
}

} // namespace lagen::detail
