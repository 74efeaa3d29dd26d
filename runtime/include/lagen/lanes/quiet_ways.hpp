// SPDX-License-Identifier: MIT
/// Times and lengths of trajectories abreast at whose steps nothing has to be looked at: what Integrator does of a step
/// that counts and of the next one, which is not the last, for all lanes at once and with the same bits.
#pragma once

#include "lagen/integrate/way.hpp"
#include "lagen/lanes/pack.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

namespace lagen::detail {

template <class Real, int N>
struct QuietWays {
    using P = Pack<Real, N>;
    using Where = Mask<Real, N>;
    using Lanes = std::array<Real, static_cast<std::size_t>(N)>;

    /// A lane becomes quiet. `cap`: the longest step, if it is positive.
    void set_lane(int lane, const Way<Real>& way, const Real& h, const Real& rounding, const Real& cap) noexcept
    {
        asked.set(lane, h);
        lost.set(lane, rounding);
        end.set(lane, way.end);
        length.set(lane, way.length);
        direction.set(lane, way.directed(Real(1)));
        most.set(lane, cap > Real(0) ? cap : std::numeric_limits<Real>::infinity());
    }

    /// A step that a cap cut short says nothing against the length that was asked for.
    [[nodiscard]] P uncut(const P& size, const P& next) const noexcept
    {
        return select(size < asked && next < asked, asked, next);
    }

    /// Where a step counted, the next one begins at its end and is as long as `next` says, unless it would be the last
    /// or lost in the rounding of time: see Way and Integrator. Answers where it is not; elsewhere nothing changes.
    Where go_on(Where counts, const P& next, Lanes& times, Lanes& lengths, Lanes& ends) noexcept
    {
        const P t(times), h(lengths), t1(ends);
        const P epsilon(std::numeric_limits<Real>::epsilon());
        const P reaches = min(P(Real(1.01)) * next, most);
        counts = counts && reaches < abs(end - t1) && P(Real(0.1)) * next > epsilon * max(abs(t1), epsilon * length);
        const P rounding = (t1 - t) - (h - lost), step = direction * min(next, most);
        asked = select(counts, next, asked);
        lost = select(counts, rounding, lost);
        put(times, select(counts, t1, t));
        put(lengths, select(counts, step, h));
        put(ends, select(counts, t1 + (step - lost), t1));
        return counts;
    }

    P asked{}, lost{}; ///< the length that the controller asks for; the rounding error of the time

  private:
    static void put(Lanes& lanes, const P& pack) noexcept { std::memcpy(lanes.data(), &pack, sizeof pack); }

    P end{}, length{}, direction{}, most{};
};

} // namespace lagen::detail
