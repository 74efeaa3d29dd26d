// SPDX-License-Identifier: GPL-2.0-or-later
/// A work-precision chart: how far every applicable method is from a reference, and what that costs.
#pragma once

#include "commands/chart/reference.hpp"
#include "commands/line/options.hpp"
#include "machine/compile.hpp"
#include "pipeline.hpp"
#include "scene/methods.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// A run of a method with one tolerance or step.
struct ChartPoint {
    std::string peer; ///< the library, of a method that is not lagen's
    std::string method;
    double parameter = 0; ///< the tolerance, relative and absolute, or the step
    std::string status;   ///< "ok", "too_many_steps", .. (runtime's names)
    /// The largest over the samples of |s - r|_2/|r|_2 over the whole state, with the reference r (|s|_2 where r = 0);
    /// nothing where the run failed.
    std::optional<double> error;
    std::vector<std::pair<std::string, double>> drifts; ///< largest |f(t) - f(t_0)| over the steps, by name
    double seconds = 0;                                 ///< the least of the repeats
    double spread = 1;                                  ///< the largest repeat over the least
    std::size_t steps = 0, rejected = 0, rhs_calls = 0;

    static void each(auto& self, auto& archive) // lagen_run/archive.hpp
    {
        archive(self.method, self.parameter, self.status, self.error, self.seconds, self.steps, self.rejected,
                self.rhs_calls);
    }
};

struct LeftOutMethod {
    std::string method, reason;
};

struct Chart {
    std::string model, title, scene, form;
    double start = 0, end = 0;
    std::vector<double> times;   ///< of the samples
    std::string shortened;       ///< why it ends before the scene does; empty where it does not
    bool ended_by_event = false; ///< that is why
    bool energy_changes = false; ///< forces, explicit time, a drift of constraints or jumps
    std::vector<std::string> reference_methods;
    double reference_error = 0; ///< the largest distance of the two references, in the norm of the points
    std::string machine, compiler;
    std::size_t repeats = 0;
    std::vector<ChartPoint> points;
    std::vector<LeftOutMethod> left_out;
};

/// What a chart is made of besides the model.
struct ChartRequest {
    Scene scene;                                  ///< with its form
    std::vector<const MethodEntry*> methods = {}; ///< empty: all that apply
    bool peers = false;                           ///< other libraries too, where they are installed
};

/// The model, proved, with all of its parameters as constants that have the values of the scene. Throws as `load` does.
[[nodiscard]] CheckedModel charted_model(const Options& options, const std::string& path);

/// Generates, compiles, makes the reference and runs every method over its ladder, with a line of progress on standard
/// error a stage. `checked` is proved. Throws UsageError where a method of the request does not apply, MathematicsError
/// where no reference can be made.
[[nodiscard]] Chart make_chart(CheckedModel& checked, const ChartRequest& request);

/// The cheapest point with an error of at most `error`; nullptr where there is none.
[[nodiscard]] const ChartPoint* cheapest_within(const std::vector<ChartPoint>& points, double error);

/// The errors for which the best point is told.
inline constexpr double charted_errors[] = {1e-3, 1e-6, 1e-9, 1e-12};

/// The call of a function of a chart's program that runs these methods: their types, then their names.
[[nodiscard]] std::string call_of(const char* function, const KernelModule& module,
                                  const std::vector<const MethodEntry*>& methods);

/// Why the method does not apply, in terms of the model; empty where it does.
[[nodiscard]] std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem);

} // namespace lagen
