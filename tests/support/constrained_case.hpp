// SPDX-License-Identifier: GPL-2.0-or-later
/// The cases of tests/data/nonholonomic: systems on a constraint Y = b + y^alpha e_alpha, as records and as models.
#pragma once

#include "support/reference_case.hpp"

namespace lagen {

/// What a point has beside that of `reference`, in the same order.
struct ConstrainedPoint {
    std::vector<std::string> ambient_velocity; ///< Y^a, shape (r)
    std::vector<std::string> reaction;         ///< lambda_a, shape (r)
    std::string moving_energy;                 ///< E - P_a b^a; of linear constraints the energy
};

struct ConstrainedCase {
    ReferenceCase reference;                        ///< of x and y; rho, brackets and L are those of the ambient Y
    std::vector<std::string> ambient;               ///< Y^a
    std::vector<std::vector<std::string>> sections; ///< sections[alpha][a] = A_alpha^a
    std::vector<std::string> drift;                 ///< b^a, or empty
    std::vector<std::string> constraints;           ///< 0 on the constraint
    std::vector<ConstrainedPoint> points;
    std::vector<std::string> bracket; ///< the first one that leaves D: two sections
};

/// Every case, sorted by name.
[[nodiscard]] std::vector<ConstrainedCase> read_constrained_cases();

/// The case as a model file, its constraint by sections and drift, with the constraints beside them; its start is the
/// scene `default`, which observes the state.
[[nodiscard]] std::string model_text(const ConstrainedCase& constrained);

} // namespace lagen
