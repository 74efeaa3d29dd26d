// SPDX-License-Identifier: MIT
/// A run of a scene, as its job says (job.hpp): in the process over a compiled model, or in a program of one model and
/// one method, whose whole generated main is
///   #include "model.hpp"
///   #include "lagen_run/driver.hpp"
///   int main(int argc, char** argv) { return lagen::drive<lagen::models::NAME<double>, lagen::METHOD>(argc, argv); }
/// Its arguments are the file of the job and that of the report (archive.hpp); rows go to standard output as native
/// doubles. Exit codes: 0 the run came to an end, which the report tells, 4 there is no job that fits the model, 5 a
/// file or the rows could not be written, or there is not memory enough, 130 interrupted by SIGINT or SIGTERM: there
/// are the rows so far, and the report.
///
/// Where an event or a failure ends a run after its start, one more row stands at the end, the last good state at its
/// time, unless that is a row anyway, or rows are asked for at times or at an event: those are exactly what is given.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_run/archive.hpp"
#include "lagen_run/branches.hpp"
#include "lagen_run/held_inputs.hpp"
#include "lagen_run/model_parts.hpp"
#include "lagen_run/record.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <type_traits>
#include <vector>

namespace lagen {

namespace detail {

/// Set by SIGINT and SIGTERM: a handler can reach nothing but a static object.
inline volatile std::sig_atomic_t drive_interrupted = 0;
extern "C" inline void lagen_drive_interrupt(int)
{
    drive_interrupted = 1;
}

/// Everything made of the job that needs the model. It stays where it is while its events are used: they jump by the
/// model in here.
template <class M>
struct RunPlan {
    M model;
    typename M::State initial;
    Interval<double> span{0, 0};
    std::vector<double> times;
    HeldInputs inputs;
    std::vector<EventRequest<double, typename M::State>> events;
};

/// Parameters, start and times. Each of these functions answers false where the job does not fit.
template <class M>
[[nodiscard]] bool plan_values(const RunJob& job, RunPlan<M>& plan)
{
    const auto lanes = static_cast<std::size_t>(lane_count(plan.model));
    const std::size_t parameters = job.parameters.size();
    if (job.initial.size() != lanes || (parameters > 0 && parameters != parameters_of(plan.model).size())) return false;
    plan.initial.resize(static_cast<Eigen::Index>(lanes));
    for (std::size_t i = 0; i < lanes; ++i) plan.initial[static_cast<Eigen::Index>(i)] = job.initial[i];
    for (std::size_t k = 0; k < parameters; ++k) set_parameter(plan.model, k, job.parameters[k]);
    plan.span = {job.start, job.end};
    return (!DiscreteMotion<M> || job.rows.kind == RowsAsked::Kind::every) &&
           plan_rows(job.rows, job.start, job.end, plan.times);
}

template <class M>
[[nodiscard]] bool plan_columns(const RunJob& job, const M& model)
{
    return std::ranges::all_of(job.columns, [&](const DriveColumn& column) {
        return column.index <
               (column.observable ? observables_of(model).size() : static_cast<std::size_t>(lane_count(model)));
    });
}

template <class M>
[[nodiscard]] bool plan_events(const RunJob& job, RunPlan<M>& plan)
{
    const Names known = events_of(plan.model);
    plan.events.clear();
    for (std::size_t k = 0; k < job.events.size(); ++k) {
        const EventAsked& asked = job.events[k];
        EventRequest<double, typename M::State> request;
        while (request.index < known.size() && asked.name != known[request.index]) ++request.index;
        if (request.index == known.size()) return false;
        if (asked.direction != 0) request.direction = asked.direction > 0 ? Crossing::rising : Crossing::falling;
        request.stop = asked.stop;
        request.count = asked.count;
        request.row = job.rows.kind == RowsAsked::Kind::event && job.rows.count == k;
        if constexpr (HasJumps<M>)
            for (std::size_t j = 0; j < jumps_of(plan.model).size(); ++j)
                if (asked.name == jumps_of(plan.model)[j])
                    request.jump = [&model = plan.model, j](double t, const typename M::State& s) {
                        return typename M::State(model.jumps(t, s).col(static_cast<Eigen::Index>(j)));
                    };
        plan.events.push_back(request);
    }
    return true;
}

template <class M, class Method>
[[nodiscard]] bool plan_method(const RunJob& job, Method& method)
{
    if constexpr (DiscreteMotion<M>) {
        return true; // the step is a parameter of the model
    } else if constexpr (requires { method.step; }) {
        method.step = job.step;
        return job.step > 0;
    } else {
        method.relative = job.relative;
        method.absolute = job.absolute;
        return method.control().is_valid();
    }
}

/// The absolute tolerance; 0 of fixed steps.
template <class Method>
double absolute_of(const Method& method) noexcept
{
    if constexpr (requires { method.absolute; }) return method.absolute;
    return 0;
}

template <class M, class Method>
[[nodiscard]] bool make_plan(const RunJob& job, RunPlan<M>& plan, Method& method)
{
    return plan_values(job, plan) && plan_columns(job, plan.model) &&
           plan_inputs(job.input_rows, inputs_of(plan.model).size(), plan.span, plan.inputs) &&
           plan_events(job, plan) && plan_method<M>(job, method);
}

template <class State>
std::vector<double> lanes_of_state(const State& s)
{
    return {s.data(), s.data() + s.size()};
}

template <class M>
RunReport report_of(const RunJob& job, const RunPlan<M>& plan, const Run<M>& run)
{
    RunReport report;
    report.status = to_text(run.status());
    report.t = run.t;
    report.failed_at = run.failed_at;
    report.steps = run.steps;
    report.rejected = run.rejected;
    report.rhs_calls = run.rhs_calls;
    report.newton = run.newton_iterations;
    report.decompositions = run.decompositions;
    report.state = lanes_of_state(run.state);
    for (const auto& found : run.events) {
        report.events.push_back({job.events[found.request].name, found.t, lanes_of_state(found.state), {}});
        if (plan.events[found.request].jump) report.events.back().after = lanes_of_state(found.after);
    }
    for (const std::size_t request : run.starts_on) report.starts_on.push_back(job.events[request].name);
    return report;
}

/// Integrates what the plan of `job` asks for, and gives the rows.
template <class M, class Method>
RunReport run_plan(RunPlan<M>& plan, const Method& method, const RunJob& job, const RowTaker& rows,
                   const volatile std::sig_atomic_t* signal)
{
    using Kind = RowsAsked::Kind;
    DriveRecord<M> record(plan.model, job.columns, rows, job.rows.kind == Kind::every ? job.rows.count : 0,
                          absolute_of(method));
    Branches<M> branches(plan.model, plan.span.start, job.from_arrow);
    const Status start = branches.begin(plan.initial, job.branch);
    Options<M> options{.at = plan.times, .events = plan.events, .signal = signal};
    if (job.max_steps > 0) options.max_steps = job.max_steps;

    const auto begin = std::chrono::steady_clock::now();
    const auto run = start == Status::ok
                         ? integrate_held(plan.inputs, plan.model, plan.initial, plan.span, method, options, record)
                         : no_run<M>(plan.initial, plan.span.start, start);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const bool ended_early = run.status() != Status::ok && run.steps > 0;
    const bool fixed = job.rows.kind == Kind::at || job.rows.kind == Kind::event;
    if (ended_early && !fixed && record.last_time() != run.t) record.row(run.t, run.state);
    RunReport report = report_of(job, plan, run);
    report.seconds = seconds.count();
    const bool refused = run.status() == Status::singular_mass_matrix || run.status() == Status::not_separable ||
                         run.status() == Status::invalid_input;
    if (run.steps > 0 || !refused) record.report(report); // one that was refused at its start has measured nothing
    branches.report(run, report);
    return report;
}

inline int complain(const char* complaint, int code)
{
    std::fprintf(stderr, "error: %s\n", complaint);
    return code;
}

} // namespace detail

/// The whole program; see the top of the file. Returns the exit code.
template <class M, class Method>
int drive(int argc, char** argv)
try {
    static_assert(std::is_same_v<typename M::Scalar, double>, "lagen run integrates in double");
    detail::RunJob job;
    detail::RunPlan<M> plan;
    Method method{};
    if (argc != 3 || !detail::read_packed(argv[1], job) || !detail::make_plan(job, plan, method))
        return detail::complain("a job for this model and the place of its report are required", 4);

    std::signal(SIGINT, detail::lagen_drive_interrupt);
    std::signal(SIGTERM, detail::lagen_drive_interrupt);
    const auto give = [](std::span<const double> row) { std::fwrite(row.data(), sizeof(double), row.size(), stdout); };
    const detail::RunReport report = detail::run_plan(plan, method, job, give, &detail::drive_interrupted);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        return detail::complain("the rows could not be written to standard output", 5);
    if (!detail::write_bytes(argv[2], detail::packed(report)))
        return detail::complain("the report could not be written", 5);
    return report.status == to_text(Status::interrupted) ? 130 : 0;
} catch (const std::exception& error) {
    return detail::complain((std::string("the scene cannot be integrated: ") + error.what()).c_str(), 5);
}

} // namespace lagen
