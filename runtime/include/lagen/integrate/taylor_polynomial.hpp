// SPDX-License-Identifier: MIT
/// Values of Taylor polynomials, several functions in a vector register.
#pragma once

#include "lagen/lanes/lanes.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

namespace lagen::detail {

/// `width` lanes of a row or a column of S, from lane `at`.
template <class S, std::size_t at, std::size_t width>
struct Part {
    using Register = typename RegisterOf<S, width>::type;

    template <class Lanes>
    [[nodiscard]] [[gnu::always_inline]] static Register load(const Lanes& lanes) noexcept
    {
        Register result;
        if constexpr (width == 1)
            result = lanes.data()[at];
        else
            std::memcpy(&result, lanes.data() + at, sizeof result);
        return result;
    }
    template <class Lanes>
    [[gnu::always_inline]] static void store(Lanes& lanes, const Register& from) noexcept
    {
        if constexpr (width == 1)
            lanes.data()[at] = from;
        else
            std::memcpy(lanes.data() + at, &from, sizeof from);
    }
};

/// sum_{k=1}^{order} x_k h^{k-1} and, where it is asked for, sum_{k=1}^{order} k x_k h^{k-1} of n functions. Even and
/// odd powers stand apart, so that a sum waits half as often for the one before it, and all functions are in one loop,
/// as many at once as a vector register of S holds: from lane `at` here, the others in `rest_`.
template <class S, std::size_t n, bool with_slope, std::size_t at = 0>
class PolynomialSums {
    static constexpr std::size_t width = std::min(register_lanes<S>, std::bit_floor(n - at));
    static constexpr bool has_rest = at + width < n;
    using Own = Part<S, at, width>;
    using Register = typename Own::Register;

  public:
    template <class Series>
    [[gnu::always_inline]] PolynomialSums(const Series& x, int order, const S& h) noexcept
        : PolynomialSums(x, order, order % 2 == 0)
    {
        const S square = h * h;
        for (int k = order - 2 + order % 2; k > 0; k -= 2) add(x, k, square);
        join(h);
    }

    /// work(part, sum, slope) for one register after another.
    template <class Work>
    [[gnu::always_inline]] void each(const Work& work) const noexcept
    {
        work(Own(), low_, low_slope_);
        if constexpr (has_rest) rest_.each(work);
    }

  private:
    template <class, std::size_t, bool, std::size_t>
    friend class PolynomialSums;
    struct Nothing {
        template <class Series>
        [[gnu::always_inline]] Nothing(const Series&, int, bool) noexcept
        {
        }
    };
    struct Rest {
        using type = PolynomialSums<S, n, with_slope, at + width>;
    };
    struct NoRest {
        using type = Nothing;
    };

    template <class Series>
    [[gnu::always_inline]] PolynomialSums(const Series& x, int order, bool is_even) noexcept
        : high_(Own::load(x[order])), low_(is_even ? Own::load(x[order - 1]) : high_), rest_(x, order, is_even)
    {
        if constexpr (with_slope) {
            high_slope_ = S(order) * high_;
            low_slope_ = is_even ? Register(S(order - 1) * low_) : high_slope_;
        }
        if (!is_even) high_ = high_slope_ = Register{};
    }

    /// Orders k and k - 1.
    template <class Series>
    [[gnu::always_inline]] void add(const Series& x, int k, const S& square) noexcept
    {
        const Register high = Own::load(x[k]), low = Own::load(x[k - 1]);
        high_ = high + square * high_;
        low_ = low + square * low_;
        if constexpr (with_slope) {
            high_slope_ = S(k) * high + square * high_slope_;
            low_slope_ = S(k - 1) * low + square * low_slope_;
        }
        if constexpr (has_rest) rest_.add(x, k, square);
    }

    [[gnu::always_inline]] void join(const S& h) noexcept
    {
        low_ = low_ + h * high_;
        if constexpr (with_slope) low_slope_ = low_slope_ + h * high_slope_;
        if constexpr (has_rest) rest_.join(h);
    }

    Register high_, low_, high_slope_{}, low_slope_{};
    [[no_unique_address]] typename std::conditional_t<has_rest, Rest, NoRest>::type rest_;
};

/// The same of as many functions as the series has at run time: of four registers of them at a time, then of half as
/// many, .., of one function. A sum has the same bits in every way.
template <class S, bool with_slope, class Series>
class PolynomialSumsLater {
  public:
    [[gnu::always_inline]] PolynomialSumsLater(const Series& x, int order, const S& h) noexcept
        : x_(x), order_(order), h_(h)
    {
    }

    template <class Work>
    [[gnu::always_inline]] void each(const Work& work) const noexcept
    {
        for_blocks<4 * register_lanes<S>>(0, work);
    }

  private:
    /// The series of the functions from `first` on, and a part of the lanes from there on.
    struct SeriesBehind {
        const Series& x;
        std::size_t first;
        [[nodiscard]] [[gnu::always_inline]] LanePlace<const S> operator[](int k) const noexcept
        {
            return {x[k].data() + first};
        }
    };
    template <class Part>
    struct PartBehind {
        using Register = typename Part::Register;
        std::size_t first;

        template <class Lanes>
        [[nodiscard]] [[gnu::always_inline]] Register load(const Lanes& lanes) const noexcept
        {
            return Part::load(LanePlace<const S>{lanes.data() + first});
        }
        template <class Lanes>
        [[gnu::always_inline]] void store(Lanes& lanes, const Register& from) const noexcept
        {
            LanePlace<S> place{lanes.data() + first};
            Part::store(place, from);
        }
    };

    template <std::size_t width, class Work>
    [[gnu::always_inline]] void for_blocks(std::size_t first, const Work& work) const noexcept
    {
        for (; first + width <= x_[0].size(); first += width)
            PolynomialSums<S, width, with_slope>(SeriesBehind{x_, first}, order_, h_)
                .each([&]<class Part>(Part, const auto& sum, const auto& slope)
                          __attribute__((always_inline)) { work(PartBehind<Part>{first}, sum, slope); });
        if constexpr (width > 1) for_blocks<width / 2>(first, work);
    }

    const Series& x_;
    int order_;
    S h_;
};

/// Those of the functions of a series.
template <bool with_slope, class S, int n, int most>
[[nodiscard]] [[gnu::always_inline]] inline auto polynomial_sums(const TaylorSeries<S, n, most>& x, int order,
                                                                 const S& h) noexcept
{
    if constexpr (n < 0)
        return PolynomialSumsLater<S, with_slope, TaylorSeries<S, n, most>>(x, order, h);
    else
        return PolynomialSums<S, static_cast<std::size_t>(n), with_slope>(x, order, h);
}

} // namespace lagen::detail
