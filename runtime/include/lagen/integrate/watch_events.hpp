// SPDX-License-Identifier: MIT
/// Looks for the zero crossings of event functions in one accepted step after another.
#pragma once

#include "lagen/integrate/instant.hpp"
#include "lagen/integrate/options.hpp"
#include "lagen/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace lagen::detail {

// Roots and boundaries inside a step, on the step's own variable theta in [0, 1].

/// A bracket that has shrunk to `width`: the sign at `after` is that at the end of the first bracket.
template <class Real>
struct Bracket {
    Real before;
    Real after;
};

/// The boundary between a, where `inside` holds, and b, where it does not.
template <class Real, class Predicate>
Bracket<Real> locate_boundary(Real a, Real b, Real width, const Predicate& inside) noexcept
{
    while (b - a > width) {
        const Real middle = (a + b) / Real(2);
        if (!(middle > a && middle < b)) break;
        (inside(middle) ? a : b) = middle;
    }
    return {a, b};
}

/// The last theta, to `width`, before a gap that begins between a and b, where `value` is not a number.
template <class Real, class Function>
Real end_of_defined(Real a, Real b, Real width, const Function& value) noexcept
{
    return locate_boundary(a, b, width, [&](Real x) { return is_number(value(x)); }).before;
}

/// The crossing of `value` between a (value ga) and b (value gb of the other sign, or zero), where it leaves zero: the
/// Illinois variant of regula falsi [Dowell and Jarratt 1971], every third trial a bisection, so that the bracket
/// shrinks at least by 2 in three trials. Where a trial is not a number the crossing is looked for before that gap,
/// else behind it.
template <class Real, class Function>
Bracket<Real> locate_crossing(Real a, Real ga, Real b, Real gb, Real width, const Function& value) noexcept
{
    const bool rising = ga < Real(0);
    int kept = 0;
    for (int trial = 0; trial < 240 && b - a > width; ++trial) {
        Real x = (a + b) / Real(2);
        if (trial % 3 != 2 && gb != ga) {
            // A trial within the width of an end would not shrink the bracket below it: step just inside.
            const Real least = std::min<Real>(width, (b - a) / Real(2)) * Real(0.75);
            const Real secant = b - gb * (b - a) / (gb - ga);
            if (secant > a && secant < b) x = std::clamp<Real>(secant, a + least, b - least);
        }
        if (!(x > a && x < b)) break;
        Real g = value(x);
        if (!is_number(g)) {
            const Real end = end_of_defined(a, x, width, value);
            const Real at_end = value(end);
            if (rising ? at_end >= Real(0) : at_end <= Real(0)) {
                x = end;
                g = at_end;
            }
        }
        const bool crossed = rising ? g > Real(0) : g < Real(0);
        if (crossed) {
            b = x;
            gb = g;
            if (kept > 0) ga /= Real(2);
            kept = 1;
        } else {
            a = x;
            ga = g;
            if (kept < 0) gb /= Real(2);
            kept = -1;
        }
    }
    return {a, b};
}

