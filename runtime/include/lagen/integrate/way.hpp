// SPDX-License-Identifier: MIT
/// Where steps go, and how long the next one is.
#pragma once

#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace lagen::detail {

template <class Real>
struct Way {
    Real end;              ///< if bounded
    Real reach;            ///< the largest |t|
    Real length = Real(0); ///< of all of it; where there is no end, the first step's
    Real near = Real(-1);  ///< so close to the end a step of fixed length is the last one
    bool bounded = false;
    bool forward = true;

    explicit Way(const Real& t) : end(t), reach(size_of(t)) {}

    /// From t to `to`; in the direction before where that is t.
    void aim(const Real& t, const Real& to) noexcept
    {
        bounded = true;
        end = to;
        if (to != t) forward = to > t;
        length = size_of(Real(to - t));
        reach = std::max<Real>(size_of(t), size_of(to));
    }

    [[nodiscard]] [[gnu::always_inline]] Real directed(const Real& size) const noexcept
    {
        return forward ? size : Real(-size);
    }

    /// The signed length of the step from t, of fixed length h, and whether it ends at the end. An end within rounding
    /// of the step's is the step's.
    [[nodiscard]] [[gnu::always_inline]] std::pair<Real, bool> next_of(const Real& h, const Real& t) const noexcept
    {
        const Real rest = end - t;
        if (size_of(rest) <= near) [[unlikely]]
            return {rest, true};
        return {directed(h), false};
    }

    /// The same where h is what is asked for, and `cap`, if it is positive, the most. A rest of up to 1.01 steps is one
    /// step, so that no tiny one is left; but never beyond the cap.
    [[nodiscard]] [[gnu::always_inline]] std::pair<Real, bool> next_of(const Real& h, const Real& t,
                                                                       const Real& cap) const noexcept
    {
        Real step = h, reaches = Real(1.01) * h;
        if (cap > Real(0) && step > cap) step = cap;
        if (cap > Real(0) && reaches > cap) reaches = cap;
        const Real rest = size_of(Real(end - t));
        const bool last = bounded && reaches >= rest;
        return {directed(last ? rest : step), last};
    }

    /// Is a step of length h from t within the rounding of time?
    [[nodiscard]] bool is_lost(const Real& h, const Real& t) const noexcept
    {
        const Real epsilon = std::numeric_limits<Real>::epsilon();
        return !(Real(0.1) * h > epsilon * std::max<Real>(size_of(t), epsilon * length));
    }

    /// A step from t that is not: the first one behind a jump, since jumps may follow each other as fast as steps can.
    [[nodiscard]] Real shortest(const Real& t) const noexcept
    {
        const Real epsilon = std::numeric_limits<Real>::epsilon();
        return Real(32) * epsilon * std::max<Real>(size_of(t), epsilon * length);
    }

    /// How many steps of fixed length h from t, one at least and `most` at most, surely end before the last one would
    /// begin: up to two steps short of the end, whatever the rounding of times.
    [[nodiscard]] std::size_t steps_inside(const Real& h, const Real& t, std::size_t most) const noexcept
    {
        if constexpr (std::is_floating_point_v<Real>) {
            const Real many = bounded && most > 1 ? (size_of(Real(end - t)) - Real(2) * near) / h : Real(0);
            if (many > Real(1)) return many < static_cast<Real>(most) ? static_cast<std::size_t>(many) : most;
        }
        return 1;
    }
};

} // namespace lagen::detail
