// SPDX-License-Identifier: MIT
/// A reference of `lagen chart`: one method in 113 bits, a run of its own from each sample time to the next, so that no
/// value comes from a dense output. The whole generated main is
///   #include "model.hpp"
///   #include "lagen_chart/reference.hpp"
///   int main(int argc, char** argv) { return lagen::chart_reference<lagen::models::NAME<lagen::Quad>,
///   lagen::METHOD>(argc, argv); }
/// Its argument is the file of request.hpp. It prints a line a sample that was reached, HIGH LOW for every lane, and
/// lines status=, t=, steps=, rhs_calls= behind them; where events are asked for no rows, and t is that of the event.
#pragma once

#include "lagen_chart/quad.hpp"

#include "lagen/integrate.hpp"
#include "lagen_chart/request.hpp"

#include <cstdio>

namespace lagen {

namespace chart {

template <class M>
void print_row(const typename M::State& s)
{
    for (Eigen::Index i = 0; i < s.size(); ++i) {
        const double high = static_cast<double>(s[i]);
        std::printf("%s%.17g %.17g", i == 0 ? "" : " ", high, static_cast<double>(s[i] - Quad(high)));
    }
    std::printf("\n");
}

template <class M, class Method>
Status run_to_event(const M& model, const typename M::State& start, const Request& request, const Method& method,
                    Quad& end)
{
    std::vector<EventRequest<Quad, typename M::State>> events;
    if constexpr (HasEvents<M>)
        for (const EventAsked& asked : request.events)
            for (std::size_t k = 0; k < M::events_names.size(); ++k) {
                if (asked.name != M::events_names[k]) continue;
                const Crossing direction = asked.direction == "rising"    ? Crossing::rising
                                           : asked.direction == "falling" ? Crossing::falling
                                                                          : Crossing::any;
                events.push_back({.index = k, .direction = direction, .stop = true, .count = asked.count});
            }
    const auto run = integrate(model, start, {Quad(request.span.start), Quad(request.span.end)}, method,
                               {.events = events, .max_steps = request.most});
    end = run.t;
    return run.status();
}

} // namespace chart

template <class M, class Method>
int chart_reference(int argc, char** argv)
{
    chart::Request request;
    M model;
    typename M::State start;
    if (argc != 2 || !chart::read_request(argv[1], request) || !chart::fill(request, model, start)) return 4;
    const Method method{.tolerance = request.tolerance};
    Status status = Status::ok;
    Quad reached(request.span.start);
    std::size_t steps = 0, calls = 0;
    if (!request.events.empty()) {
        status = chart::run_to_event(model, start, request, method, reached);
    } else {
        Integrator integrator(model, start, reached, method);
        for (const double t : request.at) {
            while (status == Status::ok && integrator.t() != Quad(t))
                status = integrator.steps() + integrator.rejected() < request.most ? integrator.step_towards(Quad(t))
                                                                                   : Status::too_many_steps;
            reached = integrator.t();
            if (status != Status::ok) break;
            chart::print_row<M>(integrator.state());
        }
        steps = integrator.steps();
        calls = integrator.rhs_calls();
    }
    std::printf("status=%s\nt=%.17g\nsteps=%zu\nrhs_calls=%zu\n", to_text(status), static_cast<double>(reached), steps,
                calls);
    return std::fflush(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
