// SPDX-License-Identifier: MIT
/// The points of `lagen chart`: what a run of a method with a tolerance or a step costs, and how far it is from the
/// reference. The whole generated main is
///   #include "model.hpp"
///   #include "lagen_chart/points.hpp"
///   int main(int argc, char** argv) { return lagen::chart_points<lagen::models::NAME<double>, lagen::A,
///   lagen::B>({"a", "b"}, argc, argv); }
/// Its argument is the file of request.hpp. For each point it prints `point=METHOD` and `parameter=`, then lines as the
/// report of `lagen run` has them: status, error, steps, rejected, rhs_calls, seconds (the least of several runs), and
/// energy= (or hamiltonian=) and invariant:NAME= with their drifts over all steps.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_chart/request.hpp"
#include "lagen_run/record.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <string_view>

namespace lagen {

namespace chart {

/// Rows are kept, and drifts are followed over the steps.
template <class M>
struct PointObserver {
    detail::DriveRecord<M> record;
    std::vector<typename M::State> rows{};

    void row(double, const typename M::State& s) { rows.push_back(s); }
    void operator()(double t, const typename M::State& s) { record(t, s); }
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

/// One model from one start, by any method.
template <class M>
class Contest {
  public:
    using State = typename M::State;

    Contest(const M& model, const State& start, const Request& request)
        : model_(model), start_(start), request_(request)
    {
    }

    /// The points of one ladder, printed one by one. It ends with its last rung, where more calls are expected than
    /// are allowed, where three rungs of small errors brought none that is smaller by three tenths (rounding), and
    /// where rungs fail: the second one behind a good one, or the eighth.
    template <class Method>
    void climb(const Ladder& ladder) const
    {
        double best = std::numeric_limits<double>::infinity();
        int idle = 0, failures = 0, good = 0;
        double expected = 0;
        for (double parameter = ladder.first; parameter >= ladder.last * (1 - 1e-9); parameter *= ladder.ratio) {
            if (expected > static_cast<double>(ladder.calls) ||
                fixed_steps<Method>(parameter) > static_cast<double>(ladder.calls))
                return;
            const auto [run, error] = point<Method>(ladder.method, parameter);
            expected = 2 * static_cast<double>(run.rhs_calls);
            if (run) {
                ++good;
                idle = error < 0.7 * best ? 0 : idle + 1;
                best = std::min(best, error);
            } else {
                ++failures;
            }
            const Status status = run.status();
            if (status == Status::too_many_steps || status == Status::not_separable || ladder.ratio == 1) return;
            if ((idle >= 3 && best < 1e-9) || failures >= (good > 0 ? 2 : 8)) return;
        }
    }

  private:
    template <class Method>
    static Method with(double parameter)
    {
        Method method{};
        if constexpr (requires { method.step; })
            method.step = parameter;
        else
            method.relative = method.absolute = parameter;
        return method;
    }

    template <class Method>
    double fixed_steps(double step) const
    {
        if constexpr (requires { Method::step; }) return std::abs(request_.span.end - request_.span.start) / step;
        return 0;
    }

    template <class Method>
    std::pair<Run<M>, double> point(const std::string& name, double parameter) const
    {
        const Method method = with<Method>(parameter);
        const Options<M> options{.at = request_.at, .max_steps = request_.most};
        PointObserver<M> observer{{model_, {}, true, nullptr}};
        auto run = integrate(model_, start_, request_.span, method, options, observer);
        const double error = error_of(observer.rows, request_.reference);
        std::printf("point=%s\nparameter=%.17g\nstatus=%s\n", name.c_str(), parameter, to_text(run.status()));
        if (run) std::printf("error=%.17g\n", error);
        std::printf("steps=%zu\nrejected=%zu\nrhs_calls=%zu\nseconds=%.17g\n%s", run.steps, run.rejected, run.rhs_calls,
                    seconds_of(method, options), observer.record.report().c_str());
        std::fflush(stdout);
        return {std::move(run), error};
    }

    /// The least of the runs that two milliseconds hold, one at least.
    template <class Method>
    double seconds_of(const Method& method, const Options<M>& options) const
    {
        using Clock = std::chrono::steady_clock;
        double least = std::numeric_limits<double>::infinity();
        const auto until = Clock::now() + std::chrono::milliseconds(2);
        do {
            const auto begin = Clock::now();
            const auto run = integrate(model_, start_, request_.span, method, options);
            const std::chrono::duration<double> seconds = Clock::now() - begin;
            if (run.steps <= request_.most) least = std::min(least, seconds.count());
        } while (Clock::now() < until);
        return least;
    }

    const M& model_;
    const State& start_;
    const Request& request_;
};

} // namespace chart

template <class M, class... Methods>
int chart_points(const std::array<std::string_view, sizeof...(Methods)>& names, int argc, char** argv)
{
    chart::Request request;
    M model;
    typename M::State start;
    if (argc != 2 || !chart::read_request(argv[1], request) || !chart::fill(request, model, start)) return 4;
    if (request.reference.size() != 2 * request.at.size() * static_cast<std::size_t>(M::dimension)) return 4;
    const chart::Contest<M> contest(model, start, request);
    for (const chart::Ladder& ladder : request.ladders) {
        std::size_t k = 0;
        ((names[k++] == ladder.method ? contest.template climb<Methods>(ladder) : void()), ...);
    }
    return std::ferror(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
