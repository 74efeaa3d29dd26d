// SPDX-License-Identifier: GPL-2.0-or-later
/// One scene of a model that was read, from its program to its rows: what every command that integrates one scene does.
#pragma once

#include "scene/preparation.hpp"
#include "scene/second_run.hpp"

namespace lagen {

class SceneRun {
  public:
    /// Proves the model, or finds the record of an earlier run, writes the model's warnings to standard error, and has
    /// the program of `scene` and everything that it is told. `stretch` as for sample_times. Throws as Preparation and
    /// evaluate_scene do. Keeps references to the others.
    SceneRun(CheckedModel& checked, Scene scene, const MethodEntry& method, bool stretch);
    SceneRun(const SceneRun&) = delete;
    SceneRun& operator=(const SceneRun&) = delete;

    /// Runs the program, and a second time for what its state is worth (second_run.hpp). An interrupt leaves the rows
    /// so far, with the status "interrupted".
    [[nodiscard]] RunOutcome integrate(SecondRun second);

    [[nodiscard]] const CheckedModel& checked() const { return checked_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::string& form() const { return scene_.form; }
    [[nodiscard]] const MethodEntry& method() const { return method_; }
    [[nodiscard]] const SceneValues& values() const { return values_; }
    [[nodiscard]] const RunRecord& record() const { return preparation_.record(); }
    [[nodiscard]] const ProgramInput& input() const { return input_; }
    /// What the program is told may be changed before it runs.
    [[nodiscard]] ProgramInput& input() { return input_; }

  private:
    /// What of the equations is no finite number where an implicit method ended.
    [[nodiscard]] std::string not_finite(const RunOutcome& outcome);

    CheckedModel& checked_;
    Scene scene_;
    const MethodEntry& method_;
    Preparation preparation_;
    SceneValues values_;
    std::vector<long double> parameters_;
    ProgramInput input_;
    std::optional<StartState> start_;
};

} // namespace lagen
