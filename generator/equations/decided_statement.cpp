// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/decided_statement.hpp"

namespace lagen {

std::vector<NamedResidual> residuals_of(const ExteriorForm& form,
                                        const std::function<std::string(std::size_t)>& name_of)
{
    std::vector<NamedResidual> residuals;
    for (const auto& [index, value] : form.components) {
        NamedResidual& residual = residuals.emplace_back();
        for (const std::size_t k : index) residual.component.push_back(name_of(k));
        residual.value = value;
    }
    return residuals;
}

Decision decision_by(const ZeroDecider* decider, NodeId residual)
{
    if (decider != nullptr) return decider->decide(residual);
    Decision open;
    open.evidence = "the base constraints are not triangular";
    return open;
}

DecidedStatement decided_statement(Graph& graph, std::string formula, std::string latex,
                                   const std::vector<NamedResidual>& residuals,
                                   const std::function<Decision(NodeId)>& decide)
{
    std::vector<NamedResidual> open;
    for (const NamedResidual& residual : residuals)
        if (!graph.is_zero(residual.value)) open.push_back(residual);
    if (open.empty()) open.push_back({{}, graph.constant(0)});
    const auto text = [](ProofStatus status) { return std::string(to_text(status)); };
    DecidedStatement statement{std::move(formula), std::move(latex), text(ProofStatus::proved)};
    for (const NamedResidual& residual : open) {
        const Decision decision = decide(residual.value);
        if (decision.status == ProofStatus::proved) continue;
        if (statement.status != text(ProofStatus::proved) && decision.status != ProofStatus::refuted) continue;
        statement.status = text(decision.status);
        statement.component = residual.component;
        statement.residual = decision.residual;
        statement.evidence = decision.evidence;
        if (!decision.witness) continue;
        for (const auto& [name, at] : decision.witness->point) statement.witness.emplace_back(name, to_text(at));
        statement.value = decision.witness->value;
        break;
    }
    return statement;
}

} // namespace lagen
