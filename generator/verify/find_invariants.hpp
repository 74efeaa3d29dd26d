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

/// Casimirs of E* first, then others. Linearly independent ones, up to constants and Casimirs of the base, which are no
/// polynomials in H and in those before them; each with rate zero, proved, and without t. `graph`: a copy
/// of the system's with H.
[[nodiscard]] std::vector<FoundInvariant> find_invariants(Graph& graph, const System& system,
                                                          const HamiltonianNodes& hamiltonian,
                                                          const InvariantAnsatz& ansatz = {});

} // namespace lagen
