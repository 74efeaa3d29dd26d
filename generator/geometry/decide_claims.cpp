// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a model, one kind after another, with names for people.
#include "geometry/claims.hpp"
#include "geometry/construction.hpp"
#include "geometry/control_maximum.hpp"
#include "graph/differentiate.hpp"
#include "proof/partial_parts.hpp"

namespace lagen {

/// The names that its numbers stand for; the last one is a base coordinate or a function of the base.
Check Claims::check_of(const Residual& residual) const
{
    Check check{residual.name, {}, {}, {}, {}};
    for (const std::size_t index : residual.indices) {
        const bool last = check.indices.size() + 1 == residual.indices.size();
        if (last && residual.name == "anchor")
            check.indices.push_back(algebroid_.base[index].name);
        else if (last && residual.name == "tangency")
            check.indices.push_back(to_text(algebroid_.constraints[index]));
        else if (last && residual.name == "casimir")
            check.indices.push_back(model_.base.casimirs[index].name);
        else
            check.indices.push_back(algebroid_.fibre[index].name);
    }
    return check;
}

/// Entries that are computed (of a frame, of a named algebra) are no places to mend.
Editable Claims::editable() const
{
    const AlgebroidBlock& block = model_.algebroid;
    const bool action = block.kind == AlgebroidKind::action;
    const bool given = block.kind == AlgebroidKind::general || block.kind == AlgebroidKind::lie_algebra || action;
    Editable editable;
    editable.anchor = (block.kind == AlgebroidKind::general || action) && block.representation.empty();
    editable.bracket = given && block.algebra.empty();
    editable.constant_bracket = block.kind != AlgebroidKind::general;
    return editable;
}

/// Of a frame that is too large for quick normal forms: its equations follow from those of what it frames.
void Claims::decide_by_construction(const ResidualList& list)
{
    constexpr ProofBudget quick_budget{.terms = 2000, .products = 100'000};
    if (!contains_frame(model_.algebroid)) return;
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
            constructed = !refuted && holds_by_construction(model_, algebroid_);
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

void Claims::decide_structure(VerifiedAlgebroid& verified)
{
    const ResidualList list = all_equations(graph_, *partial_, lowered_, functions_);
    verified.note = note_;
    verified.trivial += list.trivial;
    decide_by_construction(list);
    RepairSearch search(graph_, *partial_, *judge_, algebroid_, lowered_, functions_, editable());
    const std::vector<std::string> hints = search.hints(list);
    Continuity continuity = along_anchor();
    for (std::size_t k = 0; k < list.residuals.size(); ++k) {
        Check check = check_of(list.residuals[k]);
        check.decision = judge_->decide(list.residuals[k].value);
        // The last index of these is the function.
        if (check.name == "tangency" || check.name == "casimir") {
            const std::vector<NodeId>& functions =
                check.name == "casimir" ? functions_.casimirs : functions_.constraints;
            continuity.respect_jumps(check.decision, functions.at(list.residuals[k].indices.back()));
        }
        check.hint = hints[k];
        check.reevaluation = judge_->reevaluate(list.residuals[k].value);
        verified.checks.push_back(std::move(check));
    }
}

void Claims::decide_invariants(VerifiedAlgebroid& verified, const std::vector<NamedTree>& extra)
{
    const std::unique_ptr<EquationsOfMotion> motion = equations_of_motion();
    Continuity continuity = along_motions(*motion);
    Binding binding = motion->names(model_);
    binding.insert(binding_.begin(), binding_.end());
    Lowering lower(graph_, binding);
    std::vector<NamedTree> claims = model_.invariants;
    claims.insert(claims.end(), extra.begin(), extra.end());
    for (const NamedTree& claim : claims) {
        Check check{"invariant", {claim.name}, {}, {}, {}};
        const NodeId f = lower(claim.value);
        const Rate rate = motion->rate(f);
        if (!rate.value) {
            check.decision.evidence = rate.obstacle;
        } else {
            // d log(x)/dt = xdot/x is defined where log(x) is not: the claim is about points where f is.
            ProofSetting setting = setting_;
            setting.defined.push_back(motion->in_states(f));
            for (const NodeId part : partial_parts(graph_, lower, claim.value))
                setting.defined.push_back(motion->in_states(part));
            Judge judge(graph_, setting, accessory(), points_, judge_->decider().budget());
            check.decision = judge.decide(*rate.value);
            continuity.respect_jumps(check.decision, motion->in_states(f));
            check.reevaluation = judge.reevaluate(*rate.value);
            if (rate.for_every_control && check.decision.status == ProofStatus::refuted) {
                check.decision = Decision{};
                check.decision.evidence = rate.obstacle;
            }
        }
        verified.checks.push_back(std::move(check));
    }
}

void Claims::decide_controls(VerifiedAlgebroid& verified)
{
    if (!control_) return;
    ControlQuestion question{model_, *control_, mu_, {}};
    std::vector<Tree> trees{model_.control->cost};
    for (const ComponentEntry& entry : model_.control->sigma) trees.push_back(entry.value);
    for (const Tree& tree : trees)
        for (const NodeId part : partial_parts(graph_, *lower_, tree)) question.parts.push_back(part);
    verified.maximum = decide_maximum(graph_, question, setting_, judge_->decider().budget());
    const ControlMaximum& maximum = verified.maximum;
    Check check{"maximum", {}, {}, {}, {}};
    check.decision.status = maximum.kind == ControlMaximum::Kind::maximal   ? ProofStatus::proved
                            : maximum.kind == ControlMaximum::Kind::refuted ? ProofStatus::refuted
                                                                            : ProofStatus::undecided;
    check.decision.evidence = maximum.reason;
    check.hint = maximum.hint;
    verified.checks.push_back(std::move(check));
}

void Claims::decide_legendre(VerifiedAlgebroid& verified)
{
    if (!hessian_ || !hamiltonian_hessian_) return;
    std::vector<NodeId> terms;
    std::vector<std::pair<NodeId, NodeId>> momenta;
    for (std::size_t a = 0; a < lowered_.r(); ++a) {
        terms.push_back(graph_.multiply(lowered_.y[a], hessian_->momenta[a]));
        momenta.emplace_back(mu_[a], hessian_->momenta[a]);
    }
    const NodeId energy = graph_.subtract(graph_.sum(terms), hessian_->lagrangian);
    const NodeId given[] = {hamiltonian_hessian_->lagrangian};
    const NodeId hamiltonian = substitute(graph_, given, momenta)[0];
    const NodeId residual = graph_.subtract(hamiltonian, energy);
    ProofSetting setting = setting_;
    setting.defined.push_back(hamiltonian);
    Judge judge(graph_, setting, accessory(), points_, judge_->decider().budget());
    Check check{"legendre", {}, judge.decide(residual), {}, judge.reevaluate(residual)};
    if (check.decision.status == ProofStatus::refuted)
        check.hint = "H is y^a dL/dy^a - L at mu_a = dL/dy^a; leave [hamiltonian] out, and it is found from L";
    verified.checks.push_back(std::move(check));
}

} // namespace lagen
