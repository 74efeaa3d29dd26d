// SPDX-License-Identifier: MIT
/// The lanes of a column, one after another or, of doubles, two at once: a lane gets the same bits either way.
#pragma once

#include "lagen/kernel.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace lagen::detail {

/// True of a column of doubles. Two of them are a vector of every 64-bit processor's base; at -O2 g++ 12 makes none by
/// itself. Packs of doubles go by pairs too, so that a sum over a column has the same order in every lane of theirs.
template <class Column>
inline constexpr bool has_pairs = std::is_same_v<real_t<typename Column::Scalar>, double>;

/// True of columns that a function may hold several of.
template <class Column>
inline constexpr bool is_short =
    std::is_trivially_copyable_v<typename Column::Scalar>&& Column::SizeAtCompileTime > 0 &&
    Column::SizeAtCompileTime <= 64;

// A member typedef is what both compilers take as a vector type.
struct Pair {
    typedef double type __attribute__((vector_size(16)));
    typedef long long bits __attribute__((vector_size(16)));
};

/// Two scalars that are no vector: packs.
template <class S>
struct Twin {
    S first, second;

    Twin() noexcept : first(0), second(0) {}
    Twin(const S& both) noexcept : first(both), second(both) {}
    Twin(real_t<S> both) noexcept requires(is_pack<S>) : first(both), second(both) {}
    Twin(const S& a, const S& b) noexcept : first(a), second(b) {}

    Twin& operator+=(const Twin& b) noexcept { return *this = *this + b; }
    friend Twin operator+(const Twin& a, const Twin& b) noexcept { return {a.first + b.first, a.second + b.second}; }
    friend Twin operator-(const Twin& a, const Twin& b) noexcept { return {a.first - b.first, a.second - b.second}; }
    friend Twin operator*(const Twin& a, const Twin& b) noexcept { return {a.first * b.first, a.second * b.second}; }
    friend Twin operator/(const Twin& a, const Twin& b) noexcept { return {a.first / b.first, a.second / b.second}; }
};

template <class S>
struct PairOf {
    using type = Twin<S>;
};
template <>
struct PairOf<double> {
    using type = Pair::type;
};

/// One lane of a column, or two.
template <class Column, int width>
using Slice = std::conditional_t<width == 2, typename PairOf<typename Column::Scalar>::type, typename Column::Scalar>;

/// The same number in every lane; a scalar's default constructor need not make a number.
template <class Column, int width>
[[gnu::always_inline]] inline Slice<Column, width> uniform(const typename Column::Scalar& x) noexcept
{
    if constexpr (width == 2)
        return Slice<Column, width>{x, x};
    else
        return x;
}

/// Lane `lane` of a column, or that lane and the next one.
template <int width, class Column>
[[gnu::always_inline]] inline Slice<Column, width> load(const Column& column, Eigen::Index lane) noexcept
{
    if constexpr (width == 2 && is_pack<typename Column::Scalar>) {
        return {column[lane], column[lane + 1]};
    } else if constexpr (width == 2) {
        Pair::type pair;
        std::memcpy(&pair, column.data() + lane, sizeof pair);
        return pair;
    } else {
        return column[lane];
    }
}

/// The same of a column that was written a moment ago, a lane at a time: a processor waits until such lanes are in its
/// cache where it has to read two of them at once. (Without it RK4 of a heavy top takes half as long again.)
template <int width, class Column>
[[gnu::always_inline]] inline Slice<Column, width> load_fresh(const Column& column, Eigen::Index lane) noexcept
{
    if constexpr (width == 2)
        return Slice<Column, width>{column[lane], column[lane + 1]};
    else
        return column[lane];
}

template <class Column>
[[gnu::always_inline]] inline void store(Column& column, Eigen::Index lane,
                                         const typename Column::Scalar& value) noexcept
{
    column[lane] = value;
}
template <class Column>
requires has_pairs<Column>
[[gnu::always_inline]] inline void store(Column& column, Eigen::Index lane, Pair::type value) noexcept
{
    std::memcpy(column.data() + lane, &value, sizeof value);
}
template <class Column>
[[gnu::always_inline]] inline void store(Column& column, Eigen::Index lane,
                                         const Twin<typename Column::Scalar>& value) noexcept
{
    column[lane] = value.first;
    column[lane + 1] = value.second;
}

template <int width>
using Width = std::integral_constant<int, width>;

/// |x|, a lane.
template <class Scalar>
[[gnu::always_inline]] inline Scalar size_of(const Scalar& x) noexcept
{
    using std::abs;
    return abs(x);
}
[[gnu::always_inline]] inline Pair::type size_of(Pair::type x) noexcept
{
    using Bits = Pair::bits;
    return (Pair::type)((Bits)x & ~(Bits)Pair::type{-0.0, -0.0});
}

template <class S>
[[gnu::always_inline]] inline Twin<S> size_of(const Twin<S>& x) noexcept
{
    return {size_of(x.first), size_of(x.second)};
}

/// a where it is larger, else b; a lane.
template <class Scalar>
[[gnu::always_inline]] inline Scalar larger_of(const Scalar& a, const Scalar& b) noexcept
{
    if constexpr (is_pack<Scalar>)
        return select(a > b, a, b);
    else
        return a > b ? a : b;
}
template <class S>
[[gnu::always_inline]] inline Twin<S> larger_of(const Twin<S>& a, const Twin<S>& b) noexcept
{
    return {larger_of(a.first, b.first), larger_of(a.second, b.second)};
}

