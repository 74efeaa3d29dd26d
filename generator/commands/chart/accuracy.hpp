// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run --accuracy E`: a method and its tolerance or step by a chart of the scene, which is made on first use and
/// kept in the cache, and a second run that confirms them.
#pragma once

#include "commands/chart/chart.hpp"
#include "commands/line/options.hpp"
#include "scene/run_record.hpp"
#include "scene/table.hpp"

namespace lagen {

// The points of a chart in the cache, for `lagen run --accuracy`.

struct KeptChart {
    std::vector<ChartPoint> points;
    std::string obstacle; ///< why the reference ends before the scene does; empty where it does not

    static void each(auto& self, auto& archive) { archive(self.points, self.obstacle); }
};

/// The file of the chart of a scene, named by what a chart rests on; empty where there is no place for a cache.
[[nodiscard]] std::string chart_file(const Options& options, const Model& model);

[[nodiscard]] KeptChart kept_chart(const Chart& chart);

/// Nothing where there is none in this file.
[[nodiscard]] std::optional<KeptChart> find_chart(const std::string& file);

/// A failure to write is no failure of the run.
void keep_chart(const std::string& file, const KeptChart& chart);

struct AccurateMethod {
    const MethodEntry* method = nullptr;
    double parameter = 0; ///< tolerance or step
    double accuracy = 0;  ///< asked for
    double error = 0;     ///< of the chart
};

/// The cheapest method that the chart of the scene shows within --accuracy; nothing without that option. Throws
/// UsageError beside --method, --step or --tolerance, MathematicsError where no method or no reference comes so far.
[[nodiscard]] std::optional<AccurateMethod> accurate_method(const Options& options, const CheckedModel& checked,
                                                            const std::string& path);

/// The chart's choice for an accuracy; throws as above.
[[nodiscard]] AccurateMethod choose_method(const KeptChart& chart, double accuracy);

/// Sets the tolerance or step of `input`. It holds where a run with a smaller one (by half the step, or half a power of
/// ten of the tolerance, or more where that changes nothing) moves no row by more than the accuracy; else that smaller
/// one is tried, five times. Standard error is told which. False where none holds.
[[nodiscard]] bool confirm_accuracy(const AccurateMethod& accurate, const RunRecord& record, ProgramInput& input);

/// The largest over the rows of |a - b|_2/|b|_2 (|a|_2 where b = 0), over those that both have; the first column is t.
[[nodiscard]] double table_distance(const Table& a, const Table& b);

} // namespace lagen
