// SPDX-License-Identifier: GPL-2.0-or-later
/// A picture of a run, drawn by gnuplot.
#pragma once

#include "commands/scene/table.hpp"

namespace lagen {

/// Columns that share a panel.
struct Panel {
    std::string label;
    std::vector<std::size_t> columns; ///< indices into Table::columns
    std::vector<std::string> units{}; ///< one a column, "" or "1" where there is none to show; may be left out
};

/// Draws every panel against the first column into `path` (.svg, .png or .pdf by its extension). Units stand at the
/// axis where a panel has one for all, else in its legend. Throws UsageError for another extension, MachineError where
/// gnuplot is missing or fails.
void plot_table(const Table& table, const std::vector<Panel>& panels, const std::string& title, const std::string& path,
                const std::string& time_unit = "");

/// Throws UsageError where rows are to be written to a file that is called a picture.
void require_no_picture(const std::string& path);

/// Throws UsageError unless the extension is one that plot_table knows: said before a long run, not after it.
void require_plot_format(const std::string& path);

} // namespace lagen
