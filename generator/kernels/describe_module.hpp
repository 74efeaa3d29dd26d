// SPDX-License-Identifier: GPL-2.0-or-later
/// What a module says of itself before it has kernels: names, parameters with their defaults, lanes of the state.
#pragma once

#include "kernels/formulation.hpp"

#include <memory>

namespace lagen {

[[nodiscard]] KernelModule describe_module(std::shared_ptr<Graph> graph, const Model& model, const System& system,
                                           const Formulation& form);

} // namespace lagen
