// SPDX-License-Identifier: GPL-2.0-or-later
/// Says whether the Legendre transform y -> dL/dy is one-to-one at fixed t, x and parameters. It is where
/// - L is quadratic in y with a regular W (L may be any function of x), or
/// - L is smooth on a convex set of fibre coordinates and W = d2L/dy2 is definite there: on the segment between two
///   points (y_2 - y_1) . (dL/dy(y_2) - dL/dy(y_1)) = int (y_2 - y_1) . W (y_2 - y_1) > 0.
/// Definiteness alone is not enough: v^2 + 1/v^2 has W > 0 wherever it is defined, and each momentum twice.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Sets `legendre_obstacle` and `newton_start`; for all parameters, else for `values` of as few of them as are needed,
/// which `legendre_values` tells; of H over mu where `regularity` is of H. That a quadratic L is regular is for the
/// rest of `regularity` to say.
void decide_legendre_transform(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                               const ProofBudget& budget, const std::vector<std::pair<NodeId, NodeId>>& values,
                               Regularity& regularity);

/// Where F is smooth with d2F/dy2 > 0 on the convex set of y where alone it is defined (and so has no minimum but where
/// dF/dy = 0): a y of that set, for Newton's method to start from, empty for 0. Nothing where that is not shown.
[[nodiscard]] std::optional<std::vector<Rational>> strictly_convex_start(Graph& graph, const FibreHessian& hessian,
                                                                         const ProofSetting& setting,
                                                                         const ProofBudget& budget);

/// Throws MathematicsError where the velocities of an L are not shown to be functions of the momenta.
void require_legendre_transform(const std::string& model, const Regularity& regularity);

} // namespace lagen
