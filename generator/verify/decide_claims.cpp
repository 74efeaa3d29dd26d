// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a model, one kind after another, with names for people.
#include "graph/calculus/differentiate.hpp"
#include "proof/partial_parts.hpp"
#include "verify/claims.hpp"
#include "verify/construction.hpp"
#include "verify/control_maximum.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {

/// The names that its numbers stand for; the last one is a base coordinate or a function of the base.
Check Claims::check_of(const Residual& residual) const
{
    Check check{residual.name, {}, {}, {}, {}};
    for (const std::size_t index : residual.indices) {
        const bool last = check.indices.size() + 1 == residual.indices.size();
        if (last && residual.name == "anchor")
            check.indices.push_back(graph_.input_name(system_.algebroid.x[index]));
        else if (last && residual.name == "tangency")
            check.indices.push_back(system_.constraint_texts[index]);
        else if (last && residual.name == "casimir")
            check.indices.push_back(system_.casimir_names[index]);
        else
            check.indices.push_back(graph_.input_name(system_.algebroid.y[index]));
    }
    return check;
}

/// Of a frame that is too large for quick normal forms: its equations follow from those of what it frames.
void Claims::decide_by_construction(const ResidualList& list)
{
    constexpr ProofBudget quick_budget{.terms = 2000, .products = 100'000};
    const auto& construction = system_.written.algebroid.construction;
    if (!construction) return;
    const ZeroDecider quick(graph_, setting_, smaller(judge_->decider().budget(), quick_budget));
    bool tried = false, constructed = false, refuted = false;
    std::map<NodeId, Decision> open;
    for (const Residual& residual : list.residuals) {
        if (residual.name == "tangency" || residual.name == "casimir") continue;
        Decision decision;
        if (!constructed) decision = quick.decide(residual.value);
        refuted = refuted || decision.status == ProofStatus::refuted;
        if (decision.status == ProofStatus::undecided && !tried) {
            tried = true;
            constructed = !refuted && holds_by_construction(*construction);
        }
        if (constructed) decision = judge_->decider().confirm(residual.value, construction_argument);
        if (decision.status != ProofStatus::undecided)
            judge_->remember(residual.value, std::move(decision));
        else
            open.emplace(residual.value, std::move(decision));
    }
    // The verdict is known then; long normal forms of what else holds or not are not worth minutes.
    for (auto& [value, decision] : open)
        if (refuted) judge_->remember(value, std::move(decision));
}

void Claims::decide_structure(StructureReport& structure)
{
    const ResidualList list = structure_equations(partial_, system_.algebroid, system_.functions);
    structure.note = note_;
    structure.trivial += list.trivial;
    decide_by_construction(list);
    WhereConstant where = along_anchor();
    for (const Residual& residual : list.residuals) {
        Check check = check_of(residual);
        check.decision = judge_->decide(residual.value);
        // The last index of these is the function.
        if (check.name == "tangency" || check.name == "casimir") {
            const std::vector<NodeId>& functions =
                check.name == "casimir" ? system_.functions.casimirs : system_.functions.constraints;
            where.restrict(check, {functions.at(residual.indices.back())});
        }
        check.reevaluation = judge_->reevaluate(residual.value);
        structure.checks.push_back(std::move(check));
    }
}

/// The name of the momentum that f is written out as: its rate needs no accelerations.
std::optional<NodeId> Claims::momentum_in(NodeId f, const Binding& names)
{
    const NodeId only[] = {f};
    if (!lagrangian_ || !depends_on_any(graph_, only, system_.algebroid.y)) return {};
    for (std::size_t a = 0; a < std::min(system_.mu.size(), system_.r()); ++a) {
        const auto name = names.find(graph_.input_name(system_.mu[a]));
        if (name == names.end() || name->second == f) continue;
        if (judge_->decider().status(graph_.subtract(f, lagrangian_->fibre.momenta[a])) == ProofStatus::proved)
            return name->second;
    }
    return {};
}

void Claims::decide_invariants(Report& report, const std::vector<NamedTree>& extra)
{
    const std::unique_ptr<EquationsOfMotion> motion = equations_of_motion();
    WhereConstant where = along_motions(*motion, report.mechanics.regularity);
    const Binding names = motion->names();
    Lowering lower(graph_, names);
    std::vector<NamedTree> claims = system_.written.invariants;
    claims.insert(claims.end(), extra.begin(), extra.end());
    for (const NamedTree& claim : claims) {
        Check check{"invariant", {claim.name}, {}, {}, {}};
        const NodeId f = lower(claim.value);
        const Rate rate = motion->rate(momentum_in(f, names).value_or(f));
        if (!rate.value) {
            check.decision.evidence = rate.obstacle;
        } else {
            // d log(x)/dt = xdot/x is defined where log(x) is not: the claim is about points where f is.
            std::vector<NodeId> functions{motion->in_states(f)};
            for (const NodeId part : partial_parts(graph_, lower, claim.value))
                functions.push_back(motion->in_states(part));
            ProofSetting setting = setting_;
            setting.defined.insert(setting.defined.end(), functions.begin(), functions.end());
            Judge judge(graph_, setting, accessory_inputs(system_), points_, judge_->decider().budget());
            check.decision = judge.decide(*rate.value);
            where.restrict(check, functions, divisors_of(rate, report.mechanics.regularity));
            check.reevaluation = judge.reevaluate(*rate.value);
            if (rate.for_every_control && check.decision.status == ProofStatus::refuted) {
                check.decision = Decision{};
                check.decision.evidence = rate.obstacle;
            }
        }
        report.structure.checks.push_back(std::move(check));
    }
}

void Claims::decide_controls(Report& report)
{
    if (!system_.control) return;
    report.control.maximum = decide_maximum(graph_, *system_.control, system_.mu, setting_, judge_->decider().budget());
    const ControlMaximum& maximum = report.control.maximum;
    Check check{"maximum", {}, {}, {}, {}};
    check.decision.status = maximum.kind == ControlMaximum::Kind::maximal   ? ProofStatus::proved
                            : maximum.kind == ControlMaximum::Kind::refuted ? ProofStatus::refuted
                                                                            : ProofStatus::undecided;
    check.decision.evidence = maximum.reason;
    check.hint = maximum.hint;
    report.structure.checks.push_back(std::move(check));
}

void Claims::decide_legendre(StructureReport& structure)
{
    if (!lagrangian_ || !hamiltonian_hessian_) return;
    const NodeId given[] = {*system_.hamiltonian};
    const NodeId hamiltonian = substitute(graph_, given, replacements(system_.mu, lagrangian_->fibre.momenta))[0];
    const NodeId residual = graph_.subtract(hamiltonian, lagrangian_->energy);
    ProofSetting setting = setting_;
    setting.defined.push_back(hamiltonian);
    Judge judge(graph_, setting, accessory_inputs(system_), points_, judge_->decider().budget());
    Check check{"legendre", {}, judge.decide(residual), {}, judge.reevaluate(residual)};
    if (check.decision.status == ProofStatus::refuted)
        check.hint = "H is y^a dL/dy^a - L at mu_a = dL/dy^a; leave [hamiltonian] out, and it is found from L";
    structure.checks.push_back(std::move(check));
}

} // namespace lagen
