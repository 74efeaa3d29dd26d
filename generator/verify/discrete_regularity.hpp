// SPDX-License-Identifier: GPL-2.0-or-later
/// The regularity of a discrete Lagrangian: generic rank, kernel and singular points of Newton's matrix of a step,
/// N_ab = <-e_b (F^-L_a), bordered by the inner unknowns of a scheme (mechanics/discrete.hpp). What is said of almost
/// all arrows is shown at W = cay(s^c E_c), of curves exp(xi) at W = exp(xi), and of the inner unknowns for almost all
/// their values.
#pragma once

#include "mechanics/system.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// `absent` where the system has no discrete Lagrangian.
[[nodiscard]] Regularity decide_discrete_regularity(Graph& graph, const System& system, const ProofBudget& budget);

} // namespace lagen
