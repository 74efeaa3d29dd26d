// SPDX-License-Identifier: GPL-2.0-or-later
#include "advice/advise.hpp"

#include "advice/repair_search.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// To a Casimir for which no repair was found: it may be no Casimir at all, but a joint.
constexpr const char* casimir_hint =
    "a Casimir is constant along all motions of the algebroid, whatever L is: rho(e) of it is 0 for each section e. "
    "What holds on M alone, as a joint of a linkage does, is one of [base] constraints; kind = \"level_set\" takes any";

} // namespace

void advise(const System& system, Report& report, const ProofBudget& budget)
{
    if (system.written.algebroid.r() != system.r()) return;
    if (std::ranges::none_of(report.structure.checks,
                             [](const Check& check) { return check.decision.status == ProofStatus::refuted; }))
        return;
    Graph graph = system.graph;
    BaseGradient partial(graph, system.algebroid.x);
    const ResidualList list = structure_equations(partial, system.algebroid, system.functions);
    // The checks of the report begin with these equations, in their order.
    if (report.structure.checks.size() < list.residuals.size()) throw InternalError("a report of another system");
    Judge judge(graph, proof_setting(graph, system), accessory_inputs(system), 0, budget);
    for (std::size_t k = 0; k < list.residuals.size(); ++k)
        judge.remember(list.residuals[k].value, report.structure.checks[k].decision);
    RepairSearch search(graph, partial, judge, system.written.algebroid, system.algebroid, system.functions,
                        system.editable);
    const std::vector<std::string> hints = search.hints(list);
    for (std::size_t k = 0; k < hints.size(); ++k) {
        Check& check = report.structure.checks[k];
        const bool casimir = check.name == "casimir" && check.decision.status == ProofStatus::refuted;
        check.hint = hints[k].empty() && casimir ? casimir_hint : hints[k];
    }
}

} // namespace lagen
