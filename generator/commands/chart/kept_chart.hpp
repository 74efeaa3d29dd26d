// SPDX-License-Identifier: GPL-2.0-or-later
/// The points of a chart in the cache, for `lagen run --accuracy`.
#pragma once

#include "commands/chart/chart.hpp"
#include "commands/line/options.hpp"

namespace lagen {

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

} // namespace lagen
