// SPDX-License-Identifier: GPL-2.0-or-later
/// Steps of Galerkin's variational integrators on x'' = -omega^2 x. A scheme makes L_d(x_0, x_1) of polynomials of some
/// degree and an interpolating quadrature; what it leaves of the inner unknowns is
///   L_d = (a x_0^2 + 2 b x_0 x_1 + c x_1^2) / 2h,     b x_(k-1) + (a + c) x_k + b x_(k+1) = 0,
/// with a, b, c rational in (h omega)^2: nothing grows where |a + c| <= 2 |b|. Exact, although nodes and weights are
/// irrational: the quadrature of p is the integral of p modulo the polynomial of the nodes.      [Marsden-West 2001]
#pragma once

#include "stability/linear_limits.hpp"

namespace lagen {

/// The limits of the discrete Lagrangian that `scheme` ("gauss:2", "left", as in [discrete]) makes: `imaginary` alone.
/// Nothing where there is no scheme of that name.
[[nodiscard]] std::optional<LinearLimits> scheme_limits(const std::string& scheme);

[[nodiscard]] std::vector<std::string_view> scheme_names();

} // namespace lagen
