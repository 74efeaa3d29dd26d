// SPDX-License-Identifier: GPL-2.0-or-later
/// The picture of a scene: its [scene.NAME.plot], or else its columns over time.
#pragma once

#include "commands/scene/run_record.hpp"

namespace lagen {

/// The run that is drawn.
struct PlottedRun {
    const Model& model;
    const Scene& scene; ///< with its form and its plot
    const RunRecord& record;
    const ProgramInput& input; ///< of the table
    std::size_t rows;          ///< that the table has
};

/// Draws `path`: what the plot of the first of `runs` says, and in the same panels the curves of the others, which have
/// its form and its columns. Returns how much that is, "2 panels, 3 curves". The programs run once more, at times of
/// the picture's own: 20001 even ones, of a discrete motion at most 10000 of its steps, and the rows of the table where
/// the plot asks for points. Curves keep the points that can be seen; columns over time have a panel a unit. Throws as
/// integrate_scene, and MachineError where gnuplot is missing or fails, or there are no rows.
std::string draw_scene(const std::vector<PlottedRun>& runs, const std::string& path);

/// Throws UsageError where rows are to be written to a file that is called a picture.
void require_no_picture(const std::string& path);

/// Throws UsageError unless the extension is one that draw_scene knows: said before a long run, not after it.
void require_plot_format(const std::string& path);

} // namespace lagen
