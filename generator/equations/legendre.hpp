// SPDX-License-Identifier: GPL-2.0-or-later
/// The Legendre transform of a Lagrangian whose momenta are affine in the velocities.
#pragma once

#include "equations/symbolic_model.hpp"

namespace lagen {

struct LegendreTransform {
    GiNaC::ex hamiltonian; ///< H(t, x, mu) = mu_a y^a - L
    Sum velocities;        ///< y^a(t, x, mu) = dH/dmu_a, shape (r)
    bool coupled;          ///< W couples velocities by entries that depend on x: rho_a(H) has long derivatives
};

/// p_a = W_ab y^b + b_a with W free of y, solved for y block by block; nothing where p is not plainly of that form or a
/// block of W is too large to be read.
[[nodiscard]] std::optional<LegendreTransform> legendre_transform(SymbolicModel& symbolic, const GiNaC::ex& lagrangian);

} // namespace lagen
