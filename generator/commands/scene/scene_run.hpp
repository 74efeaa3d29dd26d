// SPDX-License-Identifier: GPL-2.0-or-later
/// One scene of a model that was read, from its program to its rows: what every command that integrates one scene does.
#pragma once

#include "commands/scene/preparation.hpp"
#include "commands/scene/run_report.hpp"

namespace lagen {

class SceneRun {
  public:
    /// Proves the model, or finds the record of an earlier run, and writes the model's warnings to standard error.
    /// `method` and `kept_as` as for Preparation, whose errors it throws. Keeps references.
    SceneRun(const Options& options, CheckedModel& checked, const std::string& method,
             const std::vector<std::string>& kept_as = {});
    SceneRun(const SceneRun&) = delete;
    SceneRun& operator=(const SceneRun&) = delete;

    /// Has the program of `scene`, which has its form, and everything that the program is told. `stretch` as for
    /// sample_times.
    void prepare(Scene scene, const MethodEntry& method, bool stretch);

    /// After `prepare`: runs the program, and a second time for what its state is worth (second_run.hpp). Of a discrete
    /// motion that failed the largest step that goes on is sought, unless parameters are bound. An interrupt leaves the
    /// rows so far, with the status "interrupted".
    [[nodiscard]] RunOutcome integrate();

    [[nodiscard]] const CheckedModel& checked() const { return checked_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::string& form() const { return form_; }
    [[nodiscard]] const MethodEntry& method() const { return *method_; }
    [[nodiscard]] const SceneValues& values() const { return values_; }
    [[nodiscard]] const RunRecord& record() const { return preparation_.record(); }
    [[nodiscard]] const ProgramInput& input() const { return input_; }
    /// What the program is told may be changed before it runs.
    [[nodiscard]] ProgramInput& input() { return input_; }

  private:
    /// What of the equations is no finite number where an implicit method ended.
    [[nodiscard]] std::string not_finite(const RunOutcome& outcome);

    const Options& options_;
    CheckedModel& checked_;
    Preparation preparation_;
    Scene scene_;
    std::string form_;
    const MethodEntry* method_ = nullptr;
    SceneValues values_;
    std::vector<long double> parameters_;
    ProgramInput input_;
    std::optional<StartState> start_;
};

} // namespace lagen
