// SPDX-License-Identifier: MIT
/// Square roots that set no errno, and many square roots or reciprocals at once.
///   using arithmetic::sqrt;                                   // sqrt(x) of float, double, long double
///   const auto roots = square_roots<S, 3>({a, b, c});
///   const auto inverses = reciprocals<S, 3>({a, b, c});
/// The library's sqrt must set errno, so compilers put a branch and a call behind each of its square roots and keep no
/// value in a register across it. Division and square root are the slowest instructions of a processor; on a vector of
/// two to eight numbers they take about as long as on one. Every result is rounded correctly, one by one or together.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h> // the other one has 30 thousand lines
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace lagen {

namespace arithmetic {

/// The square root; NaN where x < 0. Other scalars bring their own.
[[nodiscard]] inline double sqrt(double x) noexcept
{
#if defined(__SSE2__)
    const __m128d lanes = _mm_set_sd(x);
    return _mm_cvtsd_f64(_mm_sqrt_sd(lanes, lanes));
#elif defined(__aarch64__)
    return vget_lane_f64(vsqrt_f64(vdup_n_f64(x)), 0);
#else
    return std::sqrt(x);
#endif
}

[[nodiscard]] inline float sqrt(float x) noexcept
{
#if defined(__SSE2__)
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
#elif defined(__aarch64__)
    return vget_lane_f32(vsqrt_f32(vdup_n_f32(x)), 0);
#else
    return std::sqrt(x);
#endif
}

[[nodiscard]] inline long double sqrt(long double x) noexcept
{
    return std::sqrt(x);
}

} // namespace arithmetic

namespace detail {

#if defined(__SSE2__)
// Registers of 32 bytes, or 16: built from their numbers one by one, because a load from numbers stored one by one a
// moment ago has to wait for the stores. For the same reason 64 bytes gain nothing.
#if defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
[[gnu::always_inline]] inline __m256d gather(const double* x) noexcept
{
    return _mm256_setr_pd(x[0], x[1], x[2], x[3]);
}
[[gnu::always_inline]] inline __m256 gather(const float* x) noexcept
{
    return _mm256_setr_ps(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
}
[[gnu::always_inline]] inline void roots_of_register(double* x) noexcept
{
    _mm256_storeu_pd(x, _mm256_sqrt_pd(gather(x)));
}
[[gnu::always_inline]] inline void roots_of_register(float* x) noexcept
{
    _mm256_storeu_ps(x, _mm256_sqrt_ps(gather(x)));
}
[[gnu::always_inline]] inline void reciprocals_of_register(double* x) noexcept
{
    _mm256_storeu_pd(x, _mm256_div_pd(_mm256_set1_pd(1), gather(x)));
}
[[gnu::always_inline]] inline void reciprocals_of_register(float* x) noexcept
{
    _mm256_storeu_ps(x, _mm256_div_ps(_mm256_set1_ps(1), gather(x)));
}
#else
inline constexpr std::size_t register_bytes = 16;
[[gnu::always_inline]] inline __m128d gather(const double* x) noexcept
{
    return _mm_setr_pd(x[0], x[1]);
}
[[gnu::always_inline]] inline __m128 gather(const float* x) noexcept
{
    return _mm_setr_ps(x[0], x[1], x[2], x[3]);
}
[[gnu::always_inline]] inline void roots_of_register(double* x) noexcept
{
    _mm_storeu_pd(x, _mm_sqrt_pd(gather(x)));
}
[[gnu::always_inline]] inline void roots_of_register(float* x) noexcept
{
    _mm_storeu_ps(x, _mm_sqrt_ps(gather(x)));
}
[[gnu::always_inline]] inline void reciprocals_of_register(double* x) noexcept
{
    _mm_storeu_pd(x, _mm_div_pd(_mm_set1_pd(1), gather(x)));
}
[[gnu::always_inline]] inline void reciprocals_of_register(float* x) noexcept
{
    _mm_storeu_ps(x, _mm_div_ps(_mm_set1_ps(1), gather(x)));
}
#endif
template <class T>
inline constexpr std::size_t per_register = std::is_same_v<T, double> || std::is_same_v<T, float>
                                                ? register_bytes / sizeof(T)
                                                : 0;
#else
template <class T>
inline constexpr std::size_t per_register = 0;
template <class T>
void roots_of_register(T* x) noexcept = delete;
template <class T>
void reciprocals_of_register(T* x) noexcept = delete;
#endif

/// `work` on the registers 0 .. sizeof...(part) - 1 of x, written out: what is in registers stays there.
template <class T, std::size_t K, class Work, std::size_t... part>
[[gnu::always_inline]] inline void on_registers([[maybe_unused]] std::array<T, K>& x, [[maybe_unused]] Work work,
                                                std::index_sequence<part...>) noexcept
{
    (work(&x[part * per_register<T>]), ...);
}

} // namespace detail

/// The square roots of K numbers.
template <class S, std::size_t K>
[[nodiscard, gnu::always_inline]] inline std::array<S, K> square_roots(std::array<S, K> x) noexcept
{
    std::size_t k = 0;
    if constexpr (constexpr std::size_t step = detail::per_register<S>; step > 0) {
        detail::on_registers(
            x, [](S* part) { detail::roots_of_register(part); }, std::make_index_sequence<K / step>{});
        k = K / step * step;
    }
    using arithmetic::sqrt;
    for (; k < K; ++k) x[k] = sqrt(x[k]);
    return x;
}

/// 1/x of K numbers.
template <class S, std::size_t K>
[[nodiscard, gnu::always_inline]] inline std::array<S, K> reciprocals(std::array<S, K> x) noexcept
{
    std::size_t k = 0;
    if constexpr (constexpr std::size_t step = detail::per_register<S>; step > 0) {
        detail::on_registers(
            x, [](S* part) { detail::reciprocals_of_register(part); }, std::make_index_sequence<K / step>{});
        k = K / step * step;
    }
    for (; k < K; ++k) x[k] = S(1) / x[k];
    return x;
}

} // namespace lagen
