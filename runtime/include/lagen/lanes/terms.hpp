// SPDX-License-Identifier: MIT
/// Terms of one formula that are alike (the pairs of many bodies), a lane each, and their Taylor series:
///   const auto v0 = Terms<S, 3>::of(a, b, c) - Terms<S, 3>::of(b, c, a);
///   const auto v1 = inverse_cubes_of_roots(v0 * v0);
///   const auto v1_lanes = v1.lanes();                        // v1_lanes[2]
/// float and double stand in vector registers; lanes beyond the last repeat it. Other scalars, packs among them, are
/// taken one by one. Every lane gets what the same operations on scalars give, bit for bit but for
/// inverse_cubes_of_roots with AVX-512, where it is nearer to the exact number (not with -DLAGEN_SAME_BITS).
#pragma once

#include "lagen/roots.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lagen {

namespace detail {

/// The square root of every lane of a register.
template <class S, class Register>
[[nodiscard]] [[gnu::always_inline]] inline Register root_of_register(const Register& x) noexcept
{
    if constexpr (std::is_same_v<S, Register>) {
        using arithmetic::sqrt;
        return sqrt(x);
    } else {
        std::array<S, sizeof(Register) / sizeof(S)> numbers;
        std::memcpy(&numbers, &x, sizeof x);
        numbers = square_roots<S, numbers.size()>(numbers);
        Register result;
        std::memcpy(&result, &numbers, sizeof result);
        return result;
    }
}

#if defined(__AVX512F__) && !defined(LAGEN_SAME_BITS)
/// x^(-3/2) of eight doubles, within 0.51 units in the last place. y is 1/sqrt(x) to 13 bits or more, and of 17 bits,
/// so that its square and its cube are exact; with e = 1 - x y^2, |e| < 2^-12,
///   x^(-3/2) = y^3 (1 - e)^(-3/2) = y^3 (1 + 3/2 e + 15/8 e^2 + 35/16 e^3 + 315/128 e^4 + ..).
/// Of 0, of infinity and of negative numbers it is not finite, or not a number.
[[nodiscard]] [[gnu::always_inline]] inline __m512d inverse_cubes_of_register(__m512d x) noexcept
{
    const __m512i leading = _mm512_set1_epi64(-(std::int64_t(1) << 36));
    const __m512d y =
        _mm512_castsi512_pd(_mm512_and_epi64(_mm512_castpd_si512(_mm512_maskz_rsqrt14_pd(0xff, x)), leading));
    const __m512d square = y * y, cube = square * y;
    const __m512d e = _mm512_fnmadd_pd(x, square, _mm512_set1_pd(1));
    __m512d sum = _mm512_fmadd_pd(e, _mm512_set1_pd(2.4609375), _mm512_set1_pd(2.1875));
    sum = _mm512_fmadd_pd(e, sum, _mm512_set1_pd(1.875));
    sum = _mm512_fmadd_pd(e, sum, _mm512_set1_pd(1.5));
    return _mm512_fmadd_pd(cube, e * sum, cube);
}
#endif

} // namespace detail

/// n numbers and the arithmetic of each.
template <class S, std::size_t n>
class Terms {
  public:
    static constexpr std::size_t width = std::min(detail::register_lanes<S>, std::bit_ceil(n));
    static constexpr std::size_t count = (n + width - 1) / width; ///< of registers
    using Register = typename detail::RegisterOf<S, width>::type;

    /// n numbers.
    template <class... Numbers>
    [[nodiscard]] [[gnu::always_inline]] static Terms of(const Numbers&... numbers) noexcept
    {
        static_assert(sizeof...(Numbers) == n);
        const std::array<S, n> lanes{numbers...};
        return each([&](std::size_t k) __attribute__((always_inline)) { return load(lanes, k * width); });
    }

    /// The result of `work` on register after register.
    template <class Work>
    [[nodiscard]] [[gnu::always_inline]] static Terms each(const Work& work) noexcept
    {
        Terms result;
        result.fill(work);
        return result;
    }

    /// With those beyond the last, so that a register is stored whole.
    [[nodiscard]] [[gnu::always_inline]] std::array<S, count * width> lanes() const noexcept
    {
        std::array<S, count * width> numbers;
        if constexpr (width == 1) {
            std::copy_n(registers_.begin(), n, numbers.begin());
        } else {
            std::memcpy(&numbers, &registers_, sizeof numbers);
        }
        return numbers;
    }
    [[nodiscard]] [[gnu::always_inline]] S operator[](std::size_t lane) const noexcept { return lanes()[lane]; }

    [[nodiscard]] [[gnu::always_inline]] static Register zeros() noexcept
    {
        if constexpr (width == 1)
            return S(0);
        else
            return Register{};
    }
    [[nodiscard]] [[gnu::always_inline]] Register& part(std::size_t k) noexcept { return registers_[k]; }
    [[nodiscard]] [[gnu::always_inline]] const Register& part(std::size_t k) const noexcept { return registers_[k]; }

