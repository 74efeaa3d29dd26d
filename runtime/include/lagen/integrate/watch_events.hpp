// SPDX-License-Identifier: MIT
/// Looks for the zero crossings of event functions in one accepted step after another.
#pragma once

#include "lagen/integrate/event_values.hpp"
#include "lagen/integrate/locate.hpp"
#include "lagen/integrate/options.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace lagen::detail {

/// Memory is taken at the start; a step takes none until an event is found.
template <class M>
class EventWatch {
  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Request = EventRequest<Real, State>;

    struct Crossed {
        Real theta;
        std::size_t request;
        Real side;            ///< of the function before: 1 or -1
        bool at_once = false; ///< the motion leaves a jump to the wrong side
        bool stop = false;
    };

    EventWatch(const M& model, std::span<const Request> requests)
        : values_(model, requests), requests_(requests), before_(requests.size()), after_(requests.size()),
          rate_before_(requests.size()), rate_(requests.size()), there_(requests.size()), from_(requests.size()),
          sides_(requests.size()), seen_(requests.size(), 0)
    {
        crossed_.reserve(2 * requests.size());
    }

    [[nodiscard]] bool empty() const noexcept { return requests_.empty(); }
    /// Whether every request is an event of the model.
    [[nodiscard]] bool all_named() const noexcept
    {
        return std::none_of(requests_.begin(), requests_.end(), [](const Request& request) { return !!request.when; });
    }

    /// Every request has a function: an index within the model's events, or its own.
    [[nodiscard]] bool is_valid() const noexcept
    {
        return std::all_of(requests_.begin(), requests_.end(), [this](const Request& request) {
            if (request.when) return true;
            if constexpr (HasEvents<M>) return request.index < values_.model().events_names.size();
            return false;
        });
    }

    /// At the start of a run of this signed length.
    void begin(Real t, const State& s, Real length)
    {
        using std::sqrt;
        values_.evaluate(t, s, before_);
        if (std::find(before_.begin(), before_.end(), Real(0)) == before_.end()) return;
        values_.find_rates(t, s, sqrt(std::numeric_limits<Real>::epsilon()) * length, rate_);
        for (std::size_t r = 0; r < requests_.size(); ++r)
            if (before_[r] == Real(0)) sides_[r] = {sign(rate_[r]), values_.noise(r)};
    }

    /// Behind the jumps at theta of the last step, of the signed length h, where theta is known to `width`: they led at
    /// time t from a state to another one. Functions that are zero to rounding there are on the side to which they go.
    void restart(Real t, const State& from, const State& to, Real h, Real theta, Real width)
    {
        values_.evaluate(t, from, after_);
        values_.find_rates(t, from, h, rate_before_);
        values_.evaluate(t, to, before_);
        values_.find_rates(t, to, h, rate_);
        for (std::size_t r = 0; r < requests_.size(); ++r) {
            const auto same = [&](const Crossed& each) { return each.request == r && each.theta == theta; };
            const auto crossed = std::find_if(crossed_.begin(), crossed_.end(), same);
            const bool here = crossed != crossed_.end(), jumps = !!requests_[r].jump;
            const Real rate = std::max<Real>(size_of(rate_[r]), size_of(rate_before_[r])), size = size_of(before_[r]);
            const Real near = std::max<Real>(Real(8) * width * size_of(h) * rate, Real(4) * size_of(after_[r]));
            const Real level = std::max<Real>(here ? near : Real(0), values_.noise(r));
            const bool sure = size_of(rate_[r]) > std::max<Real>(Real(1e-8) * rate, values_.rate_noise(r));
            const Real side = sure    ? sign(rate_[r])
                              : here  ? crossed->side
                              : jumps ? side_before(requests_[r].direction)
                                      : Real(0);
            after_[r] = side;
            const bool soon = size <= std::max<Real>(level, Real(1e-6) * size_of(h) * size_of(rate_[r]));
            if (!here && soon && side != Real(0) && crosses(r))
                sides_[r] = {side, level, true, false};
            else
                sides_[r] = size <= level ? Side{side, level, false, jumps} : Side{};
        }
    }

