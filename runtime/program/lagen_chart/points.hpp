// SPDX-License-Identifier: MIT
/// The runtime's methods in a contest of `lagen chart`. The whole generated main is
///   #include "model.hpp"
///   #include "lagen_chart/points.hpp"
///   int main(int argc, char** argv) { return lagen::chart_points<lagen::models::NAME<double>, lagen::A,
///   lagen::B>({"a", "b"}, argc, argv); }
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_chart/contest.hpp"

namespace lagen {

namespace chart {

template <class M, class Method>
struct OwnMethod {
    using State = typename M::State;
    const M& model;
    const State& start;
    const Request& request;

    OwnMethod(const M& of, const State& from, const Request& asked) : model(of), start(from), request(asked) {}

    template <class Observer>
    PointOutcome operator()(double parameter, Observer& observer) const
    {
        Method method{};
        if constexpr (requires { method.step; })
            method.step = parameter;
        else
            method.relative = method.absolute = parameter;
        const auto run = integrate(model, start, {request.start, request.end}, method,
                                   {.at = request.at, .max_steps = request.most}, observer);
        const Status status = run.status();
        return {to_text(status),
                static_cast<bool>(run),
                status == Status::too_many_steps || status == Status::not_separable,
                run.steps,
                run.rejected,
                run.rhs_calls};
    }

    [[nodiscard]] double steps_of([[maybe_unused]] double step) const
    {
        if constexpr (requires { Method::step; }) return std::abs(request.end - request.start) / step;
        return 0;
    }
};

} // namespace chart

template <class M, class... Methods>
int chart_points(const std::array<std::string_view, sizeof...(Methods)>& names, int argc, char** argv)
{
    return chart::hold_contest<M, chart::OwnMethod<M, Methods>...>(names, argc, argv);
}

} // namespace lagen
