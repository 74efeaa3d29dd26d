// SPDX-License-Identifier: GPL-2.0-or-later
/// The reference of a chart: two methods in 113 bits, and their distance.
#pragma once

#include "lagen_chart/request.hpp"
#include "machine/compile.hpp"
#include "pipeline.hpp"

#include <array>
#include <string>
#include <vector>

namespace lagen {

// All programs of a chart share a problem: one model from one start, sampled at the same times.

struct ChartProblem {
    KernelModule module;
    std::string header;
    std::string no_series; ///< why there is no Taylor series; empty where there is one
    std::vector<double> parameters, initial, times;
    double start = 0, end = 0;
    std::vector<Event> events; ///< that end the scene
};

/// The start, the times (those of `at`, else 21 even ones) and the header of a scene in a form, with Taylor
/// coefficients where there are any. `checked` is decided anew for the scene's parameters.
[[nodiscard]] ChartProblem chart_problem(CheckedModel& checked, const Scene& scene);

/// `count` even times from the start to the end of the problem.
void sample_evenly(ChartProblem& problem, std::size_t count);

/// The request that every program of the chart is given, but for its ladders.
[[nodiscard]] chart::Request request_of(const ChartProblem& problem);

/// A program of a chart, and what it is asked.
struct ChartCall {
    std::string program, request;
};

/// The outputs of programs that ran to their ends, at most `at_once` at a time. Throws where one did not.
[[nodiscard]] std::vector<std::string> answers_of(const std::vector<ChartCall>& calls, std::size_t at_once);

struct ChartReference {
    double error = 0;                 ///< the largest distance of the two
    std::vector<double> rows;         ///< high and low part of every lane, a sample after the other
    std::size_t steps = 0, calls = 0; ///< of the explicit pair
    std::string shortened;            ///< why the problem was shortened; empty where it was not
    bool ended_by_event = false;      ///< that is why
};

/// Taylor's method where there is one, else a pair of another order; then the pair that suits the equations.
[[nodiscard]] std::array<std::string, 2> reference_methods(const ChartProblem& problem);

/// The programs of the two.
[[nodiscard]] std::vector<ProgramText> reference_programs(const ChartProblem& problem);

/// Where an event ends the scene, or the two differ by more than 1e-14 from some time on, `problem` ends there. Throws
/// MathematicsError where that leaves no sample behind the start.
[[nodiscard]] ChartReference make_reference(ChartProblem& problem, const std::array<std::string, 2>& programs,
                                            const std::string& scene);

} // namespace lagen
