// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/chart.hpp"

#include "commands/line/options.hpp"
#include "elaborate/bind_parameters.hpp"
#include "emit/print_header.hpp"
#include "lagen_run/archive.hpp"
#include "machine/write_file.hpp"
#include "scene/preparation.hpp"
#include "text/comma_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>

namespace lagen {

namespace {

/// What the processor calls itself.
std::string machine_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
    return "an unnamed processor";
}

struct Contestant {
    std::string name;
    bool adaptive = true; ///< climbs a ladder of tolerances, else of steps
};

/// A program that runs the methods of a family.
struct MethodFamily {
    std::string peer; ///< the library; empty: lagen's own
    std::vector<Contestant> methods;
    ProgramText text;
    std::string program; ///< path, once it is compiled
};

enum class Kinship { explicit_steps, pair, nystrom, series, implicit, splitting, group };

Kinship kinship_of(const MethodEntry& method)
{
    switch (method.kind) {
    case MethodKind::splitting: return Kinship::splitting;
    case MethodKind::series: return Kinship::series;
    case MethodKind::implicit_stages: return Kinship::implicit;
    case MethodKind::group:
    case MethodKind::poisson: return Kinship::group;
    case MethodKind::explicit_stages: break;
    case MethodKind::discrete: throw InternalError("a discrete motion has no chart");
    }
    if (method.system != SecondOrder::Kind::no) return Kinship::nystrom;
    return method.adaptive ? Kinship::pair : Kinship::explicit_steps;
}

/// A library that takes part where it is installed, by runtime/program/lagen_chart/NAME.hpp.
struct PeerEntry {
    const char* name;
    const char* header;
    const char* package;
    const char* libraries;
    std::array<const char*, 3> methods; ///< nullptr where there are fewer
};

constexpr std::array peers{
    PeerEntry{"odeint", "boost/numeric/odeint.hpp", "libboost-dev", "", {"dopri5", "fehlberg78", "bulirsch_stoer"}},
    PeerEntry{"gsl", "gsl/gsl_odeiv2.h", "libgsl-dev", "-lgsl,-lgslcblas", {"rk8pd", "rkf45", nullptr}},
    PeerEntry{"sundials",
              "cvode/cvode.h",
              "libsundials-dev",
              "-lsundials_cvode,-lsundials_nvecserial,-lsundials_sunnonlinsolfixedpoint",
              {"cvode_adams", nullptr, nullptr}},
};

constexpr std::size_t quick_repeats = 5, slow_repeats = 3;
constexpr double slow_round = 10; ///< seconds

// The reference asks for an error of 1e-20 with order 9 or more; for 1e-12, where a method of high order is at home,
// its calls are fewer by 10^(8/9) at least, for 1e-3, where a ladder of steps begins, its steps by 10^(17/9).
constexpr std::size_t calls_allowed = 4;    ///< times those of the reference: about thirty times those for 1e-12
constexpr std::size_t least_calls = 20'000; ///< allowed in any case: milliseconds
constexpr double longest_step = 64;         ///< times the mean one of the reference
constexpr double least_tolerance = 1e-15, largest_tolerance = 1e-1, between_tolerances = 0.31622776601683794;

/// The first step of a ladder: the longest part of the time between two of 21 samples by a power of two that is not
/// longer than `longest_step`.
double first_step_of(const ChartProblem& problem, const ChartReference& reference)
{
    const double length = std::abs(problem.end - problem.start);
    const double longest = longest_step * length / static_cast<double>(std::max<std::size_t>(reference.steps, 1));
    double step = length / 20;
    while (step > longest) step /= 2;
    return step;
}

chart::Ladder ladder_of(const Contestant& method, double first_step, std::size_t calls)
{
    if (method.adaptive) return {method.name, largest_tolerance, between_tolerances, least_tolerance, calls};
    return {method.name, first_step, 0.5, first_step * 0x1p-24, calls};
}

ChartPoint point_of(const chart::PointReport& report)
{
    ChartPoint point;
    point.method = report.method;
    point.parameter = report.parameter;
    point.status = report.run.status;
    if (std::isfinite(report.error)) point.error = report.error;
    for (const detail::Drift& drift : report.run.invariants) point.drifts.emplace_back(drift.name, drift.most);
    point.seconds = report.run.seconds;
    point.steps = report.run.steps;
    point.rejected = report.run.rejected;
    point.rhs_calls = report.run.rhs_calls;
    return point;
}

/// The points that a program answered.
std::vector<ChartPoint> read_points(std::string_view answer)
{
    std::vector<ChartPoint> points;
    for (chart::PointReport report; !answer.empty(); report = {}) {
        if (!detail::take_packed(answer, report)) throw InternalError("a chart's program gave another point");
        points.push_back(point_of(report));
    }
    return points;
}

/// A program with its points so far.
struct FamilyRuns {
    std::string peer, program;
    chart::Request request;
    std::vector<ChartPoint> points; ///< with their least seconds
    std::vector<double> slowest;