/// The sum of the lanes, in their order.
template <class Scalar>
[[gnu::always_inline]] inline const Scalar& total(const Scalar& x) noexcept
{
    return x;
}
[[gnu::always_inline]] inline double total(Pair::type x) noexcept
{
    return x[0] + x[1];
}
template <class S>
[[gnu::always_inline]] inline S total(const Twin<S>& x) noexcept
{
    return x.first + x.second;
}

/// The largest of the lanes; of one that is no number, that or another.
template <class Scalar>
[[gnu::always_inline]] inline const Scalar& largest(const Scalar& x) noexcept
{
    return x;
}
[[gnu::always_inline]] inline double largest(Pair::type x) noexcept
{
    return x[0] > x[1] ? x[0] : x[1];
}

/// f(Width<w>, lane) for the first lanes of a column, in groups of w = 2 lanes where there are pairs, and of 1 lane:
/// `size` of them, which is below 1 where it is not known, and is `count` then. Few are written out: at -O2 g++ 12 does
/// not unroll the loop (heavy top, RK4: a quarter of a step's instructions).
template <class Column, Eigen::Index size, class Function>
[[gnu::always_inline]] inline void for_first_lanes([[maybe_unused]] Eigen::Index count, const Function& f) noexcept
{
    constexpr int width = has_pairs<Column> ? 2 : 1;
    constexpr Eigen::Index longest = 8 * width;
    if constexpr (size > 0 && size <= longest) {
        [&]<Eigen::Index... group>(std::integer_sequence<Eigen::Index, group...>)
        {
            (f(Width<width>(), width * group), ...);
        }
        (std::make_integer_sequence<Eigen::Index, size / width>{});
        if constexpr (size % width != 0) f(Width<1>(), size - 1);
    } else {
        Eigen::Index lane = 0;
        for (; lane + width <= count; lane += width) f(Width<width>(), lane);
        if constexpr (width > 1)
            if (lane < count) f(Width<1>(), lane);
    }
}

/// The same of all lanes.
template <class Column, class Function>
[[gnu::always_inline]] inline void for_lanes(const Column& column, const Function& f) noexcept
{
    for_first_lanes<Column, Column::SizeAtCompileTime>(column.size(), f);
}

/// f(lane) for every lane, one after another.
template <class Column, class Function>
[[gnu::always_inline]] inline void for_each_lane(const Column& column, const Function& f) noexcept
{
    constexpr Eigen::Index longest = 8, size = Column::SizeAtCompileTime;
    if constexpr (size > 0 && size <= longest) {
        [&]<Eigen::Index... lane>(std::integer_sequence<Eigen::Index, lane...>)
        {
            (f(lane), ...);
        }
        (std::make_integer_sequence<Eigen::Index, size>{});
    } else {
        for (Eigen::Index lane = 0; lane < column.size(); ++lane) f(lane);
    }
}

/// The sum of all lanes, of doubles pair by pair.
template <class Column>
[[gnu::always_inline]] inline auto sum_of_lanes(const Column& s) noexcept
{
    constexpr Eigen::Index size = Column::SizeAtCompileTime;
    typename Column::Scalar sum = s[0];
    if constexpr (has_pairs<Column> && !is_pack<typename Column::Scalar> && size >= 2) {
        Pair::type pairs = load_fresh<2>(s, 0);
        for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
            if constexpr (width == 2)
                if (lane > 0) pairs += load_fresh<2>(s, lane);
        });
        sum = total(pairs);
        if constexpr (size % 2 != 0) sum += s[size - 1];
    } else {
        for_each_lane(s, [&](Eigen::Index lane) {
            if (lane > 0) sum += s[lane];
        });
    }
    return sum;
}

/// lost = (s1 - s) - moved: what s1 = s + moved lost to rounding, of sums that are compensated.
template <class State>
[[gnu::always_inline]] inline void keep_lost(const State& s, const State& s1, const State& moved, State& lost) noexcept
{
    for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
        const Slice<State, width> gone = load<width>(s1, lane) - load<width>(s, lane);
        store(lost, lane, gone - load<width>(moved, lane));
    });
}

/// x - x is zero exactly where x is finite; a built-in type has a largest number.
template <class Scalar>
[[gnu::always_inline]] inline bool is_finite_number(const Scalar& x) noexcept
{
    if constexpr (std::is_floating_point_v<Scalar>)
        return size_of(x) <= std::numeric_limits<Scalar>::max();
    else
        return x - x == Scalar(0);
}

/// A status good or `non_finite`, a lane of a pack. A finite sum of all lanes has finite terms, so that one sum tells
/// of most columns; the others (sums overflow) are looked at lane by lane.
template <class Column>
[[gnu::always_inline]] inline status_t<typename Column::Scalar> check_finite(const Column& s) noexcept
{
    using Scalar = typename Column::Scalar;
    auto status = StatusOf<Scalar>::good();
    if constexpr (!is_pack<Scalar>)
        if (is_finite_number(Scalar(sum_of_lanes(s)))) return status;
    Scalar sum = Scalar(0);
    for_each_lane(s, [&](Eigen::Index lane) { sum += s[lane] - s[lane]; });
    StatusOf<Scalar>::fail(status, sum != Scalar(0), Status::non_finite);
    return status;
}

} // namespace lagen::detail
