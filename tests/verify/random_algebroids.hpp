// SPDX-License-Identifier: GPL-2.0-or-later
/// Random Lie algebroids, valid by construction, and the structure equations at exact points: the oracle for `verify`.
/// Start: T R^3, linear actions of matrix algebras on R^2 or R^3, matrix algebras over a point, bundles with a kernel.
/// Then a change of frame e'_a = A_a^b e_b with A = (unipotent polynomial) or (rational diagonal) or (rotation by z).
#pragma once

#include "support/dice.hpp"
#include "verify/rational_functions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lagen::oracle {

using testing::Dice;

struct RandomAlgebroid {
    std::size_t n = 0, r = 0;
    std::vector<Quotient> rho; ///< rho[i * r + a]
    std::vector<Quotient> C;   ///< C[(c * r + a) * r + b]
    bool on_sphere = false;    ///< x^2 + y^2 + z^2 = 1

    [[nodiscard]] Quotient& anchor(std::size_t i, std::size_t a) { return rho[i * r + a]; }
    [[nodiscard]] const Quotient& anchor(std::size_t i, std::size_t a) const { return rho[i * r + a]; }
    [[nodiscard]] Quotient& bracket(std::size_t c_, std::size_t a, std::size_t b) { return C[(c_ * r + a) * r + b]; }
    [[nodiscard]] const Quotient& bracket(std::size_t c_, std::size_t a, std::size_t b) const
    {
        return C[(c_ * r + a) * r + b];
    }
};

/// A valid algebroid; `number` chooses its family, the dice the rest.
[[nodiscard]] RandomAlgebroid random_algebroid(std::size_t number, Dice& dice);

/// The model file: pairs a < b alone are listed, zero entries left out.
[[nodiscard]] std::string model_text(const RandomAlgebroid& algebroid);

/// True where both structure equations hold exactly at three random points.
[[nodiscard]] bool holds_at_points(const RandomAlgebroid& algebroid, Dice& dice);

/// One entry of rho or C (with its antisymmetric partner) changed: a sign, a relative 1e-13, an added 1e-15, a factor
/// k, an added multiple of x^2 + y^2 + z^2 - 2 (of k where n < 3).
[[nodiscard]] RandomAlgebroid mutated(const RandomAlgebroid& algebroid, Dice& dice);

} // namespace lagen::oracle
