// SPDX-License-Identifier: GPL-2.0-or-later
/// Which trajectories a sweep consists of: a grid, random draws, or the rows of a file.
#pragma once

#include "commands/line/scene_options.hpp"

#include <cstdint>
#include <functional>

namespace lagen {

struct SweepRows {
    std::vector<SweptName> names;
    std::uint64_t count = 0;
    std::string text; ///< all that the rows follow from
    /// Of each name, in row `index`; rows are asked for in ascending order.
    std::function<std::vector<double>(std::uint64_t index)> values;
};

/// --set and --initial of a sweep: those that keep one value, and ranges FIRST:LAST:COUNT or FIRST:LAST.
struct SweepRequest {
    struct Range : RangeText {
        std::string name;
    };
    std::vector<Setting> settings, initial;
    std::vector<Range> ranges; ///< in the order of the command line

    /// Throws UsageError: ranges that do not suit --random or --ensemble, nothing that is swept.
    explicit SweepRequest(const Options& options);
};

/// The rows that are asked for. Throws UsageError and ModelError: a range of something that is neither parameter nor
/// initial value of the scene, of no points, with ends that are no numbers; a file that is not what --ensemble asks
/// for.
[[nodiscard]] SweepRows sweep_rows(const Options& options, const SweepRequest& request, const Model& model,
                                   const Scene& scene);

/// The rows of a CSV file: a heading with names of parameters and initial values (`a` or `set.a`, `x` or `initial.x`),
/// then numbers. It is read twice: here, where every row is looked at, and while the sweep goes on.
[[nodiscard]] SweepRows ensemble_rows(const std::string& path, const Model& model, const Scene& scene);

/// Throws UsageError where the value of a bound parameter follows from one that is swept.
void require_constants(const Model& model, const SweepRows& rows);

} // namespace lagen