    [[gnu::always_inline]] friend Terms operator+(const Terms& a, const Terms& b) noexcept
    {
        return each([&](std::size_t k) __attribute__((always_inline)) { return a.registers_[k] + b.registers_[k]; });
    }
    [[gnu::always_inline]] friend Terms operator-(const Terms& a, const Terms& b) noexcept
    {
        return each([&](std::size_t k) __attribute__((always_inline)) { return a.registers_[k] - b.registers_[k]; });
    }
    [[gnu::always_inline]] friend Terms operator*(const Terms& a, const Terms& b) noexcept
    {
        return each([&](std::size_t k) __attribute__((always_inline)) { return a.registers_[k] * b.registers_[k]; });
    }
    [[gnu::always_inline]] friend Terms operator/(const Terms& a, const Terms& b) noexcept
    {
        return each([&](std::size_t k) __attribute__((always_inline)) { return a.registers_[k] / b.registers_[k]; });
    }
    [[gnu::always_inline]] friend Terms operator-(const Terms& a) noexcept
    {
        return each([&](std::size_t k) __attribute__((always_inline)) { return -a.registers_[k]; });
    }
    [[gnu::always_inline]] friend Terms operator*(const OneOver<S>& a, const Terms& b) noexcept { return a.of(b); }
    [[gnu::always_inline]] friend Terms operator+(const S& a, const Terms& b) noexcept { return all(a) + b; }
    [[gnu::always_inline]] friend Terms operator-(const S& a, const Terms& b) noexcept { return all(a) - b; }
    [[gnu::always_inline]] friend Terms operator*(const S& a, const Terms& b) noexcept { return all(a) * b; }
    [[gnu::always_inline]] friend Terms operator/(const S& a, const Terms& b) noexcept { return all(a) / b; }
    [[gnu::always_inline]] friend Terms operator+(const Terms& a, const S& b) noexcept { return a + all(b); }
    [[gnu::always_inline]] friend Terms operator-(const Terms& a, const S& b) noexcept { return a - all(b); }
    [[gnu::always_inline]] friend Terms operator*(const Terms& a, const S& b) noexcept { return a * all(b); }
    [[gnu::always_inline]] friend Terms operator/(const Terms& a, const S& b) noexcept { return a / all(b); }
    /// 1/(x sqrt(x)).
    [[nodiscard]] [[gnu::always_inline]] friend Terms inverse_cubes_of_roots(const Terms& a) noexcept
    {
#if defined(__AVX512F__) && !defined(LAGEN_SAME_BITS)
        if constexpr (std::is_same_v<S, double> && width == 8)
            return each([&](std::size_t k) __attribute__((always_inline)) {
                return detail::inverse_cubes_of_register(a.registers_[k]);
            });
        if constexpr (is_pack<S> && sizeof(S) == 64 && std::is_same_v<real_t<S>, double>) // a lane what its scalar gets
            return each([&](std::size_t k) __attribute__((always_inline)) {
                const auto lanes = reinterpret_cast<__m512d>(a.registers_[k].lanes);
                return S::of(reinterpret_cast<typename S::Vector>(detail::inverse_cubes_of_register(lanes)));
            });
#endif
        return S(1) / (a * sqrt(a));
    }
    [[gnu::always_inline]] friend Terms sqrt(const Terms& a) noexcept
    {
        return each([&](std::size_t k)
                        __attribute__((always_inline)) { return detail::root_of_register<S>(a.registers_[k]); });
    }

  private:
    template <class Work>
    [[gnu::always_inline]] void fill(const Work& work) noexcept
    {
        [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline))
        {
            ((registers_[k] = work(k)), ...);
        }
        (std::make_index_sequence<count>{});
    }

    /// The same number in every lane.
    [[nodiscard]] [[gnu::always_inline]] static Terms all(const S& x) noexcept
    {
        return each([&](std::size_t) __attribute__((always_inline)) {
            if constexpr (width == 1)
                return x;
            else
                return Register{} + x;
        });
    }

    [[nodiscard]] [[gnu::always_inline]] static Register load(const std::array<S, n>& numbers, std::size_t at) noexcept
    {
        if constexpr (width == 1)
            return numbers[at];
        else
            return [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline))
            {
                return Register{numbers[std::min(at + i, n - 1)]...};
            }
        (std::make_index_sequence<width>{});
    }

    std::array<Register, count> registers_;
};

/// Coefficients of `count` series of n terms, of orders up to `most`, for sums over lower orders (lagen/series.hpp).
template <class S, std::size_t n, std::size_t count, int most>
class TermSeries {
  public:
    using Lanes = Terms<S, n>;

    /// Takes the coefficients of order k of every series.
    [[gnu::always_inline]] void keep(int k, const std::array<Lanes, count>& terms) noexcept
    {
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < Lanes::count; ++m)
            for (std::size_t i = 0; i < count; ++i) rows_[m][order][i] = terms[i].part(m);
    }

    /// <a, b>_k of the pairs of series a, b, a, b, .., from the coefficients of orders 1 .. k - 1. The latest are last:
    /// the others need not wait for them.
    template <std::size_t... factors>
    [[nodiscard]] [[gnu::always_inline]] std::array<Lanes, sizeof...(factors) / 2> sums(int k) const noexcept
    {
        constexpr std::array<std::size_t, sizeof...(factors)> of{factors...};
        constexpr std::size_t pairs = sizeof...(factors) / 2;
        std::array<Lanes, pairs> result;
        const auto order = static_cast<std::size_t>(k);
        for (std::size_t m = 0; m < Lanes::count; ++m)
            [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline))
            {
                const auto& a = rows_[m];
                std::array<typename Lanes::Register, pairs> sum{(static_cast<void>(i), Lanes::zeros())...};
                for (std::size_t j = 2; j + 1 < order; ++j)
                    ((sum[i] += a[j][of[2 * i]] * a[order - j][of[2 * i + 1]]), ...);
                if (order > 2) ((sum[i] += a[1][of[2 * i]] * a[order - 1][of[2 * i + 1]]), ...);
                if (order > 1) ((sum[i] += a[order - 1][of[2 * i]] * a[1][of[2 * i + 1]]), ...);
                ((result[i].part(m) = sum[i]), ...);
            }
        (std::make_index_sequence<pairs>{});
        return result;
    }

  private:
    using Row = std::array<typename Lanes::Register, count>;
    std::array<std::array<Row, static_cast<std::size_t>(most) + 1>, Lanes::count> rows_;
};

} // namespace lagen