    void see(const std::vector<ChartPoint>& found)
    {
        if (points.empty()) {
            points = found;
            slowest.resize(found.size());
        }
        if (found.size() != points.size()) throw InternalError("a repeat of a chart has other points");
        for (std::size_t k = 0; k < found.size(); ++k) {
            points[k].seconds = std::min(points[k].seconds, found[k].seconds);
            slowest[k] = std::max(slowest[k], found[k].seconds);
        }
    }

    /// From now on these points alone are asked for.
    void ask_again(std::size_t calls)
    {
        request.ladders.clear();
        for (const ChartPoint& point : points)
            request.ladders.push_back({point.method, point.parameter, 1, point.parameter, calls});
    }
};

/// The methods that are wanted, by families; where none is named all that apply, and those that do not are told with
/// the reason. Throws where one that is wanted does not apply.
std::vector<MethodFamily> method_families(const ChartProblem& problem, const std::vector<const MethodEntry*>& wanted,
                                          std::vector<LeftOutMethod>& left_out)
{
    std::map<Kinship, std::vector<const MethodEntry*>> families;
    for (const MethodEntry& method : method_table()) {
        if (wanted.empty() ? *method.scheme != '\0' : std::ranges::find(wanted, &method) == wanted.end()) continue;
        const std::string obstacle = obstacle_to(method, problem);
        if (!obstacle.empty() && !wanted.empty()) throw UsageError(obstacle);
        if (obstacle.empty())
            families[kinship_of(method)].push_back(&method);
        else
            left_out.push_back({method.name, obstacle});
    }
    std::vector<MethodFamily> list;
    for (const auto& [kinship, methods] : families) {
        MethodFamily family;
        for (const MethodEntry* method : methods) family.methods.push_back({method->name, method->adaptive});
        family.text = {problem.header, main_text({"model.hpp", "lagen_chart/points.hpp"},
                                                 call_of("chart_points", problem.module, methods))};
        list.push_back(std::move(family));
    }
    return list;
}

/// The libraries that are installed; those that are not are told with their packages.
std::vector<MethodFamily> peer_families(const ChartProblem& problem, std::vector<LeftOutMethod>& left_out)
{
    std::vector<MethodFamily> list;
    for (const PeerEntry& peer : peers) {
        if (!finds_header(peer.header)) {
            left_out.push_back({peer.name, fmt::format("the compiler does not find {} (Debian package {})", peer.header,
                                                       peer.package)});
            continue;
        }
        MethodFamily family;
        family.peer = peer.name;
        for (const char* method : peer.methods)
            if (method != nullptr) family.methods.push_back({method, true});
        family.text = {problem.header,
                       main_text({"model.hpp", fmt::format("lagen_chart/{}.hpp", peer.name)},
                                 fmt::format("chart_peer<lagen::models::{}<double>>(argc, argv)",
                                             class_name(problem.module.name))),
                       split_list(peer.libraries)};
        list.push_back(std::move(family));
    }
    return list;
}

/// Each program climbs the ladders of its methods, then repeats their points by turns with the others, so that what
/// disturbs the machine for a while disturbs all of them. Which points are there depends on numbers of steps and calls
/// alone; what they cost, on the machine.
std::vector<ChartPoint> measure_points(const ChartProblem& problem, const ChartReference& reference,
                                       const std::vector<MethodFamily>& families, std::size_t& repeats)
{
    const std::size_t calls = std::max(calls_allowed * reference.calls, least_calls);
    chart::Request common = request_of(problem);
    common.most = calls;
    common.reference = reference.rows;
    std::vector<FamilyRuns> runs;
    for (const MethodFamily& family : families) {
        runs.push_back({family.peer, family.program, common, {}, {}});
        for (const Contestant& method : family.methods)
            runs.back().request.ladders.push_back(ladder_of(method, first_step_of(problem, reference), calls));
    }
    const auto begin = std::chrono::steady_clock::now();
    repeats = quick_repeats;
    for (std::size_t round = 0; round < repeats; ++round) {
        write_standard_error(fmt::format("measuring, round {} of {}\n", round + 1, repeats));
        for (FamilyRuns& family : runs) {
            family.see(read_points(answers_of({{family.program, detail::packed(family.request)}}, 1)[0]));
            if (round == 0) family.ask_again(10 * calls);
        }
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        if (round == 0 && taken.count() > slow_round) repeats = slow_repeats;
    }
    std::vector<ChartPoint> points;
    for (FamilyRuns& family : runs)
        for (std::size_t k = 0; k < family.points.size(); ++k) {
            family.points[k].peer = family.peer;
            family.points[k].spread = family.slowest[k] / family.points[k].seconds;
            points.push_back(std::move(family.points[k]));
        }
    return points;
}

} // namespace

