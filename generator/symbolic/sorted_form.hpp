// SPDX-License-Identifier: GPL-2.0-or-later
/// The sorted form behind from_ginac: coefficient times powers of factors, everything ordered by string keys made of
/// content alone. Key order is reading order: pi, parameters, sums of parameters, variables, functions, other sums;
/// higher powers first; constants last in a sum.
#pragma once

#include "symbolic/ginac_door.hpp"

namespace lagen {

struct SortedTerm;

/// One base of a product. `terms` is not empty where the base is a sum: primitive, its first coefficient positive
/// (except below a root, where the sum keeps its content).
struct SortedFactor {
    std::string key;       ///< of the base
    bool constant = false; ///< made of parameters and numbers alone
    Tree base;
    Rational exponent = 1;
    std::vector<SortedTerm> terms;
};

/// coefficient * prod base^exponent; no factors: a number.
struct SortedTerm {
    Rational coefficient;
    std::vector<SortedFactor> factors; ///< ascending keys
    std::string key;                   ///< of the factors with their exponents
};

/// The sorted form of an expression.
[[nodiscard]] SortedTerm sort_expression(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order);

/// A product of terms; a sum of terms with its content and sign drawn out.
[[nodiscard]] SortedTerm sorted_product(const std::vector<SortedTerm>& factors);
[[nodiscard]] SortedTerm sorted_sum(const std::vector<SortedTerm>& terms);

/// coefficient times the factors; a term by factors that it may have or not; the terms of what is a sum up to its
/// coefficient, that multiplied in.
[[nodiscard]] SortedTerm product_of(std::vector<SortedFactor> factors, const Rational& coefficient);
[[nodiscard]] SortedTerm divided(const SortedTerm& term, std::vector<SortedFactor> divisor);
[[nodiscard]] std::vector<SortedTerm> terms_in(const SortedTerm& sum);

/// The part of a function's key that stands for the function, after the two characters of its group.
[[nodiscard]] std::string function_key(Function function);

/// Trees as a person writes them: one fraction bar, roots as sqrt, a minus in front turned into a difference where one
/// fits.
[[nodiscard]] Tree tree_of(const SortedTerm& term);

} // namespace lagen
