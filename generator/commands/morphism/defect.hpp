// SPDX-License-Identifier: GPL-2.0-or-later
/// How far the run of the target is from the projection of the run of the source, row by row.
#pragma once

#include "commands/morphism/projection.hpp"
#include "commands/scene/table.hpp"
#include "text/record.hpp"

namespace lagen {

/// Largest |difference| of one column.
struct ColumnDefect {
    std::string name;
    bool lifted = false;  ///< of the reconstruction, else of the projection
    double max = 0;       ///< infinite where a value is no finite number
    double time = 0;      ///< of the largest
    double size = 0;      ///< largest value of the column
    double moved_at = -1; ///< when it first was more than 1e-3 of `size`, and whether it was
    bool moved = false;
};

struct RunComparison {
    Table table; ///< t, the columns of the projection ("source_NAME" of what is lifted), then their images:
                 ///< "projected_NAME", "pulled_NAME", "lifted_NAME"
    std::vector<ColumnDefect> defects; ///< one a column
};

/// Of the rows that both have. Both tables have t and all states, by their names.
[[nodiscard]] RunComparison compare(const Projection& projection, const Table& source, const Table& target);

/// {"max": .., "t": .., "columns": {NAME: ..}} of the projection, or of what is lifted.
[[nodiscard]] Record defect_record(const RunComparison& comparison, bool lifted);
/// A line for standard error, and a warning where a column is off by more than 1e-3 of its size; of both.
[[nodiscard]] std::string defect_text(const RunComparison& comparison);

} // namespace lagen
