// SPDX-License-Identifier: MIT
/// Pack<T, N>: N lanes of T on the compiler's vector extension (g++, clang), a scalar for generated models and
/// fixed-step methods: N trajectories at once. N is a power of two. Comparisons answer a Mask, `select` chooses a lane,
/// a kernel answers a status a lane. sincos and square roots work on all lanes at once; the other elementary functions
/// are libm's, a lane at a time. A lane gets the bits that its scalar gets.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen/roots.hpp"
#include "lagen/sincos.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace lagen {

namespace detail {

template <std::size_t bytes>
struct IntegerOf;
template <>
struct IntegerOf<4> {
    using type = std::int32_t;
};
template <>
struct IntegerOf<8> {
    using type = std::int64_t;
};

// A member typedef is what both compilers take as a dependent vector type. The alignment is at most that of Eigen's
// arrays (16 bytes without AVX), because clang refuses an array less aligned than its entries.
template <class T, int N>
struct VectorOf {
    static constexpr std::size_t bytes = sizeof(T) * static_cast<std::size_t>(N);
    static constexpr std::size_t most = EIGEN_MAX_STATIC_ALIGN_BYTES < 16 ? 16 : EIGEN_MAX_STATIC_ALIGN_BYTES;
    typedef T type __attribute__((vector_size(bytes), aligned(bytes < most ? bytes : most)));
};

/// Is any bit of these 2^n bytes set?
template <std::size_t bytes>
[[nodiscard]] [[gnu::always_inline]] inline bool any_bit(const void* x) noexcept
{
    if constexpr (bytes <= sizeof(std::uint64_t)) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, x, bytes);
        return bits != 0;
    } else {
        typename VectorOf<std::int64_t, static_cast<int>(bytes / 16)>::type low, high;
        std::memcpy(&low, x, sizeof low);
        std::memcpy(&high, static_cast<const char*>(x) + sizeof low, sizeof high);
        low |= high;
        return any_bit<bytes / 2>(&low);
    }
}

} // namespace detail

/// A truth value a lane; lanes are 0 or -1 (all bits).
template <class T, int N>
struct Mask {
    using Vector = typename detail::VectorOf<typename detail::IntegerOf<sizeof(T)>::type, N>::type;
    Vector lanes;

    [[nodiscard]] bool operator[](int lane) const noexcept { return lanes[lane] != 0; }

    friend Mask operator&&(const Mask& a, const Mask& b) noexcept { return {a.lanes & b.lanes}; }
    friend Mask operator||(const Mask& a, const Mask& b) noexcept { return {a.lanes | b.lanes}; }
    friend Mask operator&(const Mask& a, const Mask& b) noexcept { return {a.lanes & b.lanes}; }
    friend Mask operator|(const Mask& a, const Mask& b) noexcept { return {a.lanes | b.lanes}; }
    friend Mask operator!(const Mask& a) noexcept { return {~a.lanes}; }
};

template <class T, int N>
[[nodiscard]] bool any(const Mask<T, N>& mask) noexcept
{
    return detail::any_bit<sizeof mask.lanes>(&mask.lanes);
}

template <class T, int N>
[[nodiscard]] bool all(const Mask<T, N>& mask) noexcept
{
    return !any(!mask);
}

/// N lanes of T with the arithmetic of T in each.
template <class T, int N>
struct Pack {
    static_assert(N > 1 && (N & (N - 1)) == 0, "the number of lanes is a power of two above 1");
    using Vector = typename detail::VectorOf<T, N>::type;
    Vector lanes;

    Pack() = default; ///< as a scalar: without a value, Pack{} is zero
    /// The same value in every lane.
    Pack(T value) noexcept : lanes(value - Vector{}) {} // which keeps the sign of 0
    /// A literal of generated code, S(0.5), rounded to a lane of float.
    explicit Pack(double value) noexcept requires(!std::is_same_v<T, double>) : Pack(static_cast<T>(value)) {}
    /// An integer literal in every lane.
    Pack(int value) noexcept requires(!std::is_same_v<T, int>) : Pack(static_cast<T>(value)) {}
    explicit Pack(const std::array<T, static_cast<std::size_t>(N)>& values) noexcept
    {
        std::memcpy(&lanes, values.data(), sizeof lanes);
    }

    [[nodiscard]] static Pack of(const Vector& vector) noexcept
    {
        Pack pack;
        pack.lanes = vector;
        return pack;
    }

    [[nodiscard]] T operator[](int lane) const noexcept { return lanes[lane]; }
    void set(int lane, T value) noexcept { lanes[lane] = value; }

