// SPDX-License-Identifier: MIT
/// A reference of `lagen chart`: one method in 113 bits, a run of its own from each sample time to the next, so that no
/// value comes from a dense output. The whole generated main is
///   #include "model.hpp"
///   #include "lagen_chart/reference.hpp"
///   int main(int argc, char** argv) { return lagen::chart_reference<lagen::models::NAME<lagen::Quad>,
///   lagen::METHOD>(argc, argv); }
/// It answers a ReferenceReport.
#pragma once

#include "lagen_chart/quad.hpp"

#include "lagen/integrate.hpp"
#include "lagen_chart/answer.hpp"

namespace lagen {

namespace chart {

template <class State>
void add_row(const State& s, std::vector<double>& rows)
{
    for (Eigen::Index i = 0; i < s.size(); ++i) {
        rows.push_back(static_cast<double>(s[i]));
        rows.push_back(static_cast<double>(s[i] - Quad(rows.back())));
    }
}

template <class M, class Method>
Status run_to_event(const M& model, const typename M::State& start, const Request& request, const Method& method,
                    Quad& end)
{
    std::vector<EventRequest<Quad, typename M::State>> events;
    if constexpr (HasEvents<M>)
        for (const detail::EventAsked& asked : request.events)
            for (std::size_t k = 0; k < M::events_names.size(); ++k) {
                if (asked.name != M::events_names[k]) continue;
                const Crossing direction = asked.direction > 0   ? Crossing::rising
                                           : asked.direction < 0 ? Crossing::falling
                                                                 : Crossing::any;
                events.push_back({.index = k, .direction = direction, .stop = true, .count = asked.count});
            }
    const auto run = integrate(model, start, {Quad(request.start), Quad(request.end)}, method,
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
    if (!chart::take_request(argc, argv, request, model, start)) return 4;
    const Method method{.tolerance = request.tolerance};
    chart::ReferenceReport report;
    Status status = Status::ok;
    Quad reached(request.start);
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
            chart::add_row(integrator.state(), report.rows);
        }
        report.steps = integrator.steps();
        report.calls = integrator.rhs_calls();
    }
    report.status = to_text(status);
    report.t = static_cast<double>(reached);
    chart::answer(report);
    return std::ferror(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
