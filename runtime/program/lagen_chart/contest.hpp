// SPDX-License-Identifier: MIT
/// The contest of `lagen chart`: entrants climb their ladders of tolerances or steps, and each point is told with its
/// error against the reference and its cost. An entrant of a model M is made of (model, start, request) and has
///   PointOutcome operator()(double parameter, Observer& observer) const   one run; observer.row(t, s) at every sample
///   double steps_of(double parameter) const                               that are sure before the run; else 0
/// A program writes a PointReport for each point to standard output.
#pragma once

#include "lagen_chart/answer.hpp"
#include "lagen_run/record.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <utility>

namespace lagen::chart {

struct PointOutcome {
    const char* status = "ok";
    bool good = true;
    bool is_last = false; ///< no smaller tolerance or step would do better
    std::size_t steps = 0, rejected = 0, calls = 0;
};

/// Rows are kept, and drifts are followed over what else the run shows.
template <class M>
struct PointObserver {
    detail::DriveRecord<M> record;
    std::vector<typename M::State> rows{};

    void row(double, const typename M::State& s) { rows.push_back(s); }
    void operator()(double t, const typename M::State& s) { record(t, s); }
};

/// As a run that is timed keeps them.
template <class M>
struct RowKeeper {
    std::vector<typename M::State> rows{};

    void row(double, const typename M::State& s) { rows.push_back(s); }
};

/// The largest over the samples of |s - r|_2 / |r|_2 (|s|_2 where r = 0); r is the sum of two doubles a lane.
template <class State>
double error_of(const std::vector<State>& rows, const std::vector<double>& reference)
{
    double most = 0;
    std::size_t at = 0;
    for (const State& s : rows) {
        double distance = 0, size = 0;
        for (Eigen::Index i = 0; i < s.size(); ++i, at += 2) {
            const double away = (s[i] - reference[at]) - reference[at + 1];
            distance += away * away;
            size += reference[at] * reference[at];
        }
        const double error = std::sqrt(size > 0 ? distance / size : distance);
        if (!(error <= most)) most = error;
    }
    return most;
}

/// The least of the runs that two milliseconds hold, one at least.
template <class M, class Entrant>
double seconds_of(const Entrant& entrant, double parameter)
{
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    const auto until = Clock::now() + std::chrono::milliseconds(2);
    do {
        RowKeeper<M> keeper;
        const auto begin = Clock::now();
        static_cast<void>(entrant(parameter, keeper));
        const std::chrono::duration<double> seconds = Clock::now() - begin;
        least = std::min(least, seconds.count());
    } while (Clock::now() < until);
    return least;
}

template <class M, class Entrant>
std::pair<PointOutcome, double> show_point(const Entrant& entrant, const M& model, const Request& request,
                                           const std::string& name, double parameter)
{
    PointObserver<M> observer{{model, {}, nullptr}};
    PointOutcome outcome = entrant(parameter, observer);
    PointReport point{name, parameter, error_of(observer.rows, request.reference), {}};
    point.run.status = outcome.status;
    point.run.steps = outcome.steps;
    point.run.rejected = outcome.rejected;
    point.run.rhs_calls = outcome.calls;
    point.run.seconds = seconds_of<M>(entrant, parameter);
    observer.record.report(point.run);
    if (!outcome.good) point.error = detail::not_known;
    answer(point);
    return {outcome, point.error};
}

/// A tolerance as a person would give it: three digits.
inline double short_number(double x)
{
    char text[24];
    std::snprintf(text, sizeof text, "%.3g", x);
    return std::strtod(text, nullptr);
}

/// The points of one ladder, told one by one. It ends with its last rung, where more calls are expected than are
/// allowed, where three rungs of small errors brought none that is smaller by three tenths (rounding; rungs that make
/// the same run again do not count), and where rungs fail: the second one behind a good one, or the eighth.
template <class M, class Entrant>
void climb(const Entrant& entrant, const M& model, const Request& request, const Ladder& ladder)
{
    const auto most = static_cast<double>(ladder.calls);
    double best = std::numeric_limits<double>::infinity(), expected = 0;
    std::size_t last_calls = 0;
    int idle = 0, failures = 0, good = 0;
    for (double rung = ladder.first; rung >= ladder.last * (1 - 1e-9); rung *= ladder.ratio) {
        const double parameter = entrant.steps_of(1) > 0 ? rung : short_number(rung);
        if (expected > most || entrant.steps_of(parameter) > most) return;
        const auto [outcome, error] = show_point(entrant, model, request, ladder.method, parameter);
        if (outcome.good) {
            ++good;
            expected = 2 * static_cast<double>(outcome.calls);
            if (error < 0.7 * best)
                idle = 0;
            else if (outcome.calls != last_calls)
                ++idle;
            last_calls = outcome.calls;
            best = std::min(best, error);
        } else {
            ++failures;
        }
        if (outcome.is_last || ladder.ratio == 1) return;
        if ((idle >= 3 && best < 1e-9) || failures >= (good > 0 ? 2 : 8)) return;
    }
}

/// The whole program: the file of request.hpp is its argument, and `names` are those of the entrants.
template <class M, class... Entrants>
int hold_contest(const std::array<std::string_view, sizeof...(Entrants)>& names, int argc, char** argv)
{
    Request request;
    M model;
    typename M::State start;
    if (!take_request(argc, argv, request, model, start)) return 4;
    if (request.reference.size() != 2 * request.at.size() * static_cast<std::size_t>(M::dimension)) return 4;
    for (const Ladder& ladder : request.ladders) {
        std::size_t k = 0;
        ((names[k++] == ladder.method ? climb(Entrants(model, start, request), model, request, ladder) : void()), ...);
    }
    return std::ferror(stdout) == 0 ? 0 : 5;
}

} // namespace lagen::chart
