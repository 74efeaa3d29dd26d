// SPDX-License-Identifier: GPL-2.0-or-later
/// Whether the candidate of [hamilton_jacobi] is closed and solves Hamilton and Jacobi's equation.
#include "mechanics/hamilton_jacobi.hpp"
#include "verify/claims.hpp"

#include <algorithm>
#include <iterator>

namespace lagen {

void Claims::decide_hamilton_jacobi(StructureReport& structure, const Regularity& regularity)
{
    if (!system_.hamilton_jacobi) return;
    HamiltonJacobiReport& report = structure.hamilton_jacobi.emplace();
    const bool degenerate = !system_.hamiltonian && regularity.kind == Regularity::Kind::degenerate;
    std::optional<HamiltonianNodes> hamiltonian;
    if (!degenerate) hamiltonian = closed_hamiltonian(graph_, system_, regularity.newton_start);
    if (!hamiltonian) {
        Decision open;
        open.evidence = degenerate ? "the Lagrangian is degenerate: there is no H on E*"
                                   : "the velocities are no closed function of the momenta; [hamiltonian] H gives one";
        structure.checks.push_back({"hamilton_jacobi", {}, std::move(open)});
        return;
    }
    const HamiltonJacobiNodes nodes = hamilton_jacobi(graph_, system_, *hamiltonian, system_.hamilton_jacobi->alpha);
    ProofSetting setting = setting_;
    for (const std::vector<NodeId>* list : {&system_.hamilton_jacobi->alpha, &system_.hamilton_jacobi->parts})
        for (const NodeId node : *list)
            if (!graph_.is_constant(node)) setting.defined.push_back(node);
    Judge judge(graph_, setting, judge_->decider().budget());
    const auto name_of = [&](std::size_t a) { return graph_.input_name(system_.algebroid.y[a]); };
    std::vector<Check> checks;
    const auto append = [&](const char* name, std::vector<std::string> indices, NodeId value, ProofStatus& status) {
        if (graph_.is_zero(value)) {
            ++structure.trivial;
            return;
        }
        Check check{name, std::move(indices), judge.decide(value)};
        status = both(status, check.decision.status);
        checks.push_back(std::move(check));
    };
    // Where nothing has terms there may still be no point at which the candidate is defined.
    const ProofStatus defined = judge.decide(graph_.constant(0)).status;
    report = {defined, defined, defined, std::nullopt};
    for (const auto& [index, value] : nodes.closed.components)
        append("closed", {"alpha", name_of(index[0]), name_of(index[1])}, value, report.closed);
    for (std::size_t b = 0; b < nodes.equation.size(); ++b)
        append("hamilton_jacobi", {name_of(b)}, nodes.equation[b], report.equation);
    for (const NodeId value : nodes.lift)
        if (!graph_.is_zero(value)) report.lifts = both(report.lifts, judge.decide(value).status);
    if (nodes.action) report.action = both(defined, judge.decide(*nodes.action).status);
    WhereConstant where = along_anchor();
    std::vector<NodeId> functions = system_.hamilton_jacobi->alpha;
    functions.insert(functions.end(), system_.hamilton_jacobi->parts.begin(), system_.hamilton_jacobi->parts.end());
    if (where.of(functions).obstacle.empty()) // what is proved is proved of each point where alpha is defined
        say_where(where, functions, checks, {"hamilton_jacobi", {}, {}});
    std::ranges::move(checks, std::back_inserter(structure.checks));
    if (defined != ProofStatus::proved)
        structure.checks.push_back({"hamilton_jacobi", {}, judge.decide(graph_.constant(0))});
}

} // namespace lagen
