// SPDX-License-Identifier: GPL-2.0-or-later
/// What the command line of `run` and `sweep` says about the scene and the method.
#pragma once

#include "commands/line/options.hpp"
#include "commands/scene/methods.hpp"

namespace lagen {

/// Relative and absolute tolerance, and the method, where neither the scene nor the command line gives one.
inline constexpr long double standard_tolerance = 1e-10L;
inline constexpr const char* standard_method = "dop853";

/// The scene `name`, without it that of --scene, as --method, --step, --time-scale, --tolerance, --t-end, --at and
/// --set change it, and with `initial` values and curves of the command line; without --plot it has no picture. With
/// --at and without --t-end the run is as long as its rows ask for; with
/// --accuracy it has no time scale.
[[nodiscard]] Scene scene_of(const Options& options, const Model& model, const std::vector<Setting>& initial,
                             const std::optional<std::string>& name = {});

/// True where `initial` of the scene has momenta; else it has fibre coordinates, if any.
[[nodiscard]] bool starts_from_momenta(const Model& model, const Scene& scene);

/// The names that `initial` of the scene gives numbers to, or may give.
[[nodiscard]] std::vector<Symbol> initial_symbols(const Model& model, const Scene& scene);

/// Gives the start of `scene` another value; ModelError where it has none of that name.
void set_initial(const Model& model, Scene& scene, const Setting& setting);

/// The expression of --time-scale, closed over the model's names; null where it is not given.
[[nodiscard]] Tree time_scale_of(const Options& options, const Model& model);

/// Throws where the form of the scene is a motion from step to step: `what` is made of curves.
void require_curve(const Scene& scene, const char* what);
/// The same where an event of the scene jumps.
void require_no_jumps(const Scene& scene, const char* what);
/// The scene's method; UsageError or ModelError (by where the name stands) where it is unknown, lacks a step, or
/// takes no time scale. Warns on standard error of what it does not use.
[[nodiscard]] const MethodEntry& method_of(const Options& options, const Scene& scene);

} // namespace lagen
