// SPDX-License-Identifier: GPL-2.0-or-later
/// Invariants that nobody claimed: functions on E* in the span of an ansatz whose rate along Hamilton's equations is
/// zero. A search at points, in floating point; each one that it finds is proved.
#pragma once

#include "mechanics/hamilton.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// Monomials in momenta (of degree 2 at most) and in functions of the point: coordinates that stand outside of
/// functions, and the functions, roots, divisors of H.
struct InvariantAnsatz {
    std::size_t degree = 3;      ///< of a monomial
    std::size_t monomials = 400; ///< where there are more of that degree, it is lowered
};

struct FoundInvariant {
    NodeId value = 0;                  ///< over x and mu, with rational coefficients
    bool for_given_parameters = false; ///< proved for the parameter values of the file alone
};

/// Casimirs of E* first, then others: up to constants, H, base constraints and Casimirs of the base; each with rate
/// zero, proved, and without t, and none that is a function of H, the constraints, the Casimirs and those before, by
/// the rank of differentials at points drawn at random. `graph`: a copy of the system's with H.
[[nodiscard]] std::vector<FoundInvariant> find_invariants(Graph& graph, const System& system,
                                                          const HamiltonianNodes& hamiltonian,
                                                          const InvariantAnsatz& ansatz = {});

/// Functions of the base that are constant along vector fields on it, likewise, of the lowest degree first until there
/// are `wanted`; none is a function of the `known` ones. At the parameter values of the system, and so are the fields.
/// The ansatz has sin x beside cos x, and the coordinates under functions.
[[nodiscard]] std::vector<NodeId> find_constants(Graph& graph, const System& system,
                                                 const std::vector<std::vector<NodeId>>& fields,
                                                 const std::vector<NodeId>& known, std::size_t wanted);

} // namespace lagen
