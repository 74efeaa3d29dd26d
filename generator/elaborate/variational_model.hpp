// SPDX-License-Identifier: GPL-2.0-or-later
/// A model in continuous time as one in steps: with a groupoid that has its algebroid, and the discrete Lagrangian that
/// a scheme makes of L.
#pragma once

#include "model/model.hpp"

namespace lagen {

/// The model with the scheme in [discrete], which the method of this name asks for. A groupoid that it does not have
/// itself is
///   tangent       the pair groupoid
///   lie_algebra   the group of matrices that the basis of the named algebra generates, else the matrices of ad
///   action        that of the matrices A_a of the anchor rho_a = -(A_a x + b_a)^i d/dx^i, with those of the algebra
///                 beside them where the A_a are not independent; x.W = W^-1 x
///   atiyah        M x M x H, H as for lie_algebra
/// Throws MathematicsError where the model has no L, and where its algebroid has no such groupoid.
[[nodiscard]] Model variational_model(Model model, const std::string& scheme, const std::string& method);

} // namespace lagen
