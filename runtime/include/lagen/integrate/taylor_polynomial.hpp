// SPDX-License-Identifier: MIT
/// Values of Taylor polynomials, several functions in a vector register.
#pragma once

#include "lagen/series.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
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

} // namespace lagen::detail
