// SPDX-License-Identifier: GPL-2.0-or-later
/// Random changes of frame and of coordinates whose inverses are known.
#pragma once

#include "local_algebroid.hpp"

namespace lagen::laws {

enum class FunctionClass { constant, polynomial, rational, trigonometric, exponential, positive_roots };

/// A short random function of the base coordinates (and now and then of the parameters). positive_roots: sqrt and log
/// of coordinates that the domain must make positive.
[[nodiscard]] Formula random_function(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice);

/// One elementary change: shear e_a + f e_b, stretch u e_a with u nowhere zero, rotation or hyperbolic rotation by f.
[[nodiscard]] Frame random_frame(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice);

/// A constant basis of small integers, or two elementary changes; r = 0 is left alone.
[[nodiscard]] LocalAlgebroid in_random_frame(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice);

/// A frame of two or three sections whose matrix is full, the inverse by cofactors over its determinant.
[[nodiscard]] LocalAlgebroid in_full_frame(const LocalAlgebroid& algebroid, Dice& dice);

/// One coordinate becomes c x^i + f(others) or x^i exp(f(others)).
[[nodiscard]] LocalAlgebroid in_random_coordinates(const LocalAlgebroid& algebroid, Dice& dice);

} // namespace lagen::laws