    /// Crossings in (0, last] of a step, in order; those after a stop or a jump are left out. `at(theta)` answers the
    /// time and the state inside the step; its parts, which end at `ends`, are looked at one by one, so that two
    /// crossings in one step can be told; where it `turns`, turning points are looked for inside them. Where a function
    /// is not a number its last value stands, so that no gap hides a crossing.
    template <class At>
    const std::vector<Crossed>& look(std::span<const Real> ends, Real width, bool turns, const At& at)
    {
        crossed_.clear();
        std::fill(from_.begin(), from_.end(), Real(0));
        for (std::size_t r = 0; r < requests_.size(); ++r)
            if (const Side& side = sides_[r]; side.side != Real(0))
                find_side(r, side.crosses ? ends.front() : ends.back(), width, value_of(r, at));
        Real begin = Real(0);
        std::size_t found = 0;
        bool cut = false;
        for (const Real& end : ends) {
            if (cut) break;
            const auto [t, s] = at(end);
            values_.evaluate(t, *s, after_);
            for (std::size_t r = 0; r < requests_.size(); ++r) look_at(r, begin, end, width, turns, value_of(r, at));
            cut = order_and_count(found);
            piece_ = found;
            found = crossed_.size();
            before_.swap(after_);
            begin = end;
        }
        return crossed_;
    }

    /// From (t, s), where function r is nearly zero, along the motion in the direction of h, to where it is.
    [[nodiscard]] Real time_to_zero(std::size_t r, Real t, const State& s, Real h)
    {
        values_.find_rates(t, s, h, rate_);
        const Real time = values_.evaluate_one(r, t, s) / rate_[r];
        return h < Real(0) ? time : Real(-time);
    }

    /// Whether a function that has crossed its zero at (t, s) comes from there, against the direction of h: the motion
    /// is within the errors of its steps.
    [[nodiscard]] bool returns(const Crossed& crossed, Real t, const State& s, Real h)
    {
        values_.find_rates(t, s, h, rate_);
        return rate_[crossed.request] * crossed.side > Real(0);
    }

    /// The run jumps at (t, s), which is theta of the last step to rounding: functions that are beyond their zeros
    /// there have crossed them, too.
    void settle(Real t, const State& s, Real theta)
    {
        values_.evaluate(t, s, there_);
        for (std::size_t r = 0; r < requests_.size(); ++r) {
            const auto own = [r](const Crossed& each) { return each.request == r; };
            const auto piece = crossed_.begin() + static_cast<std::ptrdiff_t>(piece_);
            if (!(from_[r] < theta) || !crosses(r, after_[r], there_[r]) || std::any_of(piece, crossed_.end(), own))
                continue;
            crossed_.push_back({theta, r, sign(after_[r])});
            count(crossed_.back());
        }
        std::sort(crossed_.begin() + static_cast<std::ptrdiff_t>(piece_), crossed_.end(), is_before);
    }

    /// Those of the last step.
    [[nodiscard]] const std::vector<Crossed>& crossed() const noexcept { return crossed_; }

  private:
    /// Of a function that is zero, or zero to rounding: where it goes. 0: it is what its value says.
    struct Side {
        Real side = Real(0);
        Real level = Real(0); ///< what its values there are rounding errors of
        bool crosses = false; ///< it may have that much of the other side before it
        bool at_once = false; ///< one that goes to the other side has crossed again
    };

    static Real side_before(Crossing direction) noexcept
    {
        return direction == Crossing::falling ? Real(1) : direction == Crossing::rising ? Real(-1) : Real(0);
    }
    static Real sign(const Real& x) noexcept { return x > Real(0) ? Real(1) : x < Real(0) ? Real(-1) : Real(0); }
    static Real size_of(const Real& x) noexcept { return detail::size_of(x); }

    template <class At>
    auto value_of(std::size_t r, const At& at)
    {
        return [this, r, &at](Real theta) {
            const auto [time, state] = at(theta);
            return values_.evaluate_one(r, time, *state);
        };
    }

    /// A place of (0, last] where function r is on its side by more than its rounding errors, which would cross again:
    /// the other crossings of the step are behind it.
    template <class Function>
    void find_side(std::size_t r, Real last, Real width, const Function& value)
    {
        const Side side = sides_[r];
        const Real first = std::min<Real>(Real(4) * width, last);
        Real x = first;
        bool beyond = false;
        for (;; x = std::min<Real>(Real(2) * x, last)) {
            after_[r] = value(x);
            beyond = -after_[r] * side.side > side.level;
            if (after_[r] * side.side > side.level) {
                if (side.crosses && crosses(r)) add(r, Real(0), x, width, value);
                before_[r] = after_[r];
                from_[r] = x;
                sides_[r] = {};
                return;
            }
            if (!(x < last) || (beyond && side.at_once)) break;
        }
        if (side.crosses) {
            sides_[r] = {};
            return;
        }
        from_[r] = x;
        if (!beyond) return; // it has not left its zero yet
        before_[r] = side.side;
        if (side.at_once && crosses(r)) crossed_.push_back({first, r, side.side, true});
        before_[r] = after_[r];
        sides_[r] = {};
    }

