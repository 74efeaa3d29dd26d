// SPDX-License-Identifier: MIT
/// Vector registers: how many bytes the widest one holds that the compiler may use, how many numbers, and their types.
#pragma once

#include "lagen/requirements.hpp"

#include <cstddef>
#include <type_traits>

namespace lagen::detail {

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

} // namespace lagen::detail
