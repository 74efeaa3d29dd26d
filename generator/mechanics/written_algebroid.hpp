// SPDX-License-Identifier: GPL-2.0-or-later
/// A Lie algebroid as a person writes it: anchor rho^i_a and structure functions C^c_ab as sparse arrays of closed
/// trees. The same on the graph: geometry/algebroid.hpp.
#pragma once

#include "expression/symbol.hpp"
#include "geometry/construction.hpp"

#include <memory>

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

struct WrittenAlgebroid {
    std::vector<Symbol> base;  ///< x^i, n of them
    std::vector<Symbol> fibre; ///< y^a, r of them
    std::vector<std::string> parameters;
    std::vector<AnchorValue> rho;  ///< nonzero entries
    std::vector<StructureValue> C; ///< nonzero entries
    std::vector<Tree> constraints;
    std::vector<Tree> domain;
    std::shared_ptr<const Construction> construction = nullptr; ///< null: nothing is known of it

    [[nodiscard]] std::size_t n() const { return base.size(); }
    [[nodiscard]] std::size_t r() const { return fibre.size(); }
};

/// A_alpha^a: the component of e_alpha on e_a; of a drift b^a, alpha is 0.
struct SectionValue {
    std::size_t alpha, a;
    Tree value;
};

/// An affine distribution b + D in an algebroid as a person writes it: mechanics/system.hpp, Distribution.
struct WrittenDistribution {
    std::vector<Symbol> y; ///< y^alpha
    std::vector<SectionValue> sections, drift;
    std::vector<Tree> constraints; ///< as given
    Tree minor;                    ///< what solving them divides by; null where sections are given
    bool is_solved = false;
    bool has_dependent = false;
};

} // namespace lagen
