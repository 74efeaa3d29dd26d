// SPDX-License-Identifier: GPL-2.0-or-later
/// Model files in the notation of a kind of algebroid: lagen builds rho and C itself.
#pragma once

#include "frames.hpp"
#include "lie_algebras.hpp"

namespace lagen::laws {

/// kind = "frame" over `inner`, which is of kind general; the sections are f1, f2, ..
[[nodiscard]] std::string frame_text(const LocalAlgebroid& inner, const Frame& frame);

/// kind = "atiyah" with the bracket of `structure`; connection[i * s + c] = A_i^c. Sections as in `atiyah`.
[[nodiscard]] std::string atiyah_text(const LocalAlgebroid& structure, const std::vector<std::string>& base,
                                      const std::vector<Formula>& connection);

/// kind = "prolongation" of `inner`, of kind general.
[[nodiscard]] std::string prolongation_text(const LocalAlgebroid& inner, bool dual);

/// kind = "subbundle": rho alone.
[[nodiscard]] std::string subbundle_text(const LocalAlgebroid& algebroid);

/// kind = "lie_algebra".
[[nodiscard]] std::string lie_algebra_text(const LocalAlgebroid& algebra);

/// kind = "action" by `representation`, with the bracket of `algebroid`.
[[nodiscard]] std::string representation_text(const MatrixAlgebra& algebra, const LocalAlgebroid& algebroid);

} // namespace lagen::laws
