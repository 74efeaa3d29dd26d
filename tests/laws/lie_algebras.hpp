// SPDX-License-Identifier: GPL-2.0-or-later
/// Lie algebras of low dimension, abstract (all Bianchi types, extensions of R^3 by a derivation) and of matrices, and
/// the actions of the latter.
#pragma once

#include "local_algebroid.hpp"

namespace lagen::laws {

/// A basis A_a of matrices (m, m) by rows, and C^c_ab of the commutators as an algebroid over a point.
struct MatrixAlgebra {
    std::string name; ///< of the model language, where the basis is the named one; may be empty
    std::size_t m = 0;
    std::vector<std::vector<mpq_class>> basis;
    LocalAlgebroid algebroid;
    std::vector<mpq_class> invariant; ///< d_i with sum d_i (x^i)^2 conserved by x' = A x; empty where none is known
};

/// so(3), so(2,1), sl(2), gl(2), se(2), heis(3), aff(1), su(2), so(2), so(1,1), R^2 (as translations).
[[nodiscard]] std::size_t matrix_algebra_count();
[[nodiscard]] MatrixAlgebra matrix_algebra(std::size_t number);

/// e_1, e_2, e_3 with [e1,e2] = n3 e3 - a e2, [e2,e3] = n1 e1, [e3,e1] = n2 e2 + a e3, where n1 a = 0 [Bianchi 1898].
[[nodiscard]] LocalAlgebroid bianchi(const Formula& n1, const Formula& n2, const Formula& n3, const Formula& a);

/// A random abstract algebra of dimension 2 to 4; now and then with the parameter k in its constants.
[[nodiscard]] LocalAlgebroid random_lie_algebra(Dice& dice);

/// rho_a = -(A_a x)^i d/dx^i on R^m.
[[nodiscard]] LocalAlgebroid linear_action(const MatrixAlgebra& algebra);
/// The right action x.g of row vectors: rho_a = (x A_a)^i d/dx^i.
[[nodiscard]] LocalAlgebroid right_action(const MatrixAlgebra& algebra);
/// The action on the chart (x, 1) of projective space; affine where the last rows vanish.
[[nodiscard]] LocalAlgebroid projective_action(const MatrixAlgebra& algebra);

} // namespace lagen::laws
