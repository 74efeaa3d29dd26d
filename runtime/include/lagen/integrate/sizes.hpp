// SPDX-License-Identifier: MIT
/// Sizes that are a constant of a type or known at run time, and the numbers that there are so many of: in place, or on
/// the heap, where they take memory when their size is set and none afterwards. Algorithms are written once for both.
#pragma once

#include "lagen/requirements.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace lagen::detail {

/// In the place of a size that is known at run time.
inline constexpr std::size_t sized_later = static_cast<std::size_t>(-1);

/// The number of lanes of a model.
template <class M>
inline constexpr std::size_t size_of_state = M::dimension < 0 ? sized_later : static_cast<std::size_t>(M::dimension);

/// The number of its base lanes; the whole of its lanes where it has no others.
template <class M>
inline constexpr std::size_t base_size = [] {
    if constexpr (M::dimension < 0)
        return sized_later;
    else
        return static_cast<std::size_t>(M::base_dimension);
}();

template <std::size_t size>
struct Size {
    constexpr Size() = default;
    constexpr explicit Size(std::size_t) noexcept {}
    constexpr operator std::size_t() const noexcept { return size; }
};
template <>
struct Size<sized_later> {
    constexpr Size() = default;
    constexpr explicit Size(std::size_t size) noexcept : size_(size) {}
    constexpr operator std::size_t() const noexcept { return size_; }

  private:
    std::size_t size_ = 0;
};

/// So many numbers of type T.
template <class T, std::size_t size>
using Numbers = std::conditional_t<size == sized_later, std::vector<T>, std::array<T, size>>;

/// The size of `a` times `b` numbers that are in place as far as a stack holds them easily.
[[nodiscard]] consteval std::size_t held_in_place(std::size_t a, std::size_t b) noexcept
{
    return a == sized_later || b == sized_later || a * b > 48 * 48 ? sized_later : a * b;
}

/// Makes `count` numbers of these, all of them `value`.
template <class T, std::size_t size>
constexpr void make_numbers(std::array<T, size>& numbers, std::size_t, const std::type_identity_t<T>& value)
{
    numbers.fill(value);
}
template <class T>
void make_numbers(std::vector<T>& numbers, std::size_t count, const std::type_identity_t<T>& value)
{
    numbers.assign(count, value);
}

/// f(n) with n = `size` as a constant where the type has it or where it is small, so that loops up to n are written
/// out; else as a number.
template <std::size_t size, class Function>
[[gnu::always_inline]] inline decltype(auto) with_constant(const Size<size>& n, const Function& f) noexcept
{
    if constexpr (size != sized_later) {
        return f(std::integral_constant<std::size_t, size>());
    } else {
        switch (n) {
        case 1: return f(std::integral_constant<std::size_t, 1>());
        case 2: return f(std::integral_constant<std::size_t, 2>());
        case 3: return f(std::integral_constant<std::size_t, 3>());
        case 4: return f(std::integral_constant<std::size_t, 4>());
        case 5: return f(std::integral_constant<std::size_t, 5>());
        case 6: return f(std::integral_constant<std::size_t, 6>());
        default: return f(static_cast<std::size_t>(n));
        }
    }
}

/// Is this the type of a constant of at most `most`?
template <class Number, std::size_t most>
[[nodiscard]] consteval bool is_constant_up_to() noexcept
{
    if constexpr (requires { Number::value; })
        return Number::value <= most;
    else
        return false;
}

} // namespace lagen::detail
