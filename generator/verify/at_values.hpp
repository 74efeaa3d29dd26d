// SPDX-License-Identifier: GPL-2.0-or-later
/// A fibre Hessian and its setting where some parameters have values: the same code then decides for these values what
/// it could not for all.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "mechanics/system.hpp"
#include "proof/decide.hpp"

#include <memory>

namespace lagen {

/// The setting with some of its inputs replaced; those are no variables or parameters any more. Nothing where a divisor
/// becomes the constant 0.
[[nodiscard]] std::optional<ProofSetting> replaced(Graph& graph, const ProofSetting& setting,
                                                   const Replacements& values);

struct AtValues {
    ProofSetting setting;
    FibreHessian hessian;
    std::unique_ptr<ZeroDecider> decider;
};

/// Nothing where these values make something undefined, or leave constraints that are not triangular.
[[nodiscard]] std::optional<AtValues> at_values(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                                const ProofBudget& budget, const Replacements& values);

} // namespace lagen
