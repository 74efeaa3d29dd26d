// SPDX-License-Identifier: GPL-2.0-or-later
/// Every expression of a model has a value somewhere, as far as its constants tell.
#pragma once

#include "model/model.hpp"

namespace lagen {

/// Throws ModelError where a constant part of an expression of the model has no real value, as log(0):
/// in rho, C, constraints, domain, Casimirs, L, H, forces, R, sigma, cost, bounds, guesses, forms, observables,
/// invariants, parameters and scenes (see proof/constant_values.hpp).
void require_values(const Model& model);

/// Likewise of claims from the command line.
void require_values(const std::vector<NamedTree>& claims);

} // namespace lagen
