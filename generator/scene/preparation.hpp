// SPDX-License-Identifier: GPL-2.0-or-later
/// From a model that was read to the program of a scene: by the record of an earlier run where there is one, else by
/// proofs, kernels and the compiler.
#pragma once

#include "machine/compile.hpp"
#include "scene/run_record.hpp"

#include <functional>
#include <optional>
#include <string>

namespace lagen {

/// What the equations have that a method does not take, as a sentence, and what takes it.
struct Obstacle {
    std::string text, hint;
};
/// Nothing where all is well.
[[nodiscard]] std::optional<Obstacle> obstacle_of(const MethodEntry& method, const KernelModule& module);

/// The scene's method. Throws, by where the method stands, where it is unknown, lacks a step, or takes no time scale.
/// Warns on standard error of what it does not use.
[[nodiscard]] const MethodEntry& method_of(const Scene& scene);

/// What a scene of this system has that a composition of its steps does not take; nothing of other methods.
[[nodiscard]] std::optional<Obstacle> obstacle_to_composition(const MethodEntry& method, const CheckedModel& checked,
                                                              const Scene& scene);

/// The program of a scene by one method, not yet compiled.
struct SceneText {
    KernelModule module;
    ProgramText text;
};
/// `checked` is proved and decided for the scene's parameters. Splittings take the time scale of the scene.
[[nodiscard]] SceneText scene_text(const CheckedModel& checked, const Scene& scene, const MethodEntry& method,
                                   const Driver& driver);

class Preparation {
  public:
    /// `checked` was read; it is proved, or has the warnings of a record that serves `scene`, which has its form, and
    /// `method`. Throws where it is refuted. Keeps references to all.
    Preparation(CheckedModel& checked, const Scene& scene, const MethodEntry& method, const Driver& driver);

    /// Throws where the method asks for other equations. `look` sees the record, its program apart, before anything is
    /// compiled: what it throws costs nobody the compiler's seconds.
    void finish(const std::vector<long double>& parameters, const std::function<void(const RunRecord&)>& look);

    /// After `finish`.
    [[nodiscard]] const RunRecord& record() const { return *record_; }

    /// With its system and, if that is wanted, with what is decided for `parameters`.
    const CheckedModel& checked(const std::vector<long double>& parameters, bool decided);

  private:
    CheckedModel& checked_;
    const Scene& scene_;
    const MethodEntry& method_;
    Driver driver_;
    std::string file_;
    std::optional<RunRecord> record_;
    bool elaborated_ = false, decided_ = false; ///< `checked_` has its system, and what is decided of it
};

} // namespace lagen
