// SPDX-License-Identifier: GPL-2.0-or-later
/// A picture of a run, drawn by gnuplot.
#pragma once

#include "commands/table.hpp"

namespace lagen {

/// Columns that share a panel.
struct Panel {
    std::string label;
    std::vector<std::size_t> columns; ///< indices into Table::columns
};

/// Draws every panel against the first column into `path` (.svg, .png or .pdf by its extension). Throws UsageError for
/// another extension, MachineError where gnuplot is missing or fails.
void plot_table(const Table& table, const std::vector<Panel>& panels, const std::string& title,
                const std::string& path);

/// Throws UsageError unless the extension is one that plot_table knows: said before a long run, not after it.
void require_plot_format(const std::string& path);

} // namespace lagen
