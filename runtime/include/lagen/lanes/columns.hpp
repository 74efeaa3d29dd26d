// SPDX-License-Identifier: MIT
/// Columns of a matrix that one sweep computes at once: directional derivatives along several unit vectors, one a lane.
/// Of float and double there are as many as a register holds; any other scalar takes one column at a time.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace lagen {

/// The type of an entry in several columns: sums, differences and negatives of such, products and quotients with S.
template <class S>
struct ColumnsOf {
    using type = S;
    static constexpr std::size_t count = 1;
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))
namespace detail {
#if defined(__AVX512F__)
inline constexpr std::size_t column_bytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t column_bytes = 32;
#else
inline constexpr std::size_t column_bytes = 16;
#endif
} // namespace detail

template <>
struct ColumnsOf<double> {
    typedef double type __attribute__((vector_size(detail::column_bytes)));
    static constexpr std::size_t count = detail::column_bytes / sizeof(double);
};
template <>
struct ColumnsOf<float> {
    typedef float type __attribute__((vector_size(detail::column_bytes)));
    static constexpr std::size_t count = detail::column_bytes / sizeof(float);
};
#endif

template <class S>
using columns_t = typename ColumnsOf<S>::type;

/// The value in every column, or the columns themselves.
template <class S, class Value>
[[nodiscard, gnu::always_inline]] inline columns_t<S> columns(const Value& value) noexcept
{
    if constexpr (ColumnsOf<S>::count > 1 && std::is_convertible_v<Value, S>)
        return columns_t<S>{} + static_cast<S>(value);
    else
        return columns_t<S>(value);
}

/// What stands in one of the columns.
template <class S>
[[nodiscard, gnu::always_inline]] inline S column(const columns_t<S>& values, [[maybe_unused]] std::size_t k) noexcept
{
    if constexpr (ColumnsOf<S>::count > 1)
        return values[k];
    else
        return values;
}

/// The entry in the row of a unit vector: 1 in column k, 0 in the others.
template <class S>
[[nodiscard, gnu::always_inline]] inline columns_t<S> unit_column([[maybe_unused]] std::size_t k) noexcept
{
    columns_t<S> unit = columns<S>(S(0));
    if constexpr (ColumnsOf<S>::count > 1)
        unit[k] = S(1);
    else
        unit = S(1);
    return unit;
}

namespace detail {

/// table[b][r]: the first entry of row r that stands in no column before b * width; the entries are sorted by rows.
template <std::size_t rows, std::size_t blocks, std::size_t width, std::size_t count>
consteval auto column_blocks(const std::array<int, count>& row, const std::array<int, count>& column)
{
    std::array<std::array<std::size_t, rows>, blocks + 1> table{};
    std::size_t k = 0;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t b = 0; b <= blocks; ++b) {
            const auto is_before = [&] {
                return static_cast<std::size_t>(row[k]) == r && static_cast<std::size_t>(column[k]) < b * width;
            };
            while (k < count && is_before()) ++k;
            table[b][r] = k;
        }
    return table;
}

} // namespace detail

/// values[k] = the entry of a matrix at (row[k], column_of[k]), by rows: sweep(v, dv) computes the derivatives dv of
/// all `rows` along v, for several of the `size` unit vectors v at once.
template <class S, std::size_t rows, std::size_t size, const auto& row, const auto& column_of, class Values,
          class Sweep>
void sweep_columns(Values& values, const Sweep& sweep) noexcept
{
    constexpr std::size_t width = ColumnsOf<S>::count, blocks = (size + width - 1) / width;
    static constexpr auto table = detail::column_blocks<rows, blocks, width>(row, column_of);
    std::array<columns_t<S>, size> v;
    std::array<columns_t<S>, rows> dv;
    v.fill(columns<S>(S(0)));
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t first = b * width;
        for (std::size_t c = first; c < first + width && c < size; ++c) v[c] = unit_column<S>(c - first);
        sweep(v, dv);
        for (std::size_t c = first; c < first + width && c < size; ++c) v[c] = columns<S>(S(0));
        for (std::size_t r = 0; r < rows; ++r) {
            const std::size_t begin = table[b][r], end = table[b + 1][r];
            if constexpr (width > 1)
                if (end - begin == width) { // all of them, side by side
                    std::memcpy(&values[begin], &dv[r], sizeof dv[r]);
                    continue;
                }
            for (std::size_t k = begin; k < end; ++k)
                values[k] = column<S>(dv[r], static_cast<std::size_t>(column_of[k]) - first);
        }
    }
}

} // namespace lagen
