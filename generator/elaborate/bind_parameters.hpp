// SPDX-License-Identifier: GPL-2.0-or-later
/// Parameters and their values: `--bind` makes constants of the equations of some.
#pragma once

#include "graph/core/lower.hpp"
#include "model/model.hpp"

namespace lagen {

/// The value of each parameter by its name, a constant expression.
[[nodiscard]] Binding parameter_values(Graph& graph, const Model& model);

/// Whatever names a bound parameter in `graph` from now on is its value.
void bind_parameters(Graph& graph, const Model& model);

/// What `[base] domain` says of bound parameters alone is taken out where it holds; ModelError where it does not.
void settle_domain(Model& model);

/// The same with the values of `scene`, which the parameters take.
void bind_in_scene(Model& model, const Scene& scene);
/// The same with all parameters bound.
void bind_all_in_scene(Model& model, const Scene& scene);

} // namespace lagen
