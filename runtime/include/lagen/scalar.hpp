// SPDX-License-Identifier: MIT
/// What is asked of a scalar: the type of a status and of a truth value, `select`, and the type of times. A scalar of
/// one value needs nothing; a pack of lanes specialises StatusOf and RealOf and overloads select next to its type.
#pragma once

#include "lagen/status.hpp"

#include <cmath>
#include <limits>

namespace lagen {

/// What a kernel answers for one scalar type. Scalars answer `Status`; a pack of N lanes answers a mask a lane: the
/// specialisation next to the pack type. Generated code uses only `good` and `fail`:
///   auto status = StatusOf<Scalar>::good();
///   StatusOf<Scalar>::fail(status, condition, Status::singular_mass_matrix);   // where condition (a mask) holds
/// so that no kernel branches on values.
template <class Scalar>
struct StatusOf {
    using type = Status;
    using mask = bool;
    [[nodiscard]] static constexpr type good() noexcept { return Status::ok; }
    static constexpr void fail(type& status, bool where, Status reason) noexcept
    {
        if (where && status == Status::ok) status = reason;
    }
    [[nodiscard]] static constexpr bool all_good(type status) noexcept { return status == Status::ok; }
    /// The first failure of two, a lane.
    [[nodiscard]] static constexpr type first(type earlier, type later) noexcept
    {
        return earlier == Status::ok ? later : earlier;
    }
};

template <class Scalar>
using status_t = typename StatusOf<Scalar>::type;

/// `where ? yes : no`, the branch that kernels may take: on packs a choice a lane.
template <class Scalar>
[[nodiscard]] constexpr Scalar select(bool where, const Scalar& yes, const Scalar& no) noexcept
{
    return where ? yes : no;
}

namespace detail {

/// False for NaN, a lane.
template <class Scalar>
[[nodiscard]] constexpr typename StatusOf<Scalar>::mask is_number(const Scalar& value) noexcept
{
    using Mask = typename StatusOf<Scalar>::mask;
    const Mask below = value <= Scalar(0), above = value >= Scalar(0);
    return below | above;
}

} // namespace detail

/// The type of times and steps: the scalar itself, or the type of one lane of a pack.
template <class Scalar>
struct RealOf {
    using type = Scalar;
    static constexpr int lanes = 1;
};

template <class Scalar>
using real_t = typename RealOf<Scalar>::type;

namespace arithmetic {

/// To the last digit of the scalar: 160 bits in three doubles, beyond them the scalar's own arc tangent.
template <class Scalar>
[[nodiscard]] Scalar pi() noexcept
{
    if constexpr (std::numeric_limits<Scalar>::digits > 150) {
        using std::atan;
        static const Scalar value = Scalar(4) * atan(Scalar(1));
        return value;
    } else {
        return Scalar(3.141592653589793) + (Scalar(1.2246467991473532e-16) + Scalar(-2.9947698097183397e-33));
    }
}

} // namespace arithmetic

/// True where every time and step of `Scalar` is a lane of it.
template <class Scalar>
inline constexpr bool is_pack = RealOf<Scalar>::lanes != 1;

} // namespace lagen