/// Between a and b, where `value` has one sign (values ga and gb), a place where it has the other: beyond the turning
/// point of a function that comes nearer to zero at a and leaves it at b. Nothing where a convex one does not reach
/// zero, whose tangents at two places meet below it.
template <class Real, class Function>
std::optional<Real> locate_turn(Real a, Real ga, Real b, Real gb, Real width, const Function& value) noexcept
{
    const Real side = ga > Real(0) ? Real(1) : Real(-1), part = Real(1) / Real(1024);
    if (!(side * ga > Real(0) && side * gb > Real(0))) return std::nullopt;
    const auto slope = [&](Real x, Real gx, Real dx) { return side * (value(x + dx) - gx) / dx; };
    Real rise = slope(b, gb, part * (a - b));
    if (!(rise > Real(0))) return std::nullopt;
    Real fall = slope(a, ga, part * (b - a));
    for (int trial = 0; trial < 100 && fall < Real(0) && b - a > width; ++trial) {
        const Real behind = (side * (gb - ga) - rise * (b - a)) / (fall - rise); // a + behind: there the tangents meet
        if (side * ga + fall * behind > Real(0)) return std::nullopt;
        const Real least = (b - a) / Real(16);
        const Real middle = a + std::clamp<Real>(behind, least, Real(15) * least), gm = value(middle);
        if (!is_number(gm)) return std::nullopt;
        if (side * gm < Real(0)) return middle;
        const Real there = slope(middle, gm, part * (b - middle));
        if (there < Real(0)) {
            a = middle, ga = gm, fall = there;
        } else {
            b = middle, gb = gm, rise = there;
        }
    }
    return std::nullopt;
}

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

    EventWatch(const M& model, std::span<const Request> requests, const Real& tolerance)
        : values_(model, requests), requests_(requests), tolerance_(tolerance), before_(requests.size()),
          after_(requests.size()), rate_before_(requests.size()), rate_(requests.size()), there_(requests.size()),
          from_(requests.size()), sides_(requests.size()), seen_(requests.size(), 0)
    {
        crossed_.reserve(2 * requests.size());
    }

    [[nodiscard]] bool empty() const noexcept { return requests_.empty(); }
    /// True where every request is an event of the model.
    [[nodiscard]] bool all_named() const noexcept
    {
        return std::none_of(requests_.begin(), requests_.end(), [](const Request& request) { return !!request.when; });
    }

    /// Every request has a function: an index within the model's events, or its own.
    [[nodiscard]] bool is_valid() const noexcept
    {
        for (const Request& request : requests_) {
            if (request.when) continue;
            if constexpr (HasEvents<M>) {
                if (request.index < values_.model().events_names.size()) continue;
            }
            return false;
        }
        return true;
    }

    /// At the start of a run, h being a time in its direction, or where one goes on: then what is still before its zero
    /// by a rounding error crosses it.
    void begin(Real t, const State& s, Real h, bool goes_on)
    {
        values_.evaluate(t, s, before_);
        values_.find_rates(t, s, h, rate_);
        for (std::size_t r = 0; r < requests_.size(); ++r)
            if (!goes_on || before_[r] * rate_[r] >= Real(0))
                set_side(r, values_.noise(r), values_.rate_noise(r), false, !!requests_[r].jump);
    }

    /// Behind the jumps of an instant, at theta of the last step, of the signed length h, where theta is known to
    /// `width`: they led at time t from a state to another one.
    void restart(const Instant<M>& instant, Real t, const State& from, const State& to, Real h, Real theta, Real width)
    {
        values_.evaluate(t, from, after_);
        values_.find_rates(t, from, h, rate_before_);
        for (std::size_t r = 0; r < requests_.size(); ++r) there_[r] = values_.reached(r);
        values_.evaluate(t, to, before_);
        values_.find_rates(t, to, h, rate_);
        for (std::size_t r = 0; r < requests_.size(); ++r) {
            const auto same = [&](const Crossed& each) { return each.request == r && each.theta == theta; };
            const auto crossed = std::find_if(crossed_.begin(), crossed_.end(), same);
            const bool here = crossed != crossed_.end(), own = instant.has_jumped(r);
            const Real rate = std::max<Real>(size_of(rate_[r]), size_of(rate_before_[r]));
            const Real near = std::max<Real>(Real(8) * width * size_of(h) * rate, Real(4) * size_of(after_[r]));
            const Real level = std::max<Real>(here ? near : Real(0), values_.noise(r));
            const Real least = std::max<Real>(Real(1e-8) * rate, values_.rate_noise(r));
            // Through a multiple zero, whose rates are 0, a motion goes on where a jump leaves it nearly as fast.
            const Real ahead = there_[r], behind = values_.reached(r);
            const bool through = rate_before_[r] == Real(0) && Real(1e3) * behind * ahead > ahead * ahead;
            if (through) rate_[r] = behind;
            set_side(r, level, through ? Real(0) : least, own, !here && !own);
            const bool known = through || size_of(rate_[r]) > least;
            if (here && !known && size_of(before_[r]) <= level) sides_[r].side = crossed->side;
        }
    }

    /// The ends of the parts of (0, theta] in which events are looked for: where the stepper knows between which times
    /// they change their signs, those, and true; else `pieces` equal ones.
    template <class Stepper>
    bool find_parts(const Stepper& stepper, const Real& h, const Real& theta, int pieces, std::vector<Real>& parts)
    {
        parts.clear();
        bool known = false;
        if constexpr (requires(void (*found)(Real)) { stepper.split(h, theta, found); })
            known = all_named() && stepper.split(h, theta, [&](const Real& end) { parts.push_back(end); });
        for (int piece = 1; piece < pieces && !known; ++piece) parts.push_back(theta * Real(piece) / Real(pieces));
        if (known) std::sort(parts.begin(), parts.end());
        if (parts.empty() || parts.back() != theta) parts.push_back(theta);
        return known;
    }

    /// Crossings in (0, last] of a step, in order; those after a stop or a jump are left out. `at(theta)` answers the
    /// time and the state inside the step; its parts, which end at `ends`, are looked at one by one, so that two
    /// crossings in one step can be told; where it `turns`, turning points are looked for inside them. Where a function
    /// is not a number its last value stands, so that no gap hides a crossing.
    template <class At>
    const std::vector<Crossed>& look(std::span<const Real> ends, Real width, Real h, bool turns, const At& at)
    {
        crossed_.clear();
        h_ = h;
        std::fill(from_.begin(), from_.end(), Real(0));
        for (std::size_t r = 0; r < requests_.size(); ++r)
            if (const Side& side = sides_[r]; side.side != Real(0)) find_side(r, ends.back(), width, value_of(r, at));
        Real begin = Real(0);
        std::size_t found = 0;
        bool cut = false;
        for (const Real& end : ends) {
            if (cut) break;
            const auto [t, s] = at(end);
            values_.evaluate(t, *s, after_);
            for (std::size_t r = 0; r < requests_.size(); ++r) look_at(r, begin, end, width, turns, at);
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

    /// True where a function that has crossed its zero at (t, s) comes from there, against the direction of h: the
    /// motion is within the errors of its steps.
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
        values_.find_rates(t, s, h_, rate_);
        for (std::size_t r = 0; r < requests_.size(); ++r) {
            // Where it is zero to rounding, it is where it goes.
            if (size_of(there_[r]) <= values_.noise(r))
                there_[r] = size_of(rate_[r]) > values_.rate_noise(r) ? rate_[r] : after_[r];
            const auto own = [r](const Crossed& each) { return each.request == r; };
            const auto piece = crossed_.begin() + static_cast<std::ptrdiff_t>(piece_);
            if (!(from_[r] < theta) || !crosses(r, after_[r], there_[r]) || std::any_of(piece, crossed_.end(), own))
                continue;
            crossed_.push_back({theta, r, sign(after_[r])});
            count(crossed_.back());
        }
        std::sort(crossed_.begin() + static_cast<std::ptrdiff_t>(piece_), crossed_.end(), is_before);
    }

    /// One event more of request r: whether the run ends there.
    [[nodiscard]] bool stops(std::size_t r) { return ++seen_[r] >= requests_[r].count && requests_[r].stop; }

    /// Those of the last step.
    [[nodiscard]] const std::vector<Crossed>& crossed() const noexcept { return crossed_; }

  private:
    /// Of a function that is zero, or zero to rounding: where it goes. 0: it is what its value says.
    struct Side {
        Real side = Real(0);
        Real level = Real(0); ///< what its values there are rounding errors of
        bool at_once = false; ///< one that goes to the other side has crossed again
        bool happens = false; ///< one that goes to the other side crosses where it is
        bool stands = false;  ///< its value has been the same for a step
    };

    static Real sign(const Real& x) noexcept { return sign_of(x); }
    static Real size_of(const Real& x) noexcept { return detail::size_of(x); }

    template <class At>
    auto value_of(std::size_t r, const At& at)
    {
        return [this, r, &at](Real theta) {
            const auto [time, state] = at(theta);
            return values_.evaluate_one(r, time, *state);
        };
    }

    /// Of function r, which has the value before_ and the rate rate_, known to `least`: the side to which it goes where
    /// it is zero to `level`; where that is not known, the side from which it may cross. The rest as in Side.
    void set_side(std::size_t r, const Real& level, const Real& least, bool at_once, bool happens)
    {
        const Real from = side_before<Real>(requests_[r].direction), size = size_of(before_[r]);
        const Real goes = size_of(rate_[r]) > least ? sign(rate_[r]) : Real(0);
        const Real side = goes != Real(0) ? goes : from;
        const bool on = size <= level, beyond = size <= tolerance_ && goes == from && before_[r] * from < Real(0);
        sides_[r] = {};
        if (on || beyond) sides_[r] = {side, std::max<Real>(level, size), at_once, happens && from != Real(0)};
        if (on && side == Real(0)) before_[r] = Real(0);
    }

    /// A place of (0, last] where function r is on its side by more than its rounding errors, which would cross again:
    /// the other crossings of the step are behind it.
    template <class Function>
    void find_side(std::size_t r, Real last, Real width, const Function& value)
    {
        const Side side = sides_[r];
        const Real first = std::min<Real>(Real(4) * width, last);
        Real x = first, stood = Real(0);
        bool beyond = false;
        for (;; x = std::min<Real>(Real(2) * x, last)) {
            after_[r] = value(x);
            if (after_[r] == before_[r]) stood = x;
            beyond = -after_[r] * side.side > side.level;
            if (after_[r] * side.side > side.level) {
                before_[r] = after_[r];
                from_[r] = x;
                sides_[r] = {};
                return;
            }
            if (!(x < last) || (beyond && (side.at_once || side.happens))) break;
        }
        from_[r] = x;
        if (!beyond) { // it has not left its zero yet
            sides_[r].stands = stood == last;
            return;
        }
        before_[r] = side.side;
        if ((side.stands || stood > Real(1e-3)) && (side.at_once || side.happens)) {
            from_[r] = Real(0); // it crosses where it leaves its zero, like any other
            sides_[r] = {};
            return;
        }
        if (side.at_once && crosses(r)) crossed_.push_back({first, r, side.side, true});
        if (side.happens && crosses(r)) crossed_.push_back({Real(0), r, side.side});
        before_[r] = after_[r];
        sides_[r] = {};
    }

    /// In the piece from begin to end, where the function has the values before_ and after_.
    template <class At>
    void look_at(std::size_t r, Real begin, Real end, Real width, bool turns, const At& at)
    {
        if (!(from_[r] < end)) {
            after_[r] = before_[r];
            return;
        }
        const auto value = value_of(r, at);
        begin = std::max<Real>(begin, from_[r]);
        const Real known = is_number(after_[r]) ? end : last_defined(r, begin, end, width, value);
        if (before_[r] * after_[r] <= Real(0) && before_[r] != Real(0)) {
            if (is_shallow(r, known, size_of(before_[r]), after_[r], at))
                after_[r] = before_[r]; // the next look decides
            else if (crosses(r))
                add(r, begin, known, width, value);
            return;
        }
        if (!turns) return;
        const auto turn = locate_turn(begin, before_[r], known, after_[r], width, value);
        if (!turn) return;
        const Real first = before_[r], last = after_[r], middle = value(*turn);
        if (is_shallow(r, *turn, std::max<Real>(size_of(first), size_of(last)), middle, at)) return;
        after_[r] = middle;
        if (crosses(r)) add(r, begin, *turn, width, value);
        before_[r] = middle;
        after_[r] = last;
        if (crosses(r)) add(r, *turn, known, width, value);
        before_[r] = first;
    }

    /// True where function r, which comes from values of this size, does not certainly cross its zero where it has got
    /// to `value` beyond it, at theta: what lies within rounding errors, or is less than the tolerance and 1e-6 of the
    /// size, may be a touch. One that goes on as fast as functions of this size do near no turning point is none: the
    /// value d of c x^2, which is S where x = 1, has the rate 2 sqrt(d S).
    template <class At>
    [[nodiscard]] bool is_shallow(std::size_t r, const Real& theta, const Real& size, const Real& value, const At& at)
    {
        using std::max;
        if (size_of(value) > Real(1e-3) * size) return false;
        const auto [t, s] = at(theta);
        values_.find_rates(t, *s, h_, rate_);
        const Real level = max<Real>(values_.noise(r), std::min<Real>(tolerance_, Real(1e-6) * size));
        if (size_of(value) > level) return false;
        if (before_[r] * rate_[r] >= Real(0) || before_[r] * values_.reached(r) >= Real(0)) return true;
        const Real move = rate_[r] * h_, scale = max<Real>(size, size_of(value_of(r, at)(Real(1))));
        return !(move * move > Real(64) * level * scale);
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

    void count(Crossed& crossed) { crossed.stop = stops(crossed.request); }

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
    Real tolerance_;   ///< of the state: a function of its size may not have crossed
    Real h_ = Real(0); ///< of the last step
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
