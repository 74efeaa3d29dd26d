// SPDX-License-Identifier: MIT
/// Looks for the zero crossings of event functions in one accepted step after another.
#pragma once

#include "lagen/integrate/locate.hpp"
#include "lagen/integrate/run.hpp"

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
        bool stop;
    };

    EventWatch(const M& model, std::span<const Request> requests)
        : model_(model), requests_(requests), before_(requests.size()), after_(requests.size()),
          seen_(requests.size(), 0)
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
        return std::all_of(requests_.begin(), requests_.end(), [](const Request& request) {
            if (request.when) return true;
            if constexpr (HasEvents<M>) return request.index < M::events_names.size();
            return false;
        });
    }

    void begin(Real t, const State& s) { evaluate(t, s, before_); }

    /// Crossings in (0, last] of a step, in order; those after a stop are left out. `at(theta)` answers the time and
    /// the state inside the step; its parts, which end at `ends`, are looked at one by one, so that two crossings in
    /// one step can be told. Where a function is not a number its last value stands, so that no gap hides a crossing.
    template <class At>
    const std::vector<Crossed>& look(std::span<const Real> ends, Real width, const At& at)
    {
        crossed_.clear();
        Real begin = Real(0);
        bool stopped = false;
        for (const Real& end : ends) {
            if (stopped) break;
            const auto [t, s] = at(end);
            evaluate(t, *s, after_);
            const std::size_t found = crossed_.size();
            for (std::size_t r = 0; r < requests_.size(); ++r) {
                const auto value = [&](Real theta) {
                    const auto [time, state] = at(theta);
                    return evaluate_one(r, time, *state);
                };
                const Real known = is_number(after_[r]) ? end : last_defined(r, begin, end, width, value);
                if (!crosses(r)) continue;
                crossed_.push_back(
                    {locate_crossing(begin, before_[r], known, after_[r], width, value).after, r, false});
            }
            stopped = order_and_count(found);
            before_.swap(after_);
            begin = end;
        }
        return crossed_;
    }

  private:
    /// Of a piece that ends in a gap: the last theta where the function is a number, whose value is taken for the end.
    template <class Function>
    Real last_defined(std::size_t r, Real begin, Real end, Real width, const Function& value)
    {
        const Real last = is_number(value(begin)) ? end_of_defined(begin, end, width, value) : begin;
        const Real at_last = last > begin ? value(last) : before_[r];
        after_[r] = is_number(at_last) ? at_last : before_[r];
        return last;
    }

    [[nodiscard]] bool crosses(std::size_t r) const noexcept
    {
        const bool rising = before_[r] < Real(0) && after_[r] >= Real(0);
        const bool falling = before_[r] > Real(0) && after_[r] <= Real(0);
        switch (requests_[r].direction) {
        case Crossing::rising: return rising;
        case Crossing::falling: return falling;
        case Crossing::any: return rising || falling;
        }
        return false;
    }

    /// Sorts the crossings of one piece by time (requests in their order where times agree), counts, and cuts after the
    /// instant of a stop.
    bool order_and_count(std::size_t first)
    {
        const auto begin = crossed_.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, crossed_.end(), [](const Crossed& a, const Crossed& b) {
            return a.theta < b.theta || (a.theta == b.theta && a.request < b.request);
        });
        bool stopped = false;
        Real instant = Real(0);
        for (std::size_t i = first; i < crossed_.size(); ++i) {
            if (stopped && crossed_[i].theta > instant) {
                crossed_.resize(i);
                break;
            }
            const Request& request = requests_[crossed_[i].request];
            if (++seen_[crossed_[i].request] < request.count || !request.stop) continue;
            crossed_[i].stop = true;
            instant = crossed_[i].theta;
            stopped = true;
        }
        return stopped;
    }

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

    const M& model_;
    std::span<const Request> requests_;
    std::vector<Real> before_, after_;
    std::vector<std::size_t> seen_;
    std::vector<Crossed> crossed_;
};

} // namespace lagen::detail
