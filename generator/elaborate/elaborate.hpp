// SPDX-License-Identifier: GPL-2.0-or-later
/// Model -> System: rho and C of every kind of algebroid built, everything lowered once.
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"

namespace lagen {

/// Keeps no reference to `model`. Throws ModelError (an unknown algebra, dependent sections, a divisor that is 0, ..).
[[nodiscard]] System elaborate(const Model& model);

// [forms] on the graph of a system.

/// Of a system whose algebroid is there.
[[nodiscard]] std::vector<FormClaim> lower_forms(System& system, Lowering& lower, const std::vector<NamedForm>& forms);

} // namespace lagen
