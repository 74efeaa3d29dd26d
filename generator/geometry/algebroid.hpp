// SPDX-License-Identifier: GPL-2.0-or-later
/// A Lie algebroid in local coordinates: anchor rho^i_a and structure functions C^c_ab as sparse arrays of closed
/// trees. n = 0 (a Lie algebra), r > n, r < n and directions in ker rho all occur.
#pragma once

#include "model/model.hpp"

namespace lagen {

/// rho(i, a): coefficient of d/dx^i in rho(e_a). Shape (n, r), upper index first.
struct AnchorValue {
    std::size_t i, a;
    Tree value;
    SourceRange where;
};

/// C(c, a, b): coefficient of e_c in [e_a, e_b]. Shape (r, r, r), antisymmetric in a, b. Listed as given: where only
/// one order of a pair is listed the other is its negative; where both are, `antisymmetry` is checked.
struct StructureValue {
    std::size_t c, a, b;
    Tree value;
    SourceRange where;
};

struct Algebroid {
    std::vector<Symbol> base;  ///< x^i, n of them
    std::vector<Symbol> fibre; ///< y^a, r of them
    std::vector<std::string> parameters;
    std::vector<AnchorValue> rho;  ///< nonzero entries
    std::vector<StructureValue> C; ///< nonzero entries
    std::vector<Tree> constraints;
    std::vector<Tree> domain;

    [[nodiscard]] std::size_t n() const { return base.size(); }
    [[nodiscard]] std::size_t r() const { return fibre.size(); }
};

/// rho and C of the model's algebroid block: general and action as given, tangent (rho = identity on `over`, C = 0),
/// lie_algebra (n = 0 or rho = 0), named algebras by their table. Throws ModelError (unknown algebra, wrong rank).
[[nodiscard]] Algebroid build_algebroid(const Model& model);

} // namespace lagen
