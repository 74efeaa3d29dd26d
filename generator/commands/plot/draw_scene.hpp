// SPDX-License-Identifier: GPL-2.0-or-later
/// The picture of a scene: its [scene.NAME.plot], or else its columns over time.
#pragma once

#include "commands/line/options.hpp"
#include "scene/scene_run.hpp"

#include <string>
#include <vector>

namespace lagen {

/// Draws --plot: what the plot of the scene says, and in the same panels the curves of the scenes `beside`, which have
/// its form and its columns, and are run for it; and answers how much that is, "2 panels, 3 curves". The programs run
/// once more, at times of the picture's own: 20001 even ones, of a discrete motion at most 10000 of its steps, and the
/// rows of the table where the plot asks for points. Columns over time have a panel a unit. `whole` becomes false where
/// a run beside did not come to its end. Throws as SceneRun does, and MachineError where gnuplot is missing or fails,
/// or there are no rows.
std::string draw_scene(const Options& options, const SceneRun& run, const RunOutcome& outcome,
                       const std::vector<std::string>& beside, bool& whole);

/// The scenes that --scene names before the last one. UsageError beside options that are of one run, without --plot,
/// where one is named twice, and where one has another form than `last`; ModelError where there is no scene of that
/// name. All of it before a long run.
[[nodiscard]] std::vector<std::string> scenes_beside(const Options& options, const Model& model, const Scene& last);

/// Throws UsageError where rows are to be written to a file that is called a picture.
void require_no_picture(const std::string& path);
/// Throws UsageError unless the extension is one that draw_scene knows: said before a long run, not after it.
void require_plot_format(const std::string& path);

} // namespace lagen
