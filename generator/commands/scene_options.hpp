// SPDX-License-Identifier: GPL-2.0-or-later
/// What the command line of `run` says about the scene and the method.
#pragma once

#include "commands/methods.hpp"
#include "commands/options.hpp"

namespace lagen {

/// Relative and absolute tolerance, and the method, where neither the scene nor the command line gives one.
inline constexpr long double standard_tolerance = 1e-10L;
inline constexpr const char* standard_method = "dop853";

/// The scene as --scene, --method, --step, --tolerance, --t-end, --at and --set change it. With --at and without
/// --t-end the run is as long as its rows ask for.
[[nodiscard]] Scene scene_of(const Options& options, const Model& model);

/// The scene's method; UsageError or ModelError (by where the name stands) where it is unknown or lacks a step.
[[nodiscard]] const MethodEntry& method_of(const Options& options, const Scene& scene);

} // namespace lagen
