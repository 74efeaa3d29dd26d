// SPDX-License-Identifier: MIT
/// The lanes of a column, one after another or, of doubles, two, four or eight at once: a lane gets the same bits in
/// every way, and so does a sum over lanes, which goes pair by pair.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen/lanes/registers.hpp"

#include <array>
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

/// The number of lanes of a register of several doubles; 0 of anything else.
template <class T>
inline constexpr int doubles_in = 0;
template <>
inline constexpr int doubles_in<RegisterOf<double, 2>::type> = 2;
template <>
inline constexpr int doubles_in<RegisterOf<double, 4>::type> = 4;
template <>
inline constexpr int doubles_in<RegisterOf<double, 8>::type> = 8;

/// Lanes of a column that are taken at once: those of the widest register that the compiler may use, two of a column
/// that is so short that the next reader would wait for what was written a lane at a time.
template <class Column, Eigen::Index size>
constexpr int widest_slice() noexcept
{
    if (!has_pairs<Column>) return 1;
    if (is_pack<typename Column::Scalar> || size < 12) return 2;
    return static_cast<int>(register_lanes<double>);
}

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

template <class S, int width>
struct SliceOf {
    using type = Twin<S>;
};
template <class S>
struct SliceOf<S, 1> {
    using type = S;
};
template <int width>
requires(width > 1) struct SliceOf<double, width> {
    using type = typename RegisterOf<double, static_cast<std::size_t>(width)>::type;
};

/// One lane of a column, or several.
template <class Column, int width>
using Slice = typename SliceOf<typename Column::Scalar, width>::type;

template <class Column, int... k>
[[gnu::always_inline]] inline Slice<Column, sizeof...(k)> uniform(const typename Column::Scalar& x,
                                                                  std::integer_sequence<int, k...>) noexcept
{
    return Slice<Column, sizeof...(k)>{(static_cast<void>(k), x)...};
}

/// The same number in every lane; a scalar's default constructor need not make a number.
template <class Column, int width>
[[gnu::always_inline]] inline Slice<Column, width> uniform(const typename Column::Scalar& x) noexcept
{
    return uniform<Column>(x, std::make_integer_sequence<int, width>{});
}

template <class Column, int... k>
[[gnu::always_inline]] inline Slice<Column, sizeof...(k)> lanes_from(const Column& column, Eigen::Index lane,
                                                                     std::integer_sequence<int, k...>) noexcept
{
    return Slice<Column, sizeof...(k)>{column[lane + k]...};
}

/// Lane `lane` of a column written a moment ago, a lane at a time, and the next ones: a processor waits until such
/// lanes are in its cache where it has to read several of them at once. (Without it RK4 of a heavy top takes half as
/// long again.)
template <int width, class Column>
[[gnu::always_inline]] inline Slice<Column, width> load_fresh(const Column& column, Eigen::Index lane) noexcept
{
    return lanes_from(column, lane, std::make_integer_sequence<int, width>{});
}

/// Lane `lane` of a column and the next ones.
template <int width, class Column>
[[gnu::always_inline]] inline Slice<Column, width> load(const Column& column, Eigen::Index lane) noexcept
{
    if constexpr (doubles_in<Slice<Column, width>> != 0) {
        Slice<Column, width> slice;
        std::memcpy(&slice, column.data() + lane, sizeof slice);
        return slice;
    } else {
        return load_fresh<width>(column, lane);
    }
}

template <class Column>
[[gnu::always_inline]] inline void store(Column&& column, Eigen::Index lane,
                                         const typename std::remove_cvref_t<Column>::Scalar& value) noexcept
{
    column[lane] = value;
}
template <class Column, class Vector>
requires(doubles_in<Vector> > 0)
    [[gnu::always_inline]] inline void store(Column&& column, Eigen::Index lane, const Vector& value) noexcept
{
    std::memcpy(column.data() + lane, &value, sizeof value);
}
template <class Column>
[[gnu::always_inline]] inline void store(Column&& column, Eigen::Index lane,
                                         const Twin<typename std::remove_cvref_t<Column>::Scalar>& value) noexcept
{
    column[lane] = value.first;
    column[lane + 1] = value.second;
}

/// Where the lanes of a column are whose size is known at run time. A loop over lanes holds it by value: the place of
/// the numbers of an Eigen column would have to be read again behind every store. (RK4 of a heavy top: a quarter of a
/// step's instructions.)
template <class Number>
struct LanePlace {
    using Scalar = std::remove_const_t<Number>;
    static constexpr int SizeAtCompileTime = Eigen::Dynamic;
    Number* lanes;

    [[nodiscard]] [[gnu::always_inline]] Number& operator[](Eigen::Index lane) const noexcept { return lanes[lane]; }
    [[nodiscard]] [[gnu::always_inline]] Number* data() const noexcept { return lanes; }
};

template <class Column>
inline constexpr bool is_sized_later = Column::SizeAtCompileTime == Eigen::Dynamic;

