// SPDX-License-Identifier: GPL-2.0-or-later
/// The form of an expression that a person would write down: the shortest of several exact rewritings.
#pragma once

#include "symbolic/ginac_door.hpp"

#include <optional>

namespace lagen {

/// The shortest text (a pair of parentheses counts as a few characters more) among: expanded; expanded with the
/// coefficients of each monomial in the variables factored; both with sin^2 + cos^2 = 1 used, and with the addition
/// theorems of sin and cos; factored as a whole; as derived. Rewritings that would cost too much are left out, by
/// bounds that depend on the expression alone, so that the choice is the same on every run.
[[nodiscard]] Tree shortest_form(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order);

/// Whether numerator and denominator over a common denominator have few terms even if nothing cancels: the greatest
/// common divisors that bring a fraction to lowest terms take a multiple of their time for each further divisor.
[[nodiscard]] bool has_short_fraction(const GiNaC::ex& expression);

/// The number of terms of an expression when it is expanded and like terms are joined; nothing where expanding costs
/// too much.
[[nodiscard]] std::optional<std::size_t> expanded_length(const GiNaC::ex& expression);

} // namespace lagen
