// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/measure.hpp"

#include "commands/machine/write_file.hpp"
#include "lagen_run/archive.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace lagen {

namespace {

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

} // namespace

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

} // namespace lagen
