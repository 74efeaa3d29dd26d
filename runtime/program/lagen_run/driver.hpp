// SPDX-License-Identifier: MIT
/// The program behind `lagen run`: integrates one model with one method as its arguments say. The whole generated main
/// is
///   #include "model.hpp"
///   #include "lagen_run/driver.hpp"
///   int main(int argc, char** argv) { return lagen::drive<lagen::models::NAME<double>, lagen::METHOD>(argc, argv); }
///
/// Arguments, each followed by its value (numbers as strtod reads them, hexadecimal included):
///   --parameters v,v,..   every parameter, in the order of the header; left out: the defaults
///   --initial v,v,..      every state lane, base first; required
///   --start T --end T     the interval; start is 0 where left out, end is required and may be smaller
///   --step H              fixed-step methods; required there (positive; the sign follows the interval)
///   --relative R --absolute A   adaptive methods; default 1e-9 each
///   --max-steps N
///   --from arrow          a discrete motion: the momenta are those of the arrow, whatever --initial gives
///   --branch N            one that starts from momenta: its first arrow is the N-th of those that are found
///   (branches.hpp)
///   --inputs FILE         rows t u u ..: inputs, in the order of the header, that are held until the next row
///   (held_inputs.hpp)
///   --every N             rows at the start and behind every N-th step; the rows of a discrete motion
///   --samples N | --interval H | --at-file FILE | --at-event NAME   rows at N even times, every H from the start on
///                         (and the end), at the numbers of FILE (separated by space or comma, in the direction of
///                         time), or at each crossing of one of --events. Default: --samples 201
///   --events name:direction:stop:count,..   direction rising, falling or any; stop 0 or 1; count from 1; names of the
///                         header. Behind one that stands in its jumps_names the state jumps
///   --columns c,c,..      s0, s1, .. state lanes; o0, o1, .. entries of observables(); left out: every state lane;
///   "-": none
///   --format csv|binary   rows on standard output: CSV of shortest decimals (an empty field for what is no finite
///   number), commas, "\n", no heading; or native doubles, row after row
///   --report FILE         where the report goes ("-": standard error)
///
/// A row is t, then the columns. Rows appear while the run goes on, at exactly the times asked for; where an event or a
/// failure ends the run after its start, one more row stands at the end, the last good state at its time (unless that
/// was asked for anyway; rows of --at-file and --at-event are exactly what is written). The report, at the end of every
/// run, has lines KEY=VALUE in this order, numbers as shortest decimals, those in brackets only where the model has the
/// part:
///   status=ok             as to_text(Status)
///   t=10                  time of the last good state
///   failed_at=10          time at which the run met what ended it; the same as t where nothing failed
///   steps=  rejected=  rhs_calls=  [newton=  decompositions=]  rows=  seconds=      those in brackets of implicit
///   methods
///   event=NAME@T@v,v,..   one line an event found, in the order of the run, with the state there; with @v,v,.. more
///                         where it jumps: the state behind all jumps of that instant
///   starts_on=NAME        one line an event on or beyond whose zero the run starts, and which for that reason does not
///                         happen there
///   [energy= or hamiltonian=]  [balance=, work=]  [invariant:NAME=]  [constraint:NAME=]  [casimir:NAME=]
///                         INITIAL,MOST,T,SLOPE,ERROR,SIZE,MOVED_AT, over the steps that figures.hpp names: the first
///                         value; the largest distance from it (from 0, of constraints) and where that was; slope and
///                         error of slope.hpp; where the distance was more than 1e-3 of |value|, the size of
///                         figures.hpp and where it first was more than 1e-3 of that ("nan" where there is none).
///                         balance: the energy less the work, which is the integral of the power up to the end
///   [manifold=DISTANCE,T] the largest distance from where the constraints hold, to first order, and where that was
///   [below=LANE:MOST]     one line a lane that moved and never exceeded --absolute, with its largest |s_i|
///   [branches=d,d,..]     distances of the arrows that are found with the momenta of a discrete start: with --branch,
///                         and where no step leads on (no_solution, branch_lost, newton_diverged) from momenta
///   [others=d,d,..]       of those with the momenta of the step that failed, from the arrow before
///   state=v,v,..          the last good state
/// Exit codes: 0 ok or stopped by an event, 1 another status, 4 wrong arguments (one sentence on standard error, no
/// report), 5 a file could not be read or written, or there is not memory enough, 130 interrupted (SIGINT, SIGTERM:
/// rows so far are kept, the report is written).
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_run/arguments.hpp"
#include "lagen_run/branches.hpp"
#include "lagen_run/held_inputs.hpp"
#include "lagen_run/model_parts.hpp"
#include "lagen_run/record.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
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

