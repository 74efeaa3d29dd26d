// SPDX-License-Identifier: GPL-2.0-or-later
/// Identities of sin and cos that take terms out of a sum.
#pragma once

#include "symbolic/sorted_form.hpp"

namespace lagen {

/// The sum with T sin^2 + T cos^2 = T and T - T sin^2 = T cos^2 (and with cos) used as often as there is one: every use
/// takes a term away.
[[nodiscard]] SortedTerm with_joined_squares(const SortedTerm& sum);

/// T cos a cos b +- T sin a sin b = T cos(a -+ b) and T sin a cos b +- T cos a sin b = T sin(a +- b), likewise.
class AngleSums {
  public:
    /// Keeps references.
    AngleSums(const SymbolTable& symbols, const Order& order) : symbols_(symbols), order_(order) {}

    [[nodiscard]] SortedTerm joined(const SortedTerm& sum) const;

  private:
    using Terms = std::map<std::string, SortedTerm>;

    [[nodiscard]] bool join(Terms& terms, const std::string& key) const;
    [[nodiscard]] SortedTerm of_sum(Function function, const SortedFactor& a, const SortedFactor& b, bool plus) const;

    const SymbolTable& symbols_;
    const Order& order_;
};

} // namespace lagen