    Pack& operator+=(const Pack& b) noexcept
    {
        lanes += b.lanes;
        return *this;
    }
    Pack& operator-=(const Pack& b) noexcept
    {
        lanes -= b.lanes;
        return *this;
    }
    Pack& operator*=(const Pack& b) noexcept
    {
        lanes *= b.lanes;
        return *this;
    }
    Pack& operator/=(const Pack& b) noexcept
    {
        lanes /= b.lanes;
        return *this;
    }

    friend Pack operator+(const Pack& a, const Pack& b) noexcept { return of(a.lanes + b.lanes); }
    friend Pack operator-(const Pack& a, const Pack& b) noexcept { return of(a.lanes - b.lanes); }
    friend Pack operator*(const Pack& a, const Pack& b) noexcept { return of(a.lanes * b.lanes); }
    friend Pack operator/(const Pack& a, const Pack& b) noexcept { return of(a.lanes / b.lanes); }
    friend Pack operator-(const Pack& a) noexcept { return of(-a.lanes); }
    friend Pack operator+(const Pack& a) noexcept { return a; }

    friend Mask<T, N> operator<(const Pack& a, const Pack& b) noexcept { return {a.lanes < b.lanes}; }
    friend Mask<T, N> operator>(const Pack& a, const Pack& b) noexcept { return {a.lanes > b.lanes}; }
    friend Mask<T, N> operator<=(const Pack& a, const Pack& b) noexcept { return {a.lanes <= b.lanes}; }
    friend Mask<T, N> operator>=(const Pack& a, const Pack& b) noexcept { return {a.lanes >= b.lanes}; }
    friend Mask<T, N> operator==(const Pack& a, const Pack& b) noexcept { return {a.lanes == b.lanes}; }
    friend Mask<T, N> operator!=(const Pack& a, const Pack& b) noexcept { return {a.lanes != b.lanes}; }
};

/// `where ? yes : no`, a lane.
template <class T, int N>
[[nodiscard]] Pack<T, N> select(const Mask<T, N>& where, const Pack<T, N>& yes, const Pack<T, N>& no) noexcept
{
    return Pack<T, N>::of(where.lanes ? yes.lanes : no.lanes);
}

namespace detail {

template <class T, int N, class Function>
[[nodiscard]] Pack<T, N> by_lane(const Pack<T, N>& a, Function function) noexcept
{
    Pack<T, N> result{};
    for (int lane = 0; lane < N; ++lane) result.set(lane, function(a[lane]));
    return result;
}

template <class T, int N, class Function>
[[nodiscard]] Pack<T, N> by_lane(const Pack<T, N>& a, const Pack<T, N>& b, Function function) noexcept
{
    Pack<T, N> result{};
    for (int lane = 0; lane < N; ++lane) result.set(lane, function(a[lane], b[lane]));
    return result;
}

} // namespace detail

/// All lanes at once.
template <class T, int N>
struct SinCosOf<Pack<T, N>> {
    [[nodiscard]] static SineCosine<Pack<T, N>> compute(const Pack<T, N>& x) noexcept
    {
        std::array<T, static_cast<std::size_t>(N)> angles;
        std::memcpy(&angles, &x.lanes, sizeof angles);
        const auto [sines, cosines] = sincos(angles);
        SineCosine<Pack<T, N>> result;
        std::memcpy(&result.sine.lanes, &sines, sizeof sines);
        std::memcpy(&result.cosine.lanes, &cosines, sizeof cosines);
        return result;
    }
};

template <class T, int N>
[[nodiscard]] Pack<T, N> sqrt(const Pack<T, N>& a) noexcept
{
#if defined(__AVX512F__) // with a mask: without one g++ 12 warns of what its own header leaves unset
    if constexpr (sizeof a == 64 && std::is_same_v<T, double>)
        return Pack<T, N>::of(reinterpret_cast<typename Pack<T, N>::Vector>(
            _mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a.lanes))));
    if constexpr (sizeof a == 64 && std::is_same_v<T, float>)
        return Pack<T, N>::of(reinterpret_cast<typename Pack<T, N>::Vector>(
            _mm512_maskz_sqrt_ps(0xffff, reinterpret_cast<__m512>(a.lanes))));
#endif
    std::array<T, static_cast<std::size_t>(N)> lanes;
    std::memcpy(&lanes, &a.lanes, sizeof lanes);
    lanes = square_roots(lanes);
    Pack<T, N> result;
    std::memcpy(&result.lanes, &lanes, sizeof lanes);
    return result;
}

// clang-format off
#define LAGEN_PACK_FUNCTION(name) \
    template <class T, int N> [[nodiscard]] Pack<T, N> name(const Pack<T, N>& a) noexcept \
    { return detail::by_lane(a, [](T x) { return std::name(x); }); }
