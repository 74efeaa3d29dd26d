// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions and the setting in which they are decided, where some inputs have values: the same code then decides for
/// these values what it could not for all. Whatever is proved for the parameters of the file alone is proved in this way.
#pragma once

#include "mechanics/system.hpp"
#include "mechanics/fibre_hessian.hpp"
#include "proof/decide.hpp"

#include <memory>

namespace lagen {

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
