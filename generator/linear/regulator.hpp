// SPDX-License-Identifier: GPL-2.0-or-later
/// The gain u = -K s of least cost, the integral of s^T Q s + u^T R u over all times, on the leaf of a linear system:
///   K = R^-1 B^T P,      A^T P + P A - P B R^-1 B^T P + Q = 0,      all of A - B K decays.
/// P spans with 1 the stable subspace of the Hamiltonian matrix, by its ordered Schur form, and is refined by
/// Newton's method, in the units in which A is balanced. [Laub 1979; Kleinman 1968]
#pragma once

#include "linear/linear_system.hpp"

#include <optional>
#include <string>
#include <variant>

namespace lagen::linear {

struct Regulator {
    Matrix K;                            ///< shape (m, n)
    double residual = 0;                 ///< of Riccati's equation, relative to its terms
    std::vector<Eigenvalue> closed_loop; ///< eigenvalues of A - B K on the leaf, by real, then by imaginary parts
};

struct NoRegulator {
    enum class Reason {
        not_reached, ///< a mode that does not decay is not reached by the inputs
        not_seen,    ///< Q does not see a mode that neither grows nor decays
        not_found    ///< floating point does not tell stable from unstable
    };
    Reason reason = Reason::not_found;
    Eigenvalue eigenvalue;
};

/// Q symmetric and semidefinite, shape (n, n), R symmetric and definite, shape (m, m); `modes` of the system.
[[nodiscard]] std::variant<Regulator, NoRegulator> regulator(const LinearSystem& system, const std::vector<Mode>& modes,
                                                             const Matrix& Q, const Matrix& R);

} // namespace lagen::linear