LAGEN_PACK_FUNCTION(sin) LAGEN_PACK_FUNCTION(cos) LAGEN_PACK_FUNCTION(tan)
LAGEN_PACK_FUNCTION(asin) LAGEN_PACK_FUNCTION(acos) LAGEN_PACK_FUNCTION(atan)
LAGEN_PACK_FUNCTION(sinh) LAGEN_PACK_FUNCTION(cosh) LAGEN_PACK_FUNCTION(tanh)
LAGEN_PACK_FUNCTION(exp) LAGEN_PACK_FUNCTION(log) LAGEN_PACK_FUNCTION(erf)
#undef LAGEN_PACK_FUNCTION
    // clang-format on

    template <class T, int N>
    [[nodiscard]] Pack<T, N> abs(const Pack<T, N>& a) noexcept
{
    using Bits = typename Mask<T, N>::Vector;
    using Vector = typename Pack<T, N>::Vector;
    return Pack<T, N>::of(
        reinterpret_cast<Vector>(reinterpret_cast<Bits>(a.lanes) & ~reinterpret_cast<Bits>(-Vector{})));
}

template <class T, int N>
[[nodiscard]] Pack<T, N> fabs(const Pack<T, N>& a) noexcept
{
    return abs(a);
}

template <class T, int N>
[[nodiscard]] Pack<T, N> atan2(const Pack<T, N>& y, const Pack<T, N>& x) noexcept
{
    return detail::by_lane(y, x, [](T a, T b) { return std::atan2(a, b); });
}

template <class T, int N>
[[nodiscard]] Pack<T, N> pow(const Pack<T, N>& x, const Pack<T, N>& y) noexcept
{
    return detail::by_lane(x, y, [](T a, T b) { return std::pow(a, b); });
}

template <class T, int N>
[[nodiscard]] Pack<T, N> min(const Pack<T, N>& a, const Pack<T, N>& b) noexcept
{
    return select(b < a, b, a);
}

template <class T, int N>
[[nodiscard]] Pack<T, N> max(const Pack<T, N>& a, const Pack<T, N>& b) noexcept
{
    return select(a < b, b, a);
}

/// A status a lane.
template <int N>
struct PackStatus {
    std::array<Status, static_cast<std::size_t>(N)> lanes{};

    [[nodiscard]] Status operator[](int lane) const noexcept { return lanes[static_cast<std::size_t>(lane)]; }
    friend bool operator==(const PackStatus&, const PackStatus&) = default;
};

template <class T, int N>
struct StatusOf<Pack<T, N>> {
    using type = PackStatus<N>;
    using mask = Mask<T, N>;
    [[nodiscard]] static type good() noexcept { return {}; }
    static void fail(type& status, const mask& where, Status reason) noexcept
    {
        if (!any(where)) [[likely]]
            return;
        for (int lane = 0; lane < N; ++lane)
            StatusOf<T>::fail(status.lanes[static_cast<std::size_t>(lane)], where[lane], reason);
    }
    /// A condition that does not depend on the lane (a parameter).
    static void fail(type& status, bool where, Status reason) noexcept
    {
        for (Status& lane : status.lanes) StatusOf<T>::fail(lane, where, reason);
    }
    [[nodiscard]] static bool all_good(const type& status) noexcept
    {
        return !detail::any_bit<sizeof status.lanes>(&status.lanes);
    }
    [[nodiscard]] static type first(type earlier, const type& later) noexcept
    {
        if (all_good(later)) [[likely]]
            return earlier;
        for (std::size_t lane = 0; lane < earlier.lanes.size(); ++lane)
            earlier.lanes[lane] = StatusOf<T>::first(earlier.lanes[lane], later.lanes[lane]);
        return earlier;
    }
};

template <class T, int N>
struct RealOf<Pack<T, N>> {
    using type = T;
    static constexpr int lanes = N;
};

} // namespace lagen

/// What Eigen needs to hold packs: the limits of one lane.
template <class T, int N>
struct Eigen::NumTraits<lagen::Pack<T, N>> : Eigen::GenericNumTraits<lagen::Pack<T, N>> {
    using Real = lagen::Pack<T, N>;
    using NonInteger = lagen::Pack<T, N>;
    using Nested = lagen::Pack<T, N>;
    using Literal = lagen::Pack<T, N>;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
    static Real epsilon() { return Real(std::numeric_limits<T>::epsilon()); }
    static Real dummy_precision() { return Real(Eigen::NumTraits<T>::dummy_precision()); }
    static Real highest() { return Real(std::numeric_limits<T>::max()); }
    static Real lowest() { return Real(std::numeric_limits<T>::lowest()); }
    static int digits10() { return std::numeric_limits<T>::digits10; }
};
