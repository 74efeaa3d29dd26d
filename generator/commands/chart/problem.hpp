// SPDX-License-Identifier: GPL-2.0-or-later
/// All programs of a chart share a problem: one model from one start, sampled at the same times.
#pragma once

#include "lagen_chart/request.hpp"
#include "pipeline.hpp"

#include <string>
#include <vector>

namespace lagen {

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
[[nodiscard]] ChartProblem chart_problem(CheckedModel& checked, const Scene& scene, const std::string& form);

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

} // namespace lagen
