// SPDX-License-Identifier: GPL-2.0-or-later
/// What nonholonomic systems have beside other mechanical ones (mechanics/nonholonomic.hpp).
#pragma once

#include "kernels/formulation.hpp"

namespace lagen {

/// Kernels and names of a form that has its derivative: ambient_velocity, reaction (reaction.Y), and where there is a
/// drift moving_energy and the power of the energy. `nodes`: at the lanes of the form.
void add_constrained(Graph& graph, const System& system, const ConstrainedNodes& nodes, Formulation& form);

/// Where the sections follow from constraints, what these were solved by is a divisor too.
void add_minor(const Graph& graph, const System& system, Formulation& form);

} // namespace lagen
