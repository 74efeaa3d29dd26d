// SPDX-License-Identifier: MIT
/// Inputs that a table gives, each row held until the time of the next: the right-hand side jumps there, so a run goes
/// from row to row, and no step reaches over one. A value of the motion at the time of a row is one of that row's.
/// What an event function jumps by at a row is no crossing.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_run/model_parts.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace lagen::detail {

struct HeldInputs {
    std::vector<double> times;  ///< increasing
    std::vector<double> values; ///< of one row after another
};

/// From rows of t and `count` inputs; false where these are none, their times do not increase, or the run begins before
/// the first.
[[nodiscard]] inline bool plan_inputs(const std::vector<double>& numbers, std::size_t count, Interval<double> span,
                                      HeldInputs& inputs)
{
    if (numbers.empty()) return true;
    if (count == 0 || numbers.size() % (count + 1) != 0) return false;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        (k % (count + 1) == 0 ? inputs.times : inputs.values).push_back(numbers[k]);
    return std::ranges::adjacent_find(inputs.times, std::greater_equal<>()) == inputs.times.end() &&
           !(std::min(span.start, span.end) < inputs.times.front());
}

/// Adds what `next`, which began where `run` ended, counted and found.
template <class M>
void append(Run<M>& run, Run<M>&& next)
{
    next.steps += run.steps;
    next.rejected += run.rejected;
    next.rhs_calls += run.rhs_calls;
    next.newton_iterations += run.newton_iterations;
    next.decompositions += run.decompositions;
    run.events.insert(run.events.end(), next.events.begin(), next.events.end());
    next.events = std::move(run.events);
    next.starts_on = std::move(run.starts_on);
    run = std::move(next);
}

/// integrate(), with the inputs of `model` set at each row; the observer takes the rows of output. Without a table it
/// is integrate() itself.
template <class M, class Method, class Observer>
Run<M> integrate_held(const HeldInputs& inputs, M& model, const typename M::State& s, Interval<double> span,
                      const Method& method, const Options<M>& options, Observer& observer)
{
    if (inputs.times.empty()) return integrate(model, s, span, method, options, observer);
    const bool backward = span.end < span.start;
    std::vector<EventRequest<double, typename M::State>> events(options.events.begin(), options.events.end());
    Run<M> run;
    run.state = s;
    run.t = span.start;
    std::size_t rows = 0; // those of options.at that are behind
    for (bool first = true; first || (run.status() == Status::ok && run.t != span.end); first = false) {
        // The row that holds: the last one whose time is not after this part.
        const auto behind = backward ? std::lower_bound(inputs.times.begin() + 1, inputs.times.end(), run.t)
                                     : std::upper_bound(inputs.times.begin(), inputs.times.end(), run.t);
        const auto row = static_cast<std::size_t>(behind - inputs.times.begin()) - 1;
        const std::size_t count = inputs_of(model).size();
        for (std::size_t k = 0; k < count; ++k) {
            set_input(model, k, inputs.values[row * count + k]);
            if constexpr (requires { observer.hold_input(k, 0.0); })
                observer.hold_input(k, inputs.values[row * count + k]);
        }
        double end = span.end;
        if (backward)
            end = std::max(end, row == 0 ? end : inputs.times[row]);
        else if (row + 1 < inputs.times.size())
            end = std::min(end, inputs.times[row + 1]);
        Options<M> part = options;
        const auto later = [backward](double a, double b) { return backward ? a > b : a < b; };
        const auto rest = options.at.subspan(rows);
        const auto last = backward || end == span.end ? std::ranges::upper_bound(rest, end, later)
                                                      : std::ranges::lower_bound(rest, end, later);
        part.at = rest.first(static_cast<std::size_t>(last - rest.begin()));
        rows += part.at.size();
        part.events = events;
        part.max_steps -= run.steps + run.rejected;
        const std::size_t found = run.events.size();
        if (!first) part.continues = &run;
        Run<M> next = integrate(model, run.state, {run.t, end}, method, part, observer);
        if (first) run.starts_on = next.starts_on;
        append(run, std::move(next));
        for (std::size_t k = found; k < run.events.size(); ++k)
            if (auto& event = events[run.events[k].request]; event.stop && event.count > 1) --event.count;
    }
    return run;
}

} // namespace lagen::detail
