// SPDX-License-Identifier: GPL-2.0-or-later
/// What [forms] claims, component by component.
#include "verify/claims.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {
namespace {

std::size_t binomial(std::size_t n, std::size_t k)
{
    if (k > n) return 0;
    std::size_t result = 1;
    for (std::size_t j = 0; j < k; ++j) result = result * (n - j) / (j + 1);
    return result;
}

/// Of a conjunction: refuted where one is, proved where all are.
ProofStatus status_of(const std::vector<Check>& checks)
{
    const auto any = [&](ProofStatus status) {
        return std::ranges::any_of(checks, [&](const Check& check) { return check.decision.status == status; });
    };
    if (any(ProofStatus::refuted)) return ProofStatus::refuted;
    return any(ProofStatus::undecided) ? ProofStatus::undecided : ProofStatus::proved;
}

} // namespace

/// A check for each component of `residual`, at points where the form, and what it is said to equal, is defined as
/// written.
Claims::Vanishing Claims::vanishing(const std::string& name, const FormClaim& claim, const ExteriorForm& residual)
{
    ProofSetting setting = setting_;
    for (const auto& [index, value] : claim.form.components)
        if (!graph_.is_constant(value)) setting.defined.push_back(value);
    setting.defined.insert(setting.defined.end(), claim.partial_parts.begin(), claim.partial_parts.end());
    if (name == "equals")
        setting.defined.insert(setting.defined.end(), claim.equals_parts.begin(), claim.equals_parts.end());
    Judge judge(graph_, setting, accessory_inputs(system_), points_, judge_->decider().budget());
    std::vector<Check> checks;
    if (residual.components.empty() && !setting.defined.empty())
        if (Decision zero = judge.decide(graph_.constant(0)); zero.status != ProofStatus::proved)
            checks.push_back({name, {claim.name}, std::move(zero), {}, {}});
    for (const auto& [index, value] : residual.components) {
        Check check{name, {claim.name}, judge.decide(value), {}, judge.reevaluate(value)};
        for (const std::size_t a : index) check.indices.push_back(graph_.input_name(system_.algebroid.y[a]));
        checks.push_back(std::move(check));
    }
    return {std::move(checks), binomial(system_.r(), residual.degree) - residual.components.size()};
}

void Claims::decide_forms(StructureReport& structure)
{
    for (const FormClaim& claim : system_.forms) {
        const auto append = [&](Vanishing equations) {
            structure.trivial += equations.trivial;
            std::ranges::move(equations.checks, std::back_inserter(structure.checks));
        };
        Vanishing closed = vanishing("closed", claim, differential(partial_, system_.algebroid, claim.form));
        structure.forms.push_back({claim.name, claim.form.degree, status_of(closed.checks)});
        if (claim.closed) append(std::move(closed));
        if (!claim.equals) continue;
        const ExteriorForm opposite = product(graph_, graph_.constant(-1), *claim.equals);
        append(vanishing("equals", claim, sum(graph_, claim.form, opposite)));
    }
}

} // namespace lagen
