// SPDX-License-Identifier: GPL-2.0-or-later
/// Routh's reduction as a person writes it.
#pragma once

#include "mechanics/routh.hpp"
#include "model/model.hpp"

namespace lagen {

/// Each in its shortest form; momenta by their names.
struct RouthianText {
    Tree value;                   ///< R(t, x, y), over the momenta of the cyclic coordinates
    std::vector<Tree> velocities; ///< Theta^k
    std::vector<Tree> momenta;    ///< p_k = dL/dy^k over t, x and y
};
[[nodiscard]] RouthianText routhian_text(const Model& model, const System& system, const Graph& graph,
                                         const Routhian& routhian);

} // namespace lagen
