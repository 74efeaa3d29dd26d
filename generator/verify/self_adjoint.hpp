// SPDX-License-Identifier: GPL-2.0-or-later
/// Says whether a step of a discrete Lagrangian is undone by the step of -h, which compositions of it rest on:
///   L*(t, g, h) = -L(t + h, g^-1, -h),      F^+-L* = F^+-L,  shown where L - L* is constant on the arrows
/// and the work of forces likewise, f^+(t, g, h) = -f^-(t + h, g^-1, -h), each with its part along a logarithm. What L*
/// and L differ by may depend on h and t alone: f(t(g)) - f(s(g)) leaves the discrete Euler-Lagrange equations as they
/// are, but moves the momenta of steps of different lengths by different amounts.
#pragma once

#include "mechanics/system.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// The first of these statements that is not proved, or `proved`; of a system whose discrete Lagrangian has no inner
/// unknowns but those of a logarithm, and a step that is an input.
[[nodiscard]] Decision decide_self_adjoint(Graph& graph, const System& system, const ProofBudget& budget);

} // namespace lagen
