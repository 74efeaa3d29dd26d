// SPDX-License-Identifier: GPL-2.0-or-later
/// The group that moves a state, where the brackets of the sections are constant: with u in the Lie algebra
///   x^i            rho^i_a(x) u^a                       where that is linear in lanes that are moved
///   R              R u                                  of [reconstruct]
///   mu_a           -(rho_a(x) . v + mu_c C^c_ab u^b)    of Hamilton's form without forces, where all x are moved; then
///                                                       (u, v) lies in the semidirect sum of the algebra and covectors
/// are linear in these lanes, and the motion is that with u = y, v = dH/dx. The bracket is
///   [(u, v), (u', v')] = (C(u, u'), L_u v' - L_u' v),   (L_u v)_k = u^a v_i drho^i_a/dx^k.
#pragma once

#include "kernels/formulation.hpp"
#include "model/model.hpp"

namespace lagen {

struct AlgebraAction {
    GroupMotion motion;
    std::vector<Kernel> at_states, constants; ///< of states, and free of them
};

[[nodiscard]] AlgebraAction algebra_action(Graph& graph, const Model& model, const System& system,
                                           const Formulation& form);

} // namespace lagen
