// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method in balls for as many equations F(z) = 0 as unknowns, with its certificate: where
///   u - (dF/dz)(box)^-1 F(u)
/// lies inside the box around u, the box holds one root, and that lies in there. [Moore 1966]
#pragma once

#include "proof/ball_matrix.hpp"

#include <functional>

namespace lagen::proof {

/// F, m x 1, and dF/dz, m x m, for all z in some balls.
struct NewtonEquations {
    BallMatrix value, slope;
};

struct RefinedRoot {
    std::vector<Ball> z;    ///< `start` where Newton's method does not converge to a root near it
    bool certified = false; ///< a root lies in these balls
};

/// Newton steps from `start` at `bits`, then one of intervals in boxes that grow from 2^-160 to 2^-40. The first
/// `watched` unknowns may not move by more than 1e-3 of themselves: that is another root.
[[nodiscard]] RefinedRoot refined_root(const std::function<NewtonEquations(const std::vector<Ball>&)>& equations,
                                       const std::vector<Ball>& start, std::size_t watched, slong bits);

/// The same ball with a radius of 2^-`exponent`.
[[nodiscard]] Ball widened(const Ball& ball, long exponent);
/// The radius, rounded up.
[[nodiscard]] double radius_of(const Ball& ball);

} // namespace lagen::proof