/// Everything made of the arguments that needs the model.
template <class M>
struct DrivePlan {
    M model;
    typename M::State initial;
    Interval<double> span{0, 0};
    std::vector<double> times;
    HeldInputs inputs;
    std::vector<EventRequest<double, typename M::State>> events;
    std::vector<std::string> event_names;
    std::vector<DriveColumn> columns;
};

template <class M>
Complaint plan_values(const DriveArguments& given, DrivePlan<M>& plan)
{
    const auto lanes = static_cast<std::size_t>(lane_count(plan.model));
    if (given.initial.size() != lanes)
        return "--initial: " + std::to_string(given.initial.size()) + " numbers, " + std::to_string(lanes) +
               " are required";
    plan.initial.resize(static_cast<Eigen::Index>(lanes));
    for (std::size_t i = 0; i < given.initial.size(); ++i)
        plan.initial[static_cast<Eigen::Index>(i)] = given.initial[i];
    if (given.parameters.empty()) return {};
    const std::size_t count = parameters_of(plan.model).size();
    if (given.parameters.size() != count)
        return "--parameters: " + std::to_string(given.parameters.size()) + " numbers, " + std::to_string(count) +
               " are required";
    for (std::size_t k = 0; k < count; ++k) set_parameter(plan.model, k, given.parameters[k]);
    return {};
}

template <class M>
Complaint plan_times(const DriveArguments& given, DrivePlan<M>& plan)
{
    if (!given.end) return "--end is required";
    plan.span = {given.start.value_or(0.0), *given.end};
    if (given.every) return *given.every > 0 ? Complaint{} : "--every: a positive number of steps is required";
    if (DiscreteMotion<M>) return "--every: the rows of a discrete motion are at its steps";
    if (!given.at_event.empty()) return plan.times.clear(), Complaint{};
    if (given.at) {
        plan.times = *given.at;
        return check_order(plan.times, plan.span.end < plan.span.start);
    }
    if (given.interval) {
        if (!(*given.interval > 0)) return "--interval: " + number_text(*given.interval) + " is not positive";
        const double pieces = std::abs(plan.span.end - plan.span.start) / *given.interval;
        if (!(pieces <= most_rows)) return "--interval: " + number_text(*given.interval) + " makes more than 1e8 rows";
        plan.times = spaced_times(plan.span.start, plan.span.end, *given.interval);
        return {};
    }
    const std::size_t samples = given.samples.value_or(201);
    if (static_cast<double>(samples) > most_rows) return "--samples: more than 1e8 rows";
    plan.times = even_times(plan.span.start, plan.span.end, samples);
    return {};
}

/// "s3" or "o1".
template <class M>
Complaint plan_columns(const DriveArguments& given, DrivePlan<M>& plan)
{
    if (!given.columns) {
        for (Eigen::Index i = 0; i < lane_count(plan.model); ++i) plan.columns.push_back({false, i});
        return {};
    }
    if (*given.columns == "-") return {};
    for (const std::string& text : split(*given.columns, ',')) {
        const bool observable = !text.empty() && text[0] == 'o';
        const auto count =
            observable ? observables_of(plan.model).size() : static_cast<std::size_t>(lane_count(plan.model));
        const auto index = text.empty() || (text[0] != 's' && !observable) ? std::nullopt : read_count(text.substr(1));
        if (!index || *index >= count)
            return "--columns: \"" + text + "\" is neither a state lane nor an observable of the model";
        plan.columns.push_back({observable, static_cast<Eigen::Index>(*index)});
    }
    return {};
}

