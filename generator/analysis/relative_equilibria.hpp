// SPDX-License-Identifier: GPL-2.0-or-later
/// Relative equilibria: motions along the flow of a sum of momenta and Casimirs F_i, critical points of the augmented
///   H_lambda = H - lambda_i F_i      on the levels F_i = c_i of a start,
/// over the coordinates z of E* that the equations use. They are sought from many points, in floating point, and each
/// is certified by an interval Newton step. Stability by the energy-momentum method: where the second variation of
/// H_lambda is definite on ker dF modulo the directions of the flows of F, the motion is stable; where the linearised
/// motion there has an eigenvalue with a positive real part, it is not. What neither shows is left open.
/// [Simo, Lewis and Marsden 1991; Marsden 1992]
#pragma once

#include "mechanics/hamilton.hpp"
#include "proof/eigenvalues.hpp"

#include <cstdint>

namespace lagen {

enum class Stability { stable, spectrally_unstable, undecided };
[[nodiscard]] const char* to_text(Stability stability);

struct RelativeEquilibrium {
    std::vector<double> z;           ///< of the coordinates
    std::vector<Rational> exact;     ///< z in fractions, where it is exactly that; else empty
    std::vector<double> multipliers; ///< lambda_i, in whose frame the eigenvalues are
    std::vector<double> cyclic;      ///< rates of the cyclic coordinates
    double energy = 0;               ///< H
    double radius = 0;               ///< there is one within this distance in each coordinate; certified
    bool certified = false;
    std::vector<bool> moved;         ///< a flow of F moves the coordinate
    std::size_t flows = 0;           ///< the number of directions of flows of F through it
    std::size_t dimension = 0;       ///< of ker dF modulo these
    int definite = 0;                ///< 1, -1: the second variation is certainly positive, negative definite there
    std::vector<double> definite_at; ///< the lambda_i that it is definite with, where these are others; else empty
    std::vector<proof::Eigenvalue> eigenvalues; ///< of the linearised motion there
    Stability stability = Stability::undecided;
};

struct ConservedFunction {
    NodeId value = 0;
    proof::Ball level;     ///< at the start
    bool flowless = false; ///< it generates no flow of the coordinates z
    bool casimir = false;  ///< nor of cyclic ones
};

struct RelativeEquilibria {
    std::vector<NodeId> coordinates; ///< inputs z
    std::vector<NodeId> cyclic;      ///< base coordinates that no rate depends on
    std::vector<ConservedFunction> conserved;
    std::vector<RelativeEquilibrium> found; ///< by energy; one of each family that the flows make
};

struct EquilibriumSearch {
    std::size_t starts = 600;
    std::uint64_t seed = 1;
};

/// At the parameter values of `system`, without forces and explicit time. `start`: the point (x, mu) whose levels are
/// taken, by nodes without inputs. `graph`: a copy of the system's with H.
[[nodiscard]] RelativeEquilibria relative_equilibria(Graph& graph, const System& system,
                                                     const HamiltonianNodes& hamiltonian,
                                                     const std::vector<NodeId>& start,
                                                     const EquilibriumSearch& search = {});

} // namespace lagen
