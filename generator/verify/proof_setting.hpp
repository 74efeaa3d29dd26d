// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the claims about a system are decided: its variables, parameters, constraints and domain, and what must be
/// defined at a point for the point to count.
#pragma once

#include "mechanics/system.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// `graph`: a copy of the system's, in which what a nonholonomic system is made of is put on the constraint.
[[nodiscard]] ProofSetting proof_setting(Graph& graph, const System& system);

} // namespace lagen
