// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations that hold by construction.
#pragma once

#include "geometry/construction.hpp"

namespace lagen {

/// True where every statement of the construction is shown: the algebroids that it rests on by the zero decision,
/// equation by equation; the written entries are those of the construction; the determinants are not zero at a point.
/// From one point to a dense set: all functions are compositions of +, -, *, /, integer powers and entire functions, so
/// that each of them lives on the complement of complex hypersurfaces, which is connected; or, on a convex domain, of
/// others too that are analytic on all of it (are_analytic). False says nothing.
[[nodiscard]] bool holds_by_construction(const Construction& construction);

} // namespace lagen
