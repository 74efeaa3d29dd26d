// SPDX-License-Identifier: GPL-2.0-or-later
/// The form of an expression that a person would write down: the shortest of several exact rewritings.
#pragma once

#include "symbolic/ginac_door.hpp"

namespace lagen {

/// The shortest text (a pair of parentheses counts as a few characters more) among: expanded; expanded with the coefficients
/// of each monomial in the variables factored; factored as a whole; as derived. Rewritings that would cost too much are left out,
/// by bounds that depend on the expression alone, so that the choice is the same on every run.
[[nodiscard]] Tree shortest_form(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order);

} // namespace lagen