/// What a loop over lanes holds of a column, or of the columns first .. count - 1 of several: the column itself, or the
/// place of its lanes. More than eight places stay where they are, since a processor has no registers for them.
template <class Column>
[[nodiscard]] [[gnu::always_inline]] inline decltype(auto) held(Column& column) noexcept
{
    using Number = std::remove_pointer_t<decltype(column.data())>;
    if constexpr (is_sized_later<std::remove_const_t<Column>>)
        return LanePlace<Number>{column.data()};
    else
        return (column);
}
template <std::size_t first, std::size_t count, class Column, std::size_t all>
[[nodiscard]] [[gnu::always_inline]] inline decltype(auto) held(const std::array<Column, all>& columns) noexcept
{
    if constexpr (is_sized_later<Column> && count <= 8) {
        return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline))
        {
            using Place = LanePlace<const typename Column::Scalar>;
            return std::array<Place, count>{(k < first ? Place{} : Place{columns[k].data()})...};
        }
        (std::make_index_sequence<count>{});
    } else {
        return (columns);
    }
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
template <class Vector>
requires(doubles_in<Vector> > 0) [[gnu::always_inline]] inline Vector size_of(const Vector& x) noexcept
{
    using Bits = typename RegisterOf<long long, doubles_in<Vector>>::type;
    return reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & ~reinterpret_cast<Bits>(-Vector{}));
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

/// sum + the sum of the lanes, a pair at a time.
template <class Scalar>
[[gnu::always_inline]] inline Scalar sum_with(const Scalar& sum, const Scalar& x) noexcept
{
    return sum + x;
}
template <class Vector>
requires(doubles_in<Vector> > 0) [[gnu::always_inline]] inline double sum_with(double sum, const Vector& x) noexcept
{
    for (int k = 0; k < doubles_in<Vector>; k += 2) sum += x[k] + x[k + 1];
    return sum;
}
template <class S>
[[gnu::always_inline]] inline S sum_with(const S& sum, const Twin<S>& x) noexcept
{
    return sum + (x.first + x.second);
}

/// The largest of the lanes; of one that is no number, that or another.
template <class Scalar>
[[gnu::always_inline]] inline Scalar largest(const Scalar& x) noexcept
{
    return x;
}
template <class Vector>
requires(doubles_in<Vector> > 0) [[gnu::always_inline]] inline double largest(const Vector& x) noexcept
{
    double most = x[0];
    for (int k = 1; k < doubles_in<Vector>; ++k) most = most > x[k] ? most : x[k];
    return most;
}

/// f(Width<w>, lane) for the lanes first..size-1, in groups of w = `width` lanes, then of half as many, .., of 1.
template <int width, Eigen::Index first, Eigen::Index size, class Function>
[[gnu::always_inline]] inline void write_out_slices(const Function& f) noexcept
{
    if constexpr (first < size) {
        [&]<Eigen::Index... group>(std::integer_sequence<Eigen::Index, group...>)
        {
            (f(Width<width>(), first + width * group), ...);
        }
        (std::make_integer_sequence<Eigen::Index, (size - first) / width>{});
        write_out_slices<width / 2, first + (size - first) / width * width, size>(f);
    }
}

/// The same for lanes 0, 1, ..: `size` of them, which is below 1 where it is not known, and is `count` then. Few are
/// written out: at -O2 g++ 12 does not unroll the loop (heavy top, RK4: a quarter of a step's instructions).
template <int width, Eigen::Index size, class Function>
[[gnu::always_inline]] inline void for_slices([[maybe_unused]] Eigen::Index count, const Function& f) noexcept
{
    if constexpr (size > 0 && size <= 8 * width) {
        write_out_slices<width, 0, size>([&](auto slice, Eigen::Index lane) { f(slice, lane); });
    } else {
        Eigen::Index lane = 0;
        const auto go_on = [&]<int narrower>(Width<narrower>) __attribute__((always_inline))
        {
            if constexpr (narrower <= width)
                for (; lane + narrower <= count; lane += narrower) f(Width<narrower>(), lane);
        };
        go_on(Width<8>());
        go_on(Width<4>());
        go_on(Width<2>());
        go_on(Width<1>());
    }
}

/// f(Width<w>, lane) for the first lanes of a column, in slices.
template <class Column, Eigen::Index size, class Function>
[[gnu::always_inline]] inline void for_first_lanes(Eigen::Index count, const Function& f) noexcept
{
    for_slices<widest_slice<Column, size>(), size>(count, f);
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
    using Scalar = typename Column::Scalar;
    if constexpr (size <= 0)
        if (s.size() == 0) return Scalar(0);
    Scalar sum = s[0];
    if constexpr (has_pairs<Column> && !is_pack<Scalar> && size >= 2) {
        Slice<Column, 2> pairs = load_fresh<2>(s, 0);
        for_slices<2, size>(size, [&]<int width>(Width<width>, Eigen::Index lane) {
            if constexpr (width == 2)
                if (lane > 0) pairs += load_fresh<2>(s, lane);
        });
        sum = pairs[0] + pairs[1];
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
