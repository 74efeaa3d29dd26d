// SPDX-License-Identifier: GPL-2.0-or-later
/// Random morphisms of algebroids, true by construction: changes of frame, quotients by ideals, projections of
/// products. Everything in them is a rational function, so that their truth is a matter of exact numbers.
#pragma once

#include "frames.hpp"
#include "oracle.hpp"

namespace lagen::laws {

/// x' = base(x), y'^a = Phi^a_b(x) y^b.
struct RandomMorphism {
    std::string sort; ///< "frame", "ideal" or "projection"
    LocalAlgebroid source, target;
    std::string source_text; ///< of its own kind; empty: of kind general
    std::vector<Formula> base;
    std::vector<Formula> Phi; ///< shape (r', r), by rows

    [[nodiscard]] Formula& entry(std::size_t a, std::size_t b) { return Phi[a * source.r() + b]; }
    [[nodiscard]] const Formula& entry(std::size_t a, std::size_t b) const { return Phi[a * source.r() + b]; }
};

/// Sort `number` modulo 3.
[[nodiscard]] RandomMorphism random_morphism(std::size_t number, Dice& dice);

/// Changes one entry of Phi or of the base map; its name. What came of it is for the truth to say.
[[nodiscard]] std::string mutate(RandomMorphism& morphism, Dice& dice);

/// admissible (b, i) and morphism (b, c, a) from their definition, as formulas over the source.
[[nodiscard]] std::vector<Formula> morphism_residuals(const RandomMorphism& morphism);

/// By exact rational values at `points` random points: violated where one residual is not 0, holds where all are 0 at
/// every point.
[[nodiscard]] Truth truth_of(const RandomMorphism& morphism, Dice& dice, std::size_t points);

} // namespace lagen::laws