/// "name:direction:stop:count"; a name may hold colons itself.
template <class M>
Complaint plan_event(const std::string& text, DrivePlan<M>& plan)
{
    std::vector<std::string> parts = split(text, ':');
    const Complaint wrong = "--events: \"" + text + "\" is not name:direction:stop:count with an event of the model";
    if (parts.size() < 4) return wrong;
    std::string name = parts[0];
    for (std::size_t i = 1; i + 3 < parts.size(); ++i) name += ':' + parts[i];
    const std::string& direction = parts[parts.size() - 3];
    const std::string& stop = parts[parts.size() - 2];
    const auto count = read_count(parts.back());
    EventRequest<double, typename M::State> request;
    bool known = false;
    const Names events = events_of(plan.model);
    for (std::size_t k = 0; k < events.size() && !known; ++k) {
        known = name == events[k];
        request.index = k;
    }
    if (!known || !count || *count == 0 || (stop != "0" && stop != "1")) return wrong;
    if (direction == "rising")
        request.direction = Crossing::rising;
    else if (direction == "falling")
        request.direction = Crossing::falling;
    else if (direction != "any")
        return wrong;
    request.stop = stop == "1";
    request.count = *count;
    plan.events.push_back(request);
    plan.event_names.push_back(name);
    return {};
}

/// Rows at the crossings of an event, and the jumps of events, which are those of the plan's own model: it stays where
/// it is while they are used.
template <class M>
Complaint plan_crossings(const DriveArguments& given, DrivePlan<M>& plan)
{
    bool known = given.at_event.empty();
    for (std::size_t k = 0; k < plan.events.size(); ++k) {
        plan.events[k].row = plan.event_names[k] == given.at_event;
        known = known || plan.events[k].row;
        if constexpr (HasJumps<M>)
            for (std::size_t j = 0; j < jumps_of(plan.model).size(); ++j)
                if (plan.event_names[k] == jumps_of(plan.model)[j])
                    plan.events[k].jump = [&model = plan.model, j](double t, const typename M::State& s) {
                        return typename M::State(model.jumps(t, s).col(static_cast<Eigen::Index>(j)));
                    };
    }
    return known ? Complaint{} : "--at-event: \"" + given.at_event + "\" is none of --events";
}

template <class M, class Method>
Complaint plan_method(const DriveArguments& given, Method& method)
{
    if (given.branch && !DiscreteMotion<M>) return "--branch: the arrows of a discrete motion have branches";
    if constexpr (DiscreteMotion<M>) {
        if (given.step) return "--step: the step is a parameter of this model";
    } else if constexpr (requires { method.step; }) {
        if (!given.step || !(*given.step > 0)) return "--step: a positive step is required by this method";
        method.step = *given.step;
    } else {
        method.relative = given.relative.value_or(method.tolerance);
        method.absolute = given.absolute.value_or(method.tolerance);
        if (!method.control().is_valid()) return "--relative, --absolute: not negative and not both zero is required";
    }
    return {};
}

/// The absolute tolerance; 0 of fixed steps.
template <class Method>
double absolute_of(const Method& method) noexcept
{
    if constexpr (requires { method.absolute; }) return method.absolute;
    return 0;
}

template <class M, class Method>
Complaint make_plan(const DriveArguments& given, DrivePlan<M>& plan, Method& method)
{
    Complaint complaint = plan_values(given, plan);
    if (complaint.empty()) complaint = plan_times(given, plan);
    if (complaint.empty())
        complaint = plan_inputs(given.input_rows, inputs_of(plan.model).size(), plan.span, plan.inputs);
    if (complaint.empty()) complaint = plan_columns(given, plan);
    if (complaint.empty()) complaint = plan_method<M>(given, method);
    for (const std::string& event : split(given.events, ','))
        if (complaint.empty()) complaint = plan_event(event, plan);
    return complaint.empty() ? plan_crossings(given, plan) : complaint;
}

