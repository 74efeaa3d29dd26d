// SPDX-License-Identifier: MIT
/// Taylor coefficients of several functions, and the sums over lower orders of which generated recurrences are made:
///   <a, b>_k = sum_{j=1}^{k-1} a_j b_{k-j}.
/// All sums of an order are made at once, before the order: float and double in vector registers, a pair of series a
/// lane, two accumulators by turns. Other scalars, packs among them, take them one by one in the same order.
#pragma once

#include "lagen/lanes/registers.hpp"
#include "lagen/scalar.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace lagen {

/// x[k][i]: the coefficient of order k <= most of the function i < n.
template <class S, int n, int most>
struct TaylorSeries {
    using Row = std::array<S, static_cast<std::size_t>(n)>;
    std::array<Row, static_cast<std::size_t>(most) + 1> rows;

    [[nodiscard]] Row& operator[](int k) noexcept { return rows[static_cast<std::size_t>(k)]; }
    [[nodiscard]] const Row& operator[](int k) const noexcept { return rows[static_cast<std::size_t>(k)]; }
    /// A row for what is made of the coefficients for a while; a series has one.
    struct SpareRow : Row {
        explicit SpareRow(const TaylorSeries&) noexcept {}
    };
};

/// The same of n functions where n is known at run time, at the same places: k n + i. `resize` takes the memory, that
/// of the spare row too, and some where there are no functions: the rows of a series without any have their places.
template <class S, int most>
class TaylorSeries<S, -1, most> {
  public:
    using Row = std::vector<S>;

    void resize(std::size_t functions)
    {
        functions_ = functions;
        numbers_.assign((static_cast<std::size_t>(most) + 2) * std::max<std::size_t>(functions, 1), S(0));
    }
    [[nodiscard]] std::span<S> operator[](int k) noexcept
    {
        return {numbers_.data() + static_cast<std::size_t>(k) * functions_, functions_};
    }
    [[nodiscard]] std::span<const S> operator[](int k) const noexcept
    {
        return {numbers_.data() + static_cast<std::size_t>(k) * functions_, functions_};
    }
    struct SpareRow : std::span<S> {
        explicit SpareRow(TaylorSeries& x) noexcept : std::span<S>(x[most + 1]) {}
    };

  private:
    std::size_t functions_ = 0;
    std::vector<S> numbers_;
};

namespace detail {

/// 1/k = high + low, high k exact.
template <class Real>
struct SplitReciprocal {
    Real high = Real(0), low = Real(0);

    constexpr SplitReciprocal() = default;
    constexpr explicit SplitReciprocal(int k)
    {
        const Real number = static_cast<Real>(k), whole = Real(1) / number, wide = Real(513) * whole;
        high = wide - (wide - whole); // without its last nine bits [Dekker 1971]
        low = (Real(1) - high * number) / number;
    }
};

/// Of k < 64, the orders in use.
template <class Real>
inline constexpr auto split_reciprocals = [] {
    std::array<SplitReciprocal<Real>, 64> all;
    for (int k = 1; k < 64; ++k) all[static_cast<std::size_t>(k)] = SplitReciprocal<Real>(k);
    return all;
}();

} // namespace detail

/// `one_over * x` is unit x / k for a whole number k < 512 and a power of two as the unit, within a unit of the last
/// place and without a bias: a reciprocal that is rounded by itself shifts x by the same fraction in every step, and
/// invariants drift in proportion to the time. Float, double and packs of them take two products, which a processor has
/// sooner than a quotient.
template <class S>
class OneOver {
    using Real = real_t<S>;
    static constexpr bool is_split = std::is_same_v<Real, float> || std::is_same_v<Real, double>;

  public:
    explicit OneOver(int k, const S& unit = S(1)) noexcept : first_(unit), second_(S(k))
    {
        if constexpr (is_split) {
            const auto& known = detail::split_reciprocals<Real>;
            const auto place = static_cast<std::size_t>(k);
            const auto parts = place < known.size() ? known[place] : detail::SplitReciprocal<Real>(k);
            first_ = unit * S(parts.high);
            second_ = unit * S(parts.low);
        }
    }

    [[nodiscard]] [[gnu::always_inline]] friend S operator*(const OneOver& one_over, const S& x) noexcept
    {
        return one_over.of(x);
    }

    /// The same of anything that is multiplied by S, lane by lane.
    template <class Lanes>
    [[nodiscard]] [[gnu::always_inline]] Lanes of(const Lanes& x) const noexcept
    {
        if constexpr (is_split)
            return x * first_ + x * second_;
        else
            return first_ * x / second_;
    }

