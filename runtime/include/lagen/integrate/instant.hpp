// SPDX-License-Identifier: MIT
/// The events of one instant behind the first jump of it, or at the start of a run: which of them happen there.
#pragma once

#include "lagen/integrate/event_values.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace lagen::detail {

template <class Real>
[[nodiscard]] Real sign_of(const Real& x) noexcept
{
    return x > Real(0) ? Real(1) : x < Real(0) ? Real(-1) : Real(0);
}

/// The sign of a function before it crosses in this direction; 0: either.
template <class Real>
[[nodiscard]] Real side_before(Crossing direction) noexcept
{
    return direction == Crossing::falling ? Real(1) : direction == Crossing::rising ? Real(-1) : Real(0);
}

/// Beyond its zero by so much, an event's function may be zero.
template <class Real, class Method>
[[nodiscard]] Real zero_tolerance(const Method& method) noexcept
{
    if constexpr (requires { method.control(); })
        return static_cast<Real>(method.control().absolute_tolerance());
    else
        return static_cast<Real>(1e-10);
}

/// A request is due where another one's jump makes its function, which is 0 or beyond 0 by at most `tolerance`, go on
/// in its direction (by its rate, which is that along the motion from the state behind the jump), or takes it from one
/// side to farther beyond. Memory is taken at the start.
template <class M>
class Instant {
  public:
    using Real = real_t<typename M::Scalar>;
    using State = typename M::State;
    using Request = EventRequest<Real, State>;

    Instant(const M& model, std::span<const Request> requests, const Real& tolerance)
        : values_(model, requests), requests_(requests), tolerance_(tolerance), places_(requests.size()),
          value_(requests.size()), rate_(requests.size())
    {
    }

    /// The start of a run at (t, s), h being a time in its direction: those with jumps are due there.
    void begin(Real t, const State& s, Real h)
    {
        std::fill(places_.begin(), places_.end(), Place{});
        see(t, s, h);
        for (std::size_t r = 0; r < places_.size(); ++r) places_[r].due = requests_[r].jump && goes_on(r);
    }

    /// An event without a jump of this instant, or one of direction `any`, on or beyond whose zero the run starts.
    [[nodiscard]] bool is_passed_over(std::size_t r) const
    {
        if (places_[r].due) return false;
        const Real side = side_before<Real>(requests_[r].direction), size = size_of(value_[r]);
        if (side == Real(0)) return size <= values_.noise(r) || (size <= tolerance_ && value_[r] * rate_[r] > Real(0));
        const bool leaves = is_sure(r) && rate_[r] * side > Real(0);
        if (value_[r] * side > values_.noise(r) || leaves) return false;
        const bool near = size <= std::max<Real>(values_.noise(r), tolerance_);
        return near ? !requests_[r].jump : (requests_[r].jump || requests_[r].stop) && is_sure(r);
    }

    /// The motion is at (t, s), where requests may have happened.
    void arrive(Real t, const State& s, Real h)
    {
        std::fill(places_.begin(), places_.end(), Place{});
        see(t, s, h);
        for (std::size_t r = 0; r < places_.size(); ++r) places_[r].goes_on = goes_on(r);
    }

    /// Behind the jump of `request` to (t, s).
    void jumped(std::size_t request, Real t, const State& s, Real h)
    {
        see(t, s, h);
        for (std::size_t r = 0; r < places_.size(); ++r) {
            Place& place = places_[r];
            const bool on = goes_on(r);
            if (r == request)
                place.due = false, place.jumped = true;
            else if ((on && !place.goes_on) || is_driven(r))
                place.due = true;
            else if (!on && !is_beyond(r))
                place.due = false;
            place.goes_on = on;
        }
    }

    void leave_out(std::size_t r) noexcept { places_[r].due = false; }

    [[nodiscard]] bool is_due() const noexcept
    {
        return std::any_of(places_.begin(), places_.end(), [](const Place& place) { return place.due; });
    }

    /// What is due at (t, s), round by round: in the order of the requests, each from the state behind the one before,
    /// which s then is. happens(r) says whether the run stops at request r, before its jump.
    template <class Happens>
    Status take_rounds(Real t, Real h, State& s, const Happens& happens)
    {
        for (int round = 0; is_due(); ++round) {
            if (round == most_rounds) return Status::zeno;
            for (std::size_t r = 0; r < places_.size(); ++r) {
                if (!std::exchange(places_[r].due, false)) continue;
                if (happens(r)) return Status::stopped_by_event;
                if (!requests_[r].jump) continue;
                s = requests_[r].jump(t, s);
                jumped(r, t, s, h);
            }
        }
        return Status::ok;
    }

    /// Whether it has jumped in this instant.
    [[nodiscard]] bool has_jumped(std::size_t r) const noexcept { return places_[r].jumped; }

  private:
    static constexpr int most_rounds = 1000;
    struct Place {
        bool goes_on = false, due = false, jumped = false;
        Real before = Real(0); ///< the value before the last jump
    };

    void see(Real t, const State& s, Real h)
    {
        for (std::size_t r = 0; r < places_.size(); ++r) places_[r].before = value_[r];
        values_.evaluate(t, s, value_);
        values_.find_rates(t, s, h, rate_);
    }

    [[nodiscard]] bool is_sure(std::size_t r) const { return size_of(rate_[r]) > values_.rate_noise(r); }

    [[nodiscard]] bool goes_on(std::size_t r) const
    {
        const Real side = side_before<Real>(requests_[r].direction), value = value_[r] * side;
        const Real noise = values_.noise(r), beyond = std::max<Real>(noise, tolerance_);
        const bool goes = is_sure(r) && rate_[r] * side < Real(0) && values_.reached(r) * side < Real(0);
        return side != Real(0) && goes && value <= noise && value >= -beyond;
    }

    [[nodiscard]] bool is_beyond(std::size_t r) const
    {
        return !(size_of(value_[r]) <= std::max<Real>(values_.noise(r), tolerance_)) &&
               !(value_[r] * side_before<Real>(requests_[r].direction) > Real(0));
    }

    [[nodiscard]] bool is_driven(std::size_t r) const
    {
        const bool wrong_way = places_[r].before * side_before<Real>(requests_[r].direction) < Real(0);
        return is_beyond(r) && !wrong_way && size_of(places_[r].before) > values_.noise(r) &&
               places_[r].before * value_[r] < Real(0);
    }

    EventValues<M> values_;
    std::span<const Request> requests_;
    Real tolerance_;
    std::vector<Place> places_;
    std::vector<Real> value_, rate_; ///< at the last state that was seen
};

} // namespace lagen::detail
