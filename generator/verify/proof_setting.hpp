// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the claims about a system are decided: its variables, parameters, constraints and domain, and what must be
/// defined at a point for the point to count.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "mechanics/system.hpp"
#include "proof/decide.hpp"

#include <memory>

namespace lagen {

/// `graph`: a copy of the system's, in which what a nonholonomic system is made of is put on the constraint.
[[nodiscard]] ProofSetting proof_setting(Graph& graph, const System& system);

// Functions and the setting in which they are decided, where some inputs have values: the same code then decides for
// these values what it could not for all. Whatever is proved for the parameters of the file alone is proved in this
// way.

struct AtValues {
    std::vector<NodeId> nodes;
    ProofSetting setting; ///< in which what has a value is no variable or parameter any more
    std::unique_ptr<ZeroDecider> decider;
};

/// Nothing where these values make something undefined, or leave constraints that are not triangular.
[[nodiscard]] std::optional<AtValues> at_values(Graph& graph, const std::vector<NodeId>& nodes,
                                                const ProofSetting& setting, const ProofBudget& budget,
                                                const Replacements& values);

struct HessianAtValues : AtValues {
    FibreHessian hessian;
};
[[nodiscard]] std::optional<HessianAtValues> at_values(Graph& graph, const FibreHessian& hessian,
                                                       const ProofSetting& setting, const ProofBudget& budget,
                                                       const Replacements& values);

} // namespace lagen