    /// In the piece from begin to end, where the function has the values before_ and after_.
    template <class Function>
    void look_at(std::size_t r, Real begin, Real end, Real width, bool turns, const Function& value)
    {
        if (!(from_[r] < end)) {
            after_[r] = before_[r];
            return;
        }
        begin = std::max<Real>(begin, from_[r]);
        const Real known = is_number(after_[r]) ? end : last_defined(r, begin, end, width, value);
        if (crosses(r)) return add(r, begin, known, width, value);
        if (!turns) return;
        const auto turn = locate_turn(begin, before_[r], known, after_[r], width, value);
        if (!turn) return;
        const Real first = before_[r], last = after_[r], middle = value(*turn);
        after_[r] = middle;
        if (crosses(r)) add(r, begin, *turn, width, value);
        before_[r] = middle;
        after_[r] = last;
        if (crosses(r)) add(r, *turn, known, width, value);
        before_[r] = first;
    }

    /// The crossing between two places where the function has the values before_ and after_.
    template <class Function>
    void add(std::size_t r, Real begin, Real end, Real width, const Function& value)
    {
        const auto bracket = locate_crossing(begin, before_[r], end, after_[r], width, value);
        crossed_.push_back({bracket.after, r, sign(before_[r])});
    }

    /// Of a piece that ends in a gap: the last theta where the function is a number, whose value is taken for the end.
    template <class Function>
    Real last_defined(std::size_t r, Real begin, Real end, Real width, const Function& value)
    {
        const Real last = is_number(value(begin)) ? end_of_defined(begin, end, width, value) : begin;
        const Real at_last = last > begin ? value(last) : before_[r];
        after_[r] = is_number(at_last) ? at_last : before_[r];
        return last;
    }

    [[nodiscard]] bool crosses(std::size_t r) const noexcept { return crosses(r, before_[r], after_[r]); }
    [[nodiscard]] bool crosses(std::size_t r, const Real& before, const Real& after) const noexcept
    {
        const bool rising = before < Real(0) && after >= Real(0);
        const bool falling = before > Real(0) && after <= Real(0);
        switch (requests_[r].direction) {
        case Crossing::rising: return rising;
        case Crossing::falling: return falling;
        case Crossing::any: return rising || falling;
        }
        return false;
    }

    static bool is_before(const Crossed& a, const Crossed& b) noexcept
    {
        return a.theta < b.theta || (a.theta == b.theta && a.request < b.request);
    }

    void count(Crossed& crossed)
    {
        const Request& request = requests_[crossed.request];
        crossed.stop = ++seen_[crossed.request] >= request.count && request.stop;
    }

    /// Sorts the crossings of one piece by time (requests in their order where times agree), counts, and cuts after the
    /// instant of a stop or of a jump.
    bool order_and_count(std::size_t first)
    {
        const auto begin = crossed_.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, crossed_.end(), is_before);
        bool cut = false;
        Real instant = Real(0);
        for (std::size_t i = first; i < crossed_.size(); ++i) {
            if (cut && crossed_[i].theta > instant) {
                crossed_.resize(i);
                break;
            }
            count(crossed_[i]);
            if (!crossed_[i].stop && !requests_[crossed_[i].request].jump) continue;
            instant = crossed_[i].theta;
            cut = true;
        }
        return cut;
    }

    EventValues<M> values_;
    std::span<const Request> requests_;
    std::vector<Real> before_, after_;
    std::vector<Real> rate_before_, rate_; ///< along the motion, by time
    std::vector<Real> there_;              ///< where the last step jumps
    std::vector<Real> from_;               ///< theta in the step behind which each is looked at
    std::vector<Side> sides_;
    std::vector<std::size_t> seen_;
    std::vector<Crossed> crossed_;
    std::size_t piece_ = 0; ///< from which on they are of the last piece looked at, at whose beginning after_ is
};

} // namespace lagen::detail
