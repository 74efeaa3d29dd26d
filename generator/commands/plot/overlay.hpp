// SPDX-License-Identifier: GPL-2.0-or-later
/// Other scenes of a run's model in the panels of its picture.
#pragma once

#include "commands/plot/draw_scene.hpp"
#include "commands/scene/scene_run.hpp"

#include <string>
#include <vector>

namespace lagen {

class OverlaidRun {
  public:
    /// Runs scene `name`, changed by the command line as the last one was. It has the columns and the picture of
    /// `last`. Throws as SceneRun does.
    OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& last, const std::string& name);

    [[nodiscard]] const RunOutcome& outcome() const { return outcome_; }
    [[nodiscard]] PlottedRun plotted() const
    {
        return {checked_.model, run_.scene(), run_.record(), run_.input(), outcome_.table.count()};
    }

  private:
    OverlaidRun(const Options& options, const CheckedModel& checked, const Scene& scene);

    CheckedModel checked_;
    SceneRun run_;
    RunOutcome outcome_;
};

/// The scenes that --scene names before the last one. UsageError beside options that are of one run, without --plot,
/// where one is named twice, and where one has another form than `last`; ModelError where there is no scene of that
/// name. All of it before a long run.
[[nodiscard]] std::vector<std::string> overlaid_scenes(const Options& options, const Model& model, const Scene& last);

} // namespace lagen
