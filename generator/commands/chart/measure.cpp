// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/measure.hpp"

#include "commands/machine/write_file.hpp"
#include "commands/scene/run_report.hpp"
#include "commands/scene/scene_program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

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

std::string ladder_line(const Contestant& method, double first_step, std::size_t calls)
{
    return method.adaptive ? fmt::format("ladder {} {:.17g} {:.17g} {:.17g} {}\n", method.name, largest_tolerance,
                                         between_tolerances, least_tolerance, calls)
                           : fmt::format("ladder {} {:.17g} 0.5 {:.17g} {}\n", method.name, first_step,
                                         first_step * 0x1p-24, calls);
}

ChartPoint point_of(const std::string& block)
{
    RunOutcome outcome;
    ChartPoint point;
    for (std::size_t begin = 0; begin < block.size();) {
        const std::size_t end = std::min(block.find('\n', begin), block.size());
        const std::string line = block.substr(begin, end - begin);
        if (line.starts_with("point=")) point.method = line.substr(6);
        if (line.starts_with("parameter=")) point.parameter = std::strtod(line.c_str() + 10, nullptr);
        if (line.starts_with("error=")) point.error = std::strtod(line.c_str() + 6, nullptr);
        begin = end + 1;
    }
    read_report(block, outcome);
    const auto count = [](const std::string& text) { return std::strtoul(text.c_str(), nullptr, 10); };
    point.status = outcome.status;
    point.steps = count(outcome.steps);
    point.rejected = count(outcome.rejected);
    point.rhs_calls = count(outcome.rhs_calls);
    point.seconds = std::strtod(outcome.seconds.c_str(), nullptr);
    for (const Drift& drift : outcome.invariants)
        point.drifts.emplace_back(drift.name, std::strtod(drift.max_drift.c_str(), nullptr));
    if (point.error && !std::isfinite(*point.error)) point.error.reset();
    return point;
}

/// A program with its points so far.
struct FamilyRuns {
    std::string peer, program, request;
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

    /// The request for these points alone.
    [[nodiscard]] std::string same_again(std::size_t calls) const
    {
        std::string lines;
        for (const ChartPoint& point : points)
            lines += fmt::format("ladder {0} {1:.17g} 1 {1:.17g} {2}\n", point.method, point.parameter, calls);
        return lines;
    }
};

} // namespace

std::vector<ChartPoint> read_points(const std::string& answer)
{
    std::vector<ChartPoint> points;
    for (std::size_t begin = 0; begin < answer.size();) {
        const std::size_t next = answer.find("\npoint=", begin);
        const std::size_t end = next == std::string::npos ? answer.size() : next + 1;
        points.push_back(point_of(answer.substr(begin, end - begin)));
        begin = end;
    }
    return points;
}

std::vector<ChartPoint> measure_points(const ChartProblem& problem, const ChartReference& reference,
                                       const std::vector<MethodFamily>& families, std::size_t& repeats)
{
    const std::size_t calls = std::max(calls_allowed * reference.calls, least_calls);
    const std::string common =
        request_of(problem) + fmt::format("most {}\nreference{}\n", calls, blank_list(reference.rows));
    std::vector<FamilyRuns> runs;
    for (const MethodFamily& family : families) {
        runs.push_back({family.peer, family.program, common, {}, {}});
        for (const Contestant& method : family.methods)
            runs.back().request += ladder_line(method, first_step_of(problem, reference), calls);
    }
    const auto begin = std::chrono::steady_clock::now();
    repeats = quick_repeats;
    for (std::size_t round = 0; round < repeats; ++round) {
        write_standard_error(fmt::format("measuring, round {} of {}\n", round + 1, repeats));
        for (FamilyRuns& family : runs) {
            family.see(read_points(answers_of({{family.program, family.request}}, 1)[0]));
            if (round == 0) family.request = common + family.same_again(10 * calls);
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
