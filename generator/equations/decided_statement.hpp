// SPDX-License-Identifier: GPL-2.0-or-later
/// Statements about forms and sections that are decided component by component.
#pragma once

#include "geometry/form.hpp"
#include "proof/decide.hpp"
#include "typeset/equation_set.hpp"

#include <functional>

namespace lagen {

/// An expression that should vanish, and the names of its sections.
struct NamedResidual {
    std::vector<std::string> component;
    NodeId value;
};

/// The components of a form, those without terms left out. `name_of(k)`: of section k.
[[nodiscard]] std::vector<NamedResidual> residuals_of(const ExteriorForm& form,
                                                      const std::function<std::string(std::size_t)>& name_of);

/// The decision by `decider`; undecided where there is none, for constraints that are not triangular.
[[nodiscard]] Decision decision_by(const ZeroDecider* decider, NodeId residual);

/// The statement that all of them vanish: proved, refuted by the first that certainly does not, else undecided. Without
/// any the constant 0 is decided: there may be no point at which the model is defined.
[[nodiscard]] DecidedStatement decided_statement(Graph& graph, std::string formula, std::string latex,
                                                 const std::vector<NamedResidual>& residuals,
                                                 const std::function<Decision(NodeId)>& decide);

} // namespace lagen