CheckedModel charted_model(const Options& options, const std::string& path)
{
    CheckedModel checked = read(path, options.settings(), options.has("unchecked"));
    bind_all_in_scene(checked.model, find_scene(checked.model, options.get("scene")));
    prove(checked);
    return checked;
}

Chart make_chart(CheckedModel& checked, const ChartRequest& request)
{
    ChartProblem problem = chart_problem(checked, request.scene);
    Chart chart;
    chart.model = checked.model.name;
    chart.title = checked.model.title;
    chart.scene = request.scene.name;
    chart.form = request.scene.form;
    chart.energy_changes = has_kernel(problem.module, "power");
    std::vector<MethodFamily> families = method_families(problem, request.methods, chart.left_out);
    if (request.peers)
        for (MethodFamily& peer : peer_families(problem, chart.left_out)) families.push_back(std::move(peer));
    require_quad();
    std::vector<ProgramText> texts = reference_programs(problem);
    for (const MethodFamily& family : families) texts.push_back(family.text);
    const std::vector<std::string> programs = compile_programs(texts);
    for (std::size_t k = 0; k < families.size(); ++k) families[k].program = programs[k + 2];
    const std::array<std::string, 2> methods = reference_methods(problem);
    chart.reference_methods = {methods.begin(), methods.end()};
    write_standard_error(fmt::format("reference in 113 bits: {} and {}\n", methods[0], methods[1]));
    const ChartReference reference = make_reference(problem, {programs[0], programs[1]}, chart.scene);
    chart.start = problem.start;
    chart.end = problem.end;
    chart.times = problem.times;
    chart.reference_error = reference.error;
    chart.shortened = reference.shortened;
    chart.ended_by_event = reference.ended_by_event;
    chart.machine = machine_name();
    chart.compiler = compiler_text();
    chart.points = measure_points(problem, reference, families, chart.repeats);
    return chart;
}

const ChartPoint* cheapest_within(const std::vector<ChartPoint>& points, double error)
{
    const ChartPoint* best = nullptr;
    for (const ChartPoint& point : points)
        if (point.error && *point.error <= error && (best == nullptr || point.seconds < best->seconds)) best = &point;
    return best;
}

std::string call_of(const char* function, const KernelModule& module, const std::vector<const MethodEntry*>& methods)
{
    std::string types;
    for (const MethodEntry* method : methods) types += fmt::format(", lagen::{}", method->type);
    const std::string names =
        comma_list(methods, [](const MethodEntry* method) { return fmt::format("\"{}\"", method->name); });
    return fmt::format("{}<lagen::models::{}<double>{}>({{{}}}, argc, argv)", function, class_name(module.name), types,
                       names);
}

std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem)
{
    if (method.kind == MethodKind::series) return problem.no_series;
    const std::optional<Obstacle> obstacle = obstacle_of(method, problem.module);
    return obstacle ? obstacle->text : "";
}

} // namespace lagen