  private:
    S first_, second_; ///< summands of unit/k; else the unit and k
};

namespace detail {

/// Squares of series, one a lane of the type Lanes: twice the half of the terms.
template <class Lanes, std::size_t length>
struct SquaredSeries {
    std::array<Lanes, length> a;

    [[nodiscard]] [[gnu::always_inline]] Lanes sum(std::size_t k) const noexcept
    {
        if (k < 2) return Lanes();
        if (k == 2) return a[1] * a[1];
        const std::size_t half = k / 2;
        Lanes even = k % 2 == 0 ? Lanes(a[half] * a[half]) : Lanes(), odd = Lanes();
        std::size_t j = 2;
        for (; 2 * j + 2 < k; j += 2) {
            odd += a[j] * a[k - j];
            even += (a[j + 1] + a[j + 1]) * a[k - j - 1];
        }
        if (2 * j < k) odd += a[j] * a[k - j];
        odd += a[1] * a[k - 1];
        return even + (odd + odd);
    }
};

/// Pairs of series, one a lane of the type Lanes. The terms go from the middle outwards, so that those with the latest
/// coefficients are last: the others need not wait for them.
template <class Lanes, std::size_t length>
struct PairedSeries {
    std::array<Lanes, length> a, b;

    [[nodiscard]] [[gnu::always_inline]] Lanes sum(std::size_t k) const noexcept
    {
        if (k < 2) return Lanes();
        Lanes even = Lanes(), odd = k % 2 == 0 ? Lanes(a[k / 2] * b[k / 2]) : Lanes();
        for (std::size_t j = (k - 1) / 2; j > 0; --j) {
            even += a[j] * b[k - j];
            odd += a[k - j] * b[j];
        }
        return even + odd;
    }
};

/// Sums of `count` pairs or squares of series, in registers of several lanes.
template <class S, int count, int most, template <class, std::size_t> class SeriesOf>
class SumsInLanes {
    static constexpr std::size_t size = static_cast<std::size_t>(count);
    static constexpr std::size_t width = register_lanes<S>;
    static constexpr std::size_t whole = size / width; ///< full registers
    static constexpr std::size_t rest = size % width;
    static constexpr std::size_t rest_width = rest == 0 ? 1 : std::bit_ceil(rest);
    static constexpr std::size_t length = static_cast<std::size_t>(most) + 1;
    using Register = typename RegisterOf<S, width>::type;
    using Rest = typename RegisterOf<S, rest_width>::type;

  public:
    using Entries = std::array<S, size>;

    /// The sum of every pair, from the coefficients of orders 1 .. k - 1.
    [[nodiscard]] [[gnu::always_inline]] Entries operator()(int k) const noexcept
    {
        Entries sums;
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < whole; ++m) store<width>(whole_[m].sum(order), m * width, width, sums);
        if constexpr (rest > 0) store<rest_width>(rest_.sum(order), whole * width, rest, sums);
        return sums;
    }

  protected:
    /// Takes the coefficients of order k of one side of every pair.
    template <class Side>
    [[gnu::always_inline]] void keep_side(int k, const Entries& entries, const Side& side) noexcept
    {
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < whole; ++m) side(whole_[m])[order] = load<Register, width>(entries, m * width);
        if constexpr (rest > 0) side(rest_)[order] = load<Rest, rest_width>(entries, whole * width);
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

    std::array<SeriesOf<Register, length>, whole> whole_;
    SeriesOf<Rest, rest == 0 ? 0 : length> rest_;
};

} // namespace detail

/// <a, b>_k of `count` pairs for orders k up to `most`.
template <class S, int count, int most>
class LowerSums : public detail::SumsInLanes<S, count, most, detail::PairedSeries> {
  public:
    using Entries = std::array<S, static_cast<std::size_t>(count)>;

    /// Takes the coefficients a_k and b_k of every pair.
    [[gnu::always_inline]] void keep(int k, const Entries& a, const Entries& b) noexcept
    {
        this->keep_side(
            k, a, [](auto& series) -> auto& { return series.a; });
        this->keep_side(
            k, b, [](auto& series) -> auto& { return series.b; });
    }
};

/// <a, a>_k of `count` series for orders k up to `most`.
template <class S, int count, int most>
class LowerSquares : public detail::SumsInLanes<S, count, most, detail::SquaredSeries> {
  public:
    using Entries = std::array<S, static_cast<std::size_t>(count)>;

    /// Takes the coefficient a_k of every series.
    [[gnu::always_inline]] void keep(int k, const Entries& a) noexcept
    {
        this->keep_side(
            k, a, [](auto& series) -> auto& { return series.a; });
    }
};

} // namespace lagen
