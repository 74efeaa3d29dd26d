// SPDX-License-Identifier: GPL-2.0-or-later
/// A proof budget for many small questions: what needs more stays undecided.
#pragma once

#include "proof/decide.hpp"

namespace lagen::fuzz {

constexpr ProofBudget small_budget{
    .terms = 100, .products = 3'000, .points = 2, .tries = 10, .searches = 0, .precision = 128, .seed = 0};

} // namespace lagen::fuzz
