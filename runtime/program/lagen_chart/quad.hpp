// SPDX-License-Identifier: MIT
/// `lagen::Quad`: a number of 113 bits, the compiler's __float128 with the functions of libquadmath, as a scalar of
/// generated models: g++ and clang++ know the type where a strict standard library has no functions of it.
#pragma once

#include <concepts>
#include <limits>
#include <type_traits>

extern "C" {
__float128 acosq(__float128);
__float128 asinq(__float128);
__float128 atan2q(__float128, __float128);
__float128 atanq(__float128);
__float128 cbrtq(__float128);
__float128 cosq(__float128);
__float128 coshq(__float128);
__float128 erfq(__float128);
__float128 expq(__float128);
__float128 fabsq(__float128);
__float128 logq(__float128);
__float128 powq(__float128, __float128);
__float128 sinq(__float128);
__float128 sinhq(__float128);
__float128 sqrtq(__float128);
__float128 tanq(__float128);
__float128 tanhq(__float128);
}

namespace lagen {

struct Quad {
    __float128 number = 0;

    constexpr Quad() noexcept = default;
    // Like a built-in number it is made of other numbers unasked.
    template <std::integral T>
    constexpr Quad(T x) noexcept : number(static_cast<__float128>(x))
    {
    }
    constexpr Quad(double x) noexcept : number(x) {}
    constexpr Quad(long double x) noexcept : number(x) {}

    [[nodiscard]] static constexpr Quad of(__float128 x) noexcept
    {
        Quad result;
        result.number = x;
        return result;
    }

    template <class T>
    requires std::is_arithmetic_v<T>
    explicit constexpr operator T() const noexcept { return static_cast<T>(number); }

    constexpr Quad operator-() const noexcept { return of(-number); }
    constexpr Quad& operator+=(Quad x) noexcept { return number += x.number, *this; }
    constexpr Quad& operator-=(Quad x) noexcept { return number -= x.number, *this; }
    constexpr Quad& operator*=(Quad x) noexcept { return number *= x.number, *this; }
    constexpr Quad& operator/=(Quad x) noexcept { return number /= x.number, *this; }

    friend constexpr Quad operator+(Quad x, Quad y) noexcept { return of(x.number + y.number); }
    friend constexpr Quad operator-(Quad x, Quad y) noexcept { return of(x.number - y.number); }
    friend constexpr Quad operator*(Quad x, Quad y) noexcept { return of(x.number * y.number); }
    friend constexpr Quad operator/(Quad x, Quad y) noexcept { return of(x.number / y.number); }
    friend constexpr bool operator==(Quad x, Quad y) noexcept { return x.number == y.number; }
    friend constexpr bool operator!=(Quad x, Quad y) noexcept { return x.number != y.number; }
    friend constexpr bool operator<(Quad x, Quad y) noexcept { return x.number < y.number; }
    friend constexpr bool operator>(Quad x, Quad y) noexcept { return x.number > y.number; }
    friend constexpr bool operator<=(Quad x, Quad y) noexcept { return x.number <= y.number; }
    friend constexpr bool operator>=(Quad x, Quad y) noexcept { return x.number >= y.number; }

    friend Quad abs(Quad x) noexcept { return of(fabsq(x.number)); }
    friend Quad acos(Quad x) noexcept { return of(acosq(x.number)); }
    friend Quad asin(Quad x) noexcept { return of(asinq(x.number)); }
    friend Quad atan(Quad x) noexcept { return of(atanq(x.number)); }
    friend Quad atan2(Quad y, Quad x) noexcept { return of(atan2q(y.number, x.number)); }
    friend Quad cbrt(Quad x) noexcept { return of(cbrtq(x.number)); }
    friend Quad cos(Quad x) noexcept { return of(cosq(x.number)); }
    friend Quad cosh(Quad x) noexcept { return of(coshq(x.number)); }
    friend Quad erf(Quad x) noexcept { return of(erfq(x.number)); }
    friend Quad exp(Quad x) noexcept { return of(expq(x.number)); }
    friend Quad log(Quad x) noexcept { return of(logq(x.number)); }
    friend Quad pow(Quad x, Quad y) noexcept { return of(powq(x.number, y.number)); }
    friend Quad sin(Quad x) noexcept { return of(sinq(x.number)); }
    friend Quad sinh(Quad x) noexcept { return of(sinhq(x.number)); }
    friend Quad sqrt(Quad x) noexcept { return of(sqrtq(x.number)); }
    friend Quad tan(Quad x) noexcept { return of(tanq(x.number)); }
    friend Quad tanh(Quad x) noexcept { return of(tanhq(x.number)); }
};

} // namespace lagen

template <>
class std::numeric_limits<lagen::Quad> {
    static constexpr __float128 power(int exponent) noexcept
    {
        __float128 result = 1;
        for (; exponent > 0; --exponent) result *= 2;
        for (; exponent < 0; ++exponent) result /= 2;
        return result;
    }

  public:
    static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
    static constexpr bool has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false, is_iec559 = true;
    static constexpr bool is_bounded = true, is_modulo = false, traps = false, tinyness_before = false;
    static constexpr int digits = 113, digits10 = 33, max_digits10 = 36, radix = 2;
    static constexpr int min_exponent = -16381, max_exponent = 16384;
    static constexpr lagen::Quad epsilon() noexcept { return lagen::Quad::of(power(-112)); }
    static constexpr lagen::Quad min() noexcept { return lagen::Quad(std::numeric_limits<double>::min()); }
    static constexpr lagen::Quad max() noexcept { return lagen::Quad(std::numeric_limits<double>::max()); }
    static constexpr lagen::Quad lowest() noexcept { return -max(); }
    static constexpr lagen::Quad infinity() noexcept { return std::numeric_limits<double>::infinity(); }
    static constexpr lagen::Quad quiet_NaN() noexcept { return std::numeric_limits<double>::quiet_NaN(); }
};
