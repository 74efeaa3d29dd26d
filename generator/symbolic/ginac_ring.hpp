// SPDX-License-Identifier: GPL-2.0-or-later
/// Square matrices of GiNaC expressions as a ring for determinant(): nothing is multiplied out.
#pragma once

#include "expression/linear_algebra.hpp"

#include <ginac/ginac.h>

namespace lagen {

struct GinacRing {
    using Number = GiNaC::ex;
    const std::vector<GiNaC::ex>& matrix; ///< n*n entries by rows
    std::size_t n;

    [[nodiscard]] GiNaC::ex zero() const { return 0; }
    [[nodiscard]] GiNaC::ex one() const { return 1; }
    [[nodiscard]] const GiNaC::ex& entry(std::size_t i, std::size_t j) const { return matrix[i * n + j]; }
    [[nodiscard]] bool is_zero(const GiNaC::ex& a) const { return a.is_zero(); }
    [[nodiscard]] GiNaC::ex times(const GiNaC::ex& a, const GiNaC::ex& b) const { return a * b; }
    void add(GiNaC::ex& sum, const GiNaC::ex& term, int sign) const { sum += sign > 0 ? term : GiNaC::ex(-term); }
};

/// Of matrices of numbers.
template <>
struct Arithmetic<GiNaC::ex> {
    using Number = GiNaC::ex;
    [[nodiscard]] bool is_better_pivot(const GiNaC::ex& a, const GiNaC::ex& than) const
    {
        return than.is_zero() && !a.is_zero();
    }
    [[nodiscard]] bool is_pivot(const GiNaC::ex& a) const { return !a.is_zero(); }
    [[nodiscard]] GiNaC::ex quotient(const GiNaC::ex& a, const GiNaC::ex& b) const { return a / b; }
    void subtract_product(GiNaC::ex& a, const GiNaC::ex& f, const GiNaC::ex& b) const { a -= f * b; }
    [[nodiscard]] std::vector<GiNaC::ex> no_solution(std::size_t) const { return {}; }
};

} // namespace lagen
