// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete motions in a stability chart: the one of [discrete], and those that variational methods make of
/// [lagrangian]. Each has equations of its own, and so a program (runtime/program/lagen_chart/discrete_stability.hpp).
#pragma once

#include "commands/chart/problem.hpp"
#include "commands/chart/stability_chart.hpp"
#include "commands/machine/compile.hpp"
#include "commands/scene/methods.hpp"

#include <optional>

namespace lagen {

struct DiscreteContestant {
    const MethodEntry* method = nullptr;
    std::string scheme; ///< that made the discrete Lagrangian; empty: it is written out
    KernelModule module;
    ProgramText text;
    chart::StabilityRequest request; ///< without the figures of the columns
    std::string followed;            ///< as in StabilityChart
};

/// The scene in its discrete form by `method`, for every step and column of `chart`, which has its axes, start and end.
/// `checked` has [discrete] and is proved. `followed`: what the other methods follow; nothing where there are none.
/// Throws MathematicsError where the scene goes backwards, or the discrete form has nothing of that name to follow.
[[nodiscard]] DiscreteContestant discrete_contestant(CheckedModel& checked, const MethodEntry& method,
                                                     const Scene& scene, const StabilityChart& chart,
                                                     const std::optional<std::string>& followed);

/// The same of `checked`, in continuous time, by a variational method; `checked` stays as it is.
[[nodiscard]] DiscreteContestant variational_contestant(const CheckedModel& checked, const MethodEntry& method,
                                                        const Scene& scene, const StabilityChart& chart);

/// Where the scene begins, and ends by its duration, else by its steps. Throws ModelError where it starts from an
/// arrow, which belongs to its step.
[[nodiscard]] std::pair<double, double> span_of_steps(const Model& model, const Scene& scene);

} // namespace lagen