template <class M>
std::string report_text(const DrivePlan<M>& plan, const Run<M>& run, const DriveRecord<M>& record, double seconds,
                        const std::string& branches)
{
    std::string text = std::string("status=") + to_text(run.status()) + '\n';
    text += "t=" + number_text(run.t) + "\nfailed_at=" + number_text(run.failed_at) + '\n';
    text += "steps=" + std::to_string(run.steps) + "\nrejected=" + std::to_string(run.rejected) + '\n';
    text += "rhs_calls=" + std::to_string(run.rhs_calls) + '\n';
    if (run.newton_iterations != 0) text += "newton=" + std::to_string(run.newton_iterations) + '\n';
    if (run.decompositions != 0) text += "decompositions=" + std::to_string(run.decompositions) + '\n';
    text += "rows=" + std::to_string(record.rows()) + '\n';
    text += "seconds=" + number_text(seconds) + '\n';
    const auto put = [&](const typename M::State& s) {
        for (Eigen::Index i = 0; i < s.size(); ++i) text += (i == 0 ? "" : ",") + number_text(s[i]);
    };
    for (const auto& found : run.events) {
        text += "event=" + plan.event_names[found.request] + '@' + number_text(found.t) + '@';
        put(found.state);
        if (plan.events[found.request].jump) text += '@', put(found.after);
        text += '\n';
    }
    for (const std::size_t request : run.starts_on) text += "starts_on=" + plan.event_names[request] + '\n';
    text += record.report() + branches + "state=";
    put(run.state);
    return text + '\n';
}

/// False where the text could not be written.
inline bool write_report(const std::string& path, const std::string& text)
{
    if (path.empty()) return true;
    std::FILE* file = path == "-" ? stderr : std::fopen(path.c_str(), "w");
    if (file == nullptr) return false;
    bool good = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (file == stderr) return std::fflush(file) == 0 && good;
    return std::fclose(file) == 0 && good;
}

inline int complain(const std::string& complaint, int code)
{
    std::fprintf(stderr, "error: %s\n", complaint.c_str());
    return code;
}

/// Integrates what the plan asks for and writes the rows; answers the report that the top of the file describes.
template <class M, class Method>
std::string run_plan(DrivePlan<M>& plan, const Method& method, const DriveArguments& given, const RowSink& rows,
                     const volatile std::sig_atomic_t* signal, Status& status)
{
    DriveRecord<M> record(plan.model, plan.columns, given.format == "binary", rows, given.every.value_or(0),
                          absolute_of(method));
    Branches<M> branches(plan.model, plan.span.start, given.from_arrow);
    const Status start = branches.begin(plan.initial, given.branch);
    Options<M> options{.at = plan.times, .events = plan.events, .signal = signal};
    if (given.max_steps) options.max_steps = *given.max_steps;

    const auto begin = std::chrono::steady_clock::now();
    const auto run = start == Status::ok
                         ? integrate_held(plan.inputs, plan.model, plan.initial, plan.span, method, options, record)
                         : no_run<M>(plan.initial, plan.span.start, start);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const bool ended_early = run.status() != Status::ok && run.steps > 0;
    const bool fixed = given.at || !given.at_event.empty();
    if (ended_early && !fixed && record.last_time() != run.t) record.row(run.t, run.state);
    status = run.status();
    return report_text(plan, run, record, seconds.count(), branches.report(run));
}

} // namespace detail

/// The whole program; see the top of the file. Returns the exit code.
template <class M, class Method>
int drive(int argc, char** argv)
try {
    static_assert(std::is_same_v<typename M::Scalar, double>, "lagen run integrates in double");
    detail::DriveArguments given;
    detail::DrivePlan<M> plan;
    Method method{};
    detail::Complaint complaint = detail::read_arguments(argc, argv, given);
    if (complaint.empty()) complaint = detail::make_plan(given, plan, method);
    if (!complaint.empty()) return detail::complain(complaint, complaint.ends_with("opened") ? 5 : 4);

    std::signal(SIGINT, detail::lagen_drive_interrupt);
    std::signal(SIGTERM, detail::lagen_drive_interrupt);
    Status status = Status::ok;
    const std::string report = detail::run_plan(
        plan, method, given, [](std::string_view row) { std::fwrite(row.data(), 1, row.size(), stdout); },
        &detail::drive_interrupted, status);
    const bool rows_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (!rows_written) return detail::complain("the rows could not be written to standard output", 5);
    if (!detail::write_report(given.report, report))
        return detail::complain("the report could not be written to \"" + given.report + "\"", 5);
    if (status == Status::interrupted) return 130;
    return is_success(status) ? 0 : 1;
} catch (const std::exception& error) {
    return detail::complain(std::string("the scene cannot be integrated: ") + error.what(), 5);
}

} // namespace lagen
