// SPDX-License-Identifier: GPL-2.0-or-later
/// Does a map carry the distribution of a nonholonomic system onto that of another? The checks `constraint` of a
/// morphism and of its reduction: Phi(e_alpha) in D', Phi(b) in b' + D', Phi(D) = D'.
#pragma once

#include "verify/judge.hpp"
#include "verify/mapped_systems.hpp"
#include "verify/verify.hpp"

namespace lagen {

struct CarriedDistribution {
    std::vector<Check> checks; ///< residuals that are 0 by structure are left out
    bool onto = false;         ///< Phi(D) = D' is proved at every point
};
[[nodiscard]] CarriedDistribution decide_carried(MappedSystems& both, Judge& judge);

} // namespace lagen
