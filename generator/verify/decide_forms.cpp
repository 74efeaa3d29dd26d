// SPDX-License-Identifier: GPL-2.0-or-later
/// What [forms] claims, component by component.
#include "verify/claims.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

// Of forms that claim nothing.
constexpr std::size_t most_components = 5000;
constexpr std::size_t most_nodes = 20'000;                                ///< of all components
constexpr ProofBudget quick_budget{.terms = 2000, .products = 2'000'000}; ///< products: of all components

std::size_t binomial(std::size_t n, std::size_t k)
{
    if (k > n) return 0;
    std::size_t result = 1;
    for (std::size_t j = 0; j < k; ++j) result = result * (n - j) / (j + 1);
    return result;
}

/// What must be defined of a form.
std::vector<NodeId> defined_parts(const FormClaim& claim)
{
    std::vector<NodeId> nodes = claim.partial_parts;
    for (const auto& [index, value] : claim.form.components) nodes.push_back(value);
    return nodes;
}

ProofStatus status_of(const std::vector<Check>& checks)
{
    ProofStatus status = ProofStatus::proved;
    for (const Check& check : checks) status = both(status, check.decision.status);
    return status;
}

} // namespace

/// Of a form that does not claim it, within a small budget: one component that does not vanish is enough.
ProofStatus Claims::closedness(const FormClaim& claim)
{
    const std::size_t count = binomial(system_.r(), claim.form.degree + 1);
    if (count > most_components) return ProofStatus::undecided;
    const ExteriorForm d = differential(partial_, system_.algebroid, claim.form);
    ProofSetting setting = setting_;
    for (const NodeId node : defined_parts(claim)) setting.defined.push_back(node);
    ProofBudget budget = quick_budget;
    budget.products /= std::max<std::size_t>(d.components.size(), 1);
    const ZeroDecider decider(graph_, setting, smaller(judge_->decider().budget(), budget));
    ProofStatus status = decider.status(graph_.constant(0));
    std::size_t nodes = 0;
    std::set<NodeId> values;
    for (const auto& [index, value] : d.components) {
        if (!values.insert(value).second) continue;
        nodes += reachable(graph_, std::vector{value}).size();
        if (nodes > most_nodes) return ProofStatus::undecided;
        const ProofStatus component = decider.status(value);
        if (component == ProofStatus::refuted) return component;
        if (component == ProofStatus::undecided) status = component;
    }
    return status;
}

/// A check for each component of `residual`, at points where the form, and what it is said to equal, is defined as
/// written.
Claims::Vanishing Claims::vanishing(const std::string& name, const FormClaim& claim, const ExteriorForm& residual)
{
    ProofSetting setting = setting_;
    for (const NodeId node : defined_parts(claim)) setting.defined.push_back(node);
    if (name == "equals")
        setting.defined.insert(setting.defined.end(), claim.equals_parts.begin(), claim.equals_parts.end());
    Judge judge(graph_, setting, judge_->decider().budget());
    std::vector<Check> checks;
    if (residual.components.empty() && !setting.defined.empty())
        if (Decision zero = judge.decide(graph_.constant(0)); zero.status != ProofStatus::proved)
            checks.push_back({name, {claim.name}, std::move(zero)});
    for (const auto& [index, value] : residual.components) {
        Check check{name, {claim.name}, judge.decide(value)};
        for (const std::size_t a : index) check.indices.push_back(graph_.input_name(system_.algebroid.y[a]));
        checks.push_back(std::move(check));
    }
    return {std::move(checks), binomial(system_.r(), residual.degree) - residual.components.size()};
}

void Claims::decide_forms(StructureReport& structure)
{
    WhereConstant where = along_anchor();
    for (const FormClaim& claim : system_.forms) {
        const auto append = [&](Vanishing equations) {
            structure.trivial += equations.trivial;
            std::ranges::move(equations.checks, std::back_inserter(structure.checks));
        };
        FormReport report{claim.name, claim.form.degree};
        if (claim.closed) {
            Vanishing closed = vanishing("closed", claim, differential(partial_, system_.algebroid, claim.form));
            // A closed function is a Casimir.
            if (claim.form.degree == 0)
                say_where(where, defined_parts(claim), closed.checks, {"closed", {claim.name}, {}});
            report.closed = status_of(closed.checks);
            append(std::move(closed));
        } else {
            report.closed = closedness(claim);
        }
        structure.forms.push_back(std::move(report));
        if (!claim.equals) continue;
        append(vanishing("equals", claim, difference(graph_, claim.form, *claim.equals)));
    }
}

} // namespace lagen
