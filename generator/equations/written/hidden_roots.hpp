// SPDX-License-Identifier: GPL-2.0-or-later
/// Roots of sums and sums that divide, by names: expanding a product leaves what is below them as it is, (x - y)^2.
#pragma once

#include "symbolic/ginac_door.hpp"

namespace lagen {

class HiddenRoots : public GiNaC::map_function {
  public:
    HiddenRoots(SymbolTable& symbols, const Order& order) : symbols_(symbols), order_(order) {}

    GiNaC::ex hidden(const GiNaC::ex& expression) { return (*this)(expression); }
    [[nodiscard]] GiNaC::ex shown(const GiNaC::ex& expression) const { return expression.subs(values_); }

    GiNaC::ex operator()(const GiNaC::ex& part) override;

  private:
    SymbolTable& symbols_;
    const Order& order_;
    GiNaC::exmap values_;
};

} // namespace lagen
