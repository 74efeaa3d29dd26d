// SPDX-License-Identifier: MIT
/// The events of one instant behind the first jump of it, or at the start of a run: which of them happen there.
#pragma once

#include "lagen/integrate/options.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lagen::detail {

// Event functions at a state, their rates along the motion, and the rounding errors of both.

/// Memory is taken at the start.
template <class M>
class EventValues {
  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Request = EventRequest<Real, State>;

    EventValues(const M& model, std::span<const Request> requests)
        : model_(model), requests_(requests), back_(requests.size()), ahead_(requests.size()), aside_(requests.size()),
          reached_(requests.size()), noise_(requests.size()), rate_noise_(requests.size())
    {
    }

    [[nodiscard]] const M& model() const noexcept { return model_; }

    void evaluate(Real t, const State& s, std::vector<Real>& values)
    {
        if constexpr (HasEvents<M> && !is_pack<Scalar>) {
            const auto all = model_.events(t, s);
            for (std::size_t r = 0; r < requests_.size(); ++r)
                values[r] =
                    requests_[r].when ? requests_[r].when(t, s) : all[static_cast<Eigen::Index>(requests_[r].index)];
        } else {
            for (std::size_t r = 0; r < requests_.size(); ++r) values[r] = requests_[r].when(t, s);
        }
    }

    [[nodiscard]] Real evaluate_one(std::size_t r, Real t, const State& s) const
    {
        if constexpr (HasEvents<M> && !is_pack<Scalar>)
            if (!requests_[r].when) return model_.events(t, s)[static_cast<Eigen::Index>(requests_[r].index)];
        return requests_[r].when(t, s);
    }

    /// The rates of the functions along the motion through s at t, in the direction of h, by differences over a part of
    /// h, or of the time in which the state changes where these are rounding errors; 0 where those are, too.
    void find_rates(Real t, const State& s, Real h, std::vector<Real>& rates)
    {
        std::fill(rates.begin(), rates.end(), Real(0));
        if constexpr (RightHandSide<M> && !is_pack<Scalar>) {
            using std::sqrt;
            const Real half = sqrt(std::numeric_limits<Real>::epsilon()), quarter = sqrt(half);
            tangent_t<M> slope;
            if constexpr (std::is_same_v<State, tangent_t<M>>) slope = s;
            std::fill(rate_noise_.begin(), rate_noise_.end(), Real(0));
            std::fill(reached_.begin(), reached_.end(), Real(0));
            if (model_.rhs(Scalar(t), s, slope) != Status::ok) return;
            find_noise(t, s, slope, quarter * h);
            find_differences(t, s, slope, quarter * h, rates);
            if constexpr (moves_by_sums<M>) {
                Real place = Real(0), speed = Real(0);
                for (Eigen::Index i = 0; i < s.size(); ++i) place += s[i] * s[i], speed += slope[i] * slope[i];
                if (speed > Real(0)) find_differences(t, s, slope, quarter * sqrt(place / speed) * sign(h), rates);
            }
        }
    }

    /// Rounding errors where rates were found last: of function r, and of its rate.
    [[nodiscard]] const Real& noise(std::size_t r) const noexcept { return noise_[r]; }
    [[nodiscard]] const Real& rate_noise(std::size_t r) const noexcept { return rate_noise_[r]; }
    /// The value a little ahead, from where its rate was found: behind a kink the rate is that of neither side.
    [[nodiscard]] const Real& reached(std::size_t r) const noexcept { return reached_[r]; }

  private:
    static Real sign(const Real& x) noexcept { return x > Real(0) ? Real(1) : x < Real(0) ? Real(-1) : Real(0); }
    static Real size_of(const Real& x) noexcept { return detail::size_of(x); }

    /// Of those that are not known yet, to fourth order: a rate that a jump makes zero is less than the third ones are.
    void find_differences(Real t, const State& s, const tangent_t<M>& slope, Real part, std::vector<Real>& rates)
    {
        const auto difference = [&](Real length) {
            evaluate(t - length, retracted(model_, s, tangent_t<M>(Scalar(-length) * slope)), back_);
            evaluate(t + length, retracted(model_, s, tangent_t<M>(Scalar(length) * slope)), ahead_);
        };
        difference(Real(2) * part);
        for (std::size_t r = 0; r < rates.size(); ++r) aside_[r] = ahead_[r] - back_[r];
        difference(part);
        for (std::size_t r = 0; r < rates.size(); ++r) {
            const Real ahead = ahead_[r];
            ahead_[r] -= back_[r];
            if (rates[r] != Real(0) || !(size_of(ahead_[r]) > noise_[r])) continue;
            reached_[r] = ahead;
            const Real twice = is_number(aside_[r]) ? aside_[r] : Real(2) * ahead_[r];
            const Real finer = Real(8) * ahead_[r] - twice, times = finer / ahead_[r];
            // At a multiple zero the two differ: no rate is known.
            if (times > Real(3) && times < Real(12)) rates[r] = finer / (Real(12) * size_of(part));
        }
    }

    /// The rounding errors of the functions and of their rates, by what they change by where each lane of s and the
    /// time change by some units of their last places, or by their own rates: up or down, in such patterns that any two
    /// of them go against each other in one, so that terms do not cancel as they do at a zero.
    void find_noise(Real t, const State& s, const tangent_t<M>& slope, Real part)
    {
        const Real unit = Real(4) * std::numeric_limits<Real>::epsilon();
        std::fill(noise_.begin(), noise_.end(), Real(0));
        evaluate(t, s, ahead_);
        const auto widen = [&](std::vector<Real>& noise, Real scale) {
            for (std::size_t r = 0; r < noise.size(); ++r)
                noise[r] = std::max<Real>(noise[r], scale * size_of(Real(back_[r] - ahead_[r])));
        };
        const Eigen::Index lanes = slope.size();
        for (Eigen::Index bit = 1; bit / 2 <= lanes; bit *= 2) {
            const auto way = [bit](Eigen::Index lane) { return Real((lane & bit) == 0 ? 1 : -1); };
            tangent_t<M> change = slope;
            for (Eigen::Index i = 0; i < lanes; ++i) change[i] *= Scalar(part * way(i));
            evaluate(t + part * way(lanes), retracted(model_, s, change), back_);
            widen(rate_noise_, unit / size_of(part));
            State near = s;
            if constexpr (moves_by_sums<M>)
                for (Eigen::Index i = 0; i < lanes; ++i) near[i] *= Scalar(Real(1) + unit * way(i));
            evaluate(t * (Real(1) + unit * way(lanes)), near, back_);
            widen(noise_, Real(1));
        }
    }

    const M& model_;
    std::span<const Request> requests_;
    std::vector<Real> back_, ahead_, aside_, reached_;
    std::vector<Real> noise_, rate_noise_;
};

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

    /// True where it has jumped in this instant.
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
