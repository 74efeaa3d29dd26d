// SPDX-License-Identifier: GPL-2.0-or-later
/// Rules of integration on [0, 1] that schemes are made of, and the polynomials that their curves are.
#pragma once

#include "expression/tree.hpp"

#include <string>
#include <vector>

namespace lagen {

struct QuadratureRule {
    std::vector<Rational> nodes, weights; ///< on [0, 1], to 200 bits where they are irrational
    std::size_t degree = 1;               ///< of the curve
};

/// Of the scheme with this name: "midpoint", "gauss:2", .. Throws InternalError where there is none.
[[nodiscard]] QuadratureRule quadrature_rule(const std::string& scheme);

/// The polynomials of degree d that are 1 at the point k/d inside, 0 at the others and at both ends.
class InnerPolynomials {
  public:
    explicit InnerPolynomials(std::size_t degree);
    [[nodiscard]] Rational value(std::size_t k, const Rational& c) const;
    [[nodiscard]] Rational slope(std::size_t k, const Rational& c) const;

  private:
    std::vector<Rational> points_;
};

} // namespace lagen
