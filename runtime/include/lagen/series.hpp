// SPDX-License-Identifier: MIT
/// Taylor coefficients of several functions, and the sums over lower orders of which generated recurrences are made:
///   <a, b>_k = sum_{j=1}^{k-1} a_j b_{k-j}.
/// All sums of an order are made at once, before the order: float and double in vector registers, a pair of series a
/// lane, two accumulators by turns. Other scalars, packs among them, take them one by one in the same order.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lagen {

/// x[k][i]: the coefficient of order k <= most of the function i < n.
template <class S, int n, int most>
struct TaylorSeries {
    using Row = std::array<S, static_cast<std::size_t>(n)>;
    std::array<Row, static_cast<std::size_t>(most) + 1> rows;

    [[nodiscard]] Row& operator[](int k) noexcept { return rows[static_cast<std::size_t>(k)]; }
    [[nodiscard]] const Row& operator[](int k) const noexcept { return rows[static_cast<std::size_t>(k)]; }
};

namespace detail {

/// Pairs of series, one a lane of the type Lanes.
template <class Lanes, std::size_t length>
struct PairedSeries {
    std::array<Lanes, length> a, b;

    /// The terms with the latest coefficients are last: the others need not wait for them.
    [[nodiscard]] [[gnu::always_inline]] Lanes sum(std::size_t k) const noexcept
    {
        if (k < 2) return Lanes();
        if (k == 2) return a[1] * b[1];
        Lanes even = Lanes(), odd = Lanes();
        std::size_t j = 2;
        for (; j + 2 < k; j += 2) {
            even += a[j] * b[k - j];
            odd += a[j + 1] * b[k - j - 1];
        }
        if (j + 1 < k) even += a[j] * b[k - j];
        even += a[1] * b[k - 1];
        odd += a[k - 1] * b[1];
        return even + odd;
    }
};

#if defined(__GNUC__)
#if defined(__AVX512F__)
inline constexpr std::size_t widest_register = 64;
#elif defined(__AVX__)
inline constexpr std::size_t widest_register = 32;
#else
inline constexpr std::size_t widest_register = 16;
#endif

template <class S>
inline constexpr std::size_t register_lanes = std::is_floating_point_v<S> && sizeof(S) <= 8
                                                  ? widest_register / sizeof(S)
                                                  : 1;

template <class S, std::size_t width>
struct RegisterOf {
    typedef S type __attribute__((vector_size(width * sizeof(S))));
};
template <class S>
struct RegisterOf<S, 1> {
    using type = S;
};
#else
template <class S>
inline constexpr std::size_t register_lanes = 1;

template <class S, std::size_t width>
struct RegisterOf {
    using type = S;
};
#endif

} // namespace detail

/// The sums of `count` pairs for orders up to `most`.
template <class S, int count, int most>
class LowerSums {
    static constexpr std::size_t size = static_cast<std::size_t>(count);
    static constexpr std::size_t width = detail::register_lanes<S>;
    static constexpr std::size_t whole = size / width; ///< full registers
    static constexpr std::size_t rest = size % width;
    static constexpr std::size_t rest_width = rest == 0 ? 1 : std::bit_ceil(rest);
    using Entries = std::array<S, size>;
    using Register = typename detail::RegisterOf<S, width>::type;
    using Rest = typename detail::RegisterOf<S, rest_width>::type;

  public:
    /// <a, b>_k of every pair, from the coefficients of orders 1 .. k - 1.
    [[nodiscard]] [[gnu::always_inline]] Entries operator()(int k) const noexcept
    {
        Entries sums;
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < whole; ++m) store<width>(whole_[m].sum(order), m * width, width, sums);
        if constexpr (rest > 0) store<rest_width>(rest_.sum(order), whole * width, rest, sums);
        return sums;
    }

    /// Takes the coefficients a_k and b_k of every pair.
    [[gnu::always_inline]] void keep(int k, const Entries& a, const Entries& b) noexcept
    {
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < whole; ++m) {
            whole_[m].a[order] = load<Register, width>(a, m * width);
            whole_[m].b[order] = load<Register, width>(b, m * width);
        }
        if constexpr (rest > 0) {
            rest_.a[order] = load<Rest, rest_width>(a, whole * width);
            rest_.b[order] = load<Rest, rest_width>(b, whole * width);
        }
    }

  private:
    template <std::size_t lanes, class Lanes>
    [[gnu::always_inline]] static void store(const Lanes& sum, std::size_t at, std::size_t used, Entries& sums) noexcept
    {
        if constexpr (lanes == 1)
            sums[at] = sum;
        else
            for (std::size_t i = 0; i < used; ++i) sums[at + i] = sum[i];
    }

    /// Entries at, at + 1, ..; zeros behind the last.
    template <class Lanes, std::size_t lanes>
    [[nodiscard]] [[gnu::always_inline]] static Lanes load(const Entries& entries, std::size_t at) noexcept
    {
        if constexpr (lanes == 1)
            return entries[at];
        else
            return [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline))
            {
                return Lanes{(at + i < size ? entries[at + i < size ? at + i : 0] : S(0))...};
            }
        (std::make_index_sequence<lanes>{});
    }

    std::array<detail::PairedSeries<Register, most + 1>, whole> whole_;
    detail::PairedSeries<Rest, rest == 0 ? 0 : most + 1> rest_;
};

} // namespace lagen
