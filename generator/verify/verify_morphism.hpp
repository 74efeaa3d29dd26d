// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a morphism Phi: E -> E' over phi, each proved, refuted or undecided:
///   constraint   h'(phi(x)) = 0 for each base constraint h' of the target; where one side is nonholonomic
///                ("Phi(y)", a): what of Phi(e_alpha) is not in D', ("Phi(drift)", a): of Phi(b) not in b' + D',
///                ("Phi(D)"): Phi(D) = D'
///   admissible   rho'(Phi e_b) = rho(e_b)(phi^i)                                     (b, i)
///   morphism     Phi [e_b, e_c] against [Phi e_b, Phi e_c], component a              (b, c, a)
///   invariance   L = L' o Phi;  Q_b = Phi^a_b Q'_a;  H o Phi^* = H';  cost, sigma, bounds of controls;  discrete L =
///   L' o phi
/// and where both are of groupoids, of the map of arrows g -> (phi(s(g)), phi(t(g)), W'(g)):
///   target       phi(t(g)) is the target of the image                                (i)
///   product      W'(g h) = W'(g) W'(h), t(g) = s(h)                                   (row, column)
///   unit         W' = 1 at the arrows 1                                               (row, column)
///   element      dW' is in the algebra of the target's group there, and W' in the group then
///   fibre        the fibre map that is given is that of the arrows                    (a, b)
///   equals       Phi is another map that it is claimed to be                           (coordinate, parameter)
/// The rank of Phi^a_b stands outside of the verdict, and where the map is defined and reaches the target's domain: all
/// claims are about points there.                                                              [Martinez 2001]
#pragma once

#include "mechanics/morphism.hpp"
#include "proof/rank.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// What follows from the claims. Of H and of control problems: along a solution (x, mu = Phi^* mu'), where x' = phi(x),
/// H(x, Phi^* mu') = H'(x', mu') gives Phi dH/dmu = dH'/dmu' and, the map being a morphism, mudot = Phi^* mu'dot.
struct MorphismTheorems {
    bool reduction = false;         ///< solutions of the source project to solutions of the target
    bool of_pulled_momenta = false; ///< those of momenta Phi^* mu' alone
    bool reconstruction = false;    ///< admissible curves over solutions of the target are solutions of the source
    bool discrete = false;          ///< arrows solve the discrete equations exactly where their images do
};

/// Where the map is defined and takes its point into the target's domain.
struct ReachOfMap {
    std::vector<std::string> where; ///< sufficient strict conditions that the source's domain does not imply
    std::string obstacle;           ///< why they cannot be named; may be empty
};

struct MorphismReport {
    StructureReport structure; ///< of the map alone
    GenericRank rank;
    ReachOfMap reach;
    bool compares_motions = true; ///< false: one side has L and the other H, or none of the two
    MorphismTheorems theorems;
};

/// Of the map alone; the models are verified by `verify` of each.
[[nodiscard]] MorphismReport verify(const SystemMorphism& morphism, const ProofBudget& budget = {});

/// Decides that `morphism` is the map `other` between the same systems: phi^i, y'^a, u' and W' where both give them,
/// and the target's parameters.
void append_equality(StructureReport& structure, const SystemMorphism& morphism, const SystemMorphism& other,
                     const ProofBudget& budget = {});

/// The worse of two: invalid, undecided, valid.
[[nodiscard]] Verdict worse(Verdict a, Verdict b);

} // namespace lagen
