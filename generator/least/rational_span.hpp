// SPDX-License-Identifier: GPL-2.0-or-later
/// The space that vectors of numbers span, by a basis of simple rationals: a guess, which a proof must confirm.
#pragma once

#include "expression/tree.hpp"

#include <cstddef>
#include <vector>

namespace lagen {

class RationalSpan {
  public:
    /// Of vectors of `size` entries.
    explicit RationalSpan(std::size_t size) : size_(size) {}

    /// True where the vector enlarges the space; vectors with entries that are not finite do not.
    bool add(std::vector<long double> vector);
    [[nodiscard]] std::size_t dimension() const { return rows_.size(); }
    [[nodiscard]] const std::vector<std::size_t>& pivots() const { return pivots_; }
    /// An entry of row `k` in numbers.
    [[nodiscard]] long double entry(std::size_t k, std::size_t column) const { return rows_[k][column]; }
    /// The rows of the reduced echelon form, each entry the simplest rational near it; empty where one has none with
    /// small numbers.
    [[nodiscard]] std::vector<std::vector<Rational>> rows() const;
    /// A basis of the vectors v with r.v = 0 for all rows r; empty where there is none, or it is not rational.
    [[nodiscard]] std::vector<std::vector<Rational>> kernel() const;

  private:
    std::size_t size_;
    std::vector<std::vector<long double>> rows_; ///< reduced echelon form
    std::vector<std::size_t> pivots_;            ///< the column of each row's leading 1
};

} // namespace lagen
