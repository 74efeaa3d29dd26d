// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a model, one kind after another, with names for people.
#include "graph/calculus/differentiate.hpp"
#include "proof/partial_parts.hpp"
#include "text/activity.hpp"
#include "verify/claims.hpp"
#include "verify/construction.hpp"
#include "verify/control_maximum.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// rho_a(f) of a constraint or a Casimir.
bool is_of_function(const Residual& residual)
{
    return residual.name == "tangency" || residual.name == "casimir";
}

} // namespace

/// Decided, with the names that its numbers stand for; the last one is a base coordinate or a function of the base.
Check Claims::check_of(const Residual& residual)
{
    Check check{residual.name, {}, judge_->decide(residual.value)};
    for (const std::size_t index : residual.indices) {
        const bool last = check.indices.size() + 1 == residual.indices.size();
        if (last && residual.name == "anchor")
            check.indices.push_back(graph_.input_name(system_.algebroid.x[index]));
        else if (last && residual.name == "tangency")
            check.indices.push_back(system_.constraints[index].name);
        else if (last && residual.name == "casimir")
            check.indices.push_back(system_.casimirs[index].name);
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
    Activity activity("quick proofs", list.residuals.size());
    for (const Residual& residual : list.residuals) {
        activity.next();
        if (is_of_function(residual)) continue;
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
    Activity activity("equations", list.residuals.size());
    const auto append_check = [&](std::vector<Check>& checks, const Residual& residual) {
        activity.next();
        checks.push_back(check_of(residual));
    };
    for (const Residual& residual : list.residuals)
        if (!is_of_function(residual)) append_check(structure.checks, residual);
    WhereConstant where = along_anchor();
    auto next = std::ranges::find_if(list.residuals, is_of_function); // sorted by the functions
    const auto append = [&](const char* name, std::size_t k, NodeId f, const BaseFunctionText& text) {
        std::vector<Check> checks;
        for (; next != list.residuals.end() && next->name == name && next->indices.back() == k; ++next)
            append_check(checks, *next);
        std::vector<NodeId> functions{f};
        functions.insert(functions.end(), text.parts.begin(), text.parts.end());
        say_where(where, functions, checks, {name, {text.name}, {}});
        std::ranges::move(checks, std::back_inserter(structure.checks));
    };
    for (std::size_t k = 0; k < system_.constraints.size(); ++k)
        append("tangency", k, system_.functions.constraints[k], system_.constraints[k]);
    for (std::size_t k = 0; k < system_.casimirs.size(); ++k)
        append("casimir", k, system_.functions.casimirs[k], system_.casimirs[k]);
}

/// Of the checks that the differential of a function is zero; `none` stands for them where it has no terms, and
/// conditions remain.
void Claims::say_where(WhereConstant& where, const std::vector<NodeId>& functions, std::vector<Check>& checks,
                       Check none)
{
    const auto is_proved = [](const Check& check) { return check.decision.status == ProofStatus::proved; };
    if (!checks.empty() && std::ranges::none_of(checks, is_proved)) return;
    const WhereConstant::Conditions conditions = where.of(functions);
    if (checks.empty() && (!conditions.texts.empty() || !conditions.obstacle.empty())) {
        none.decision = judge_->decide(graph_.constant(0));
        checks.push_back(std::move(none));
    }
    for (Check& check : checks) WhereConstant::restrict(check, conditions);
}

/// The name of the momentum that f is written out as: its rate needs no accelerations.
std::optional<NodeId> Claims::momentum_in(NodeId f, const Binding& names)
{
    const NodeId only[] = {f};
    if (!lagrangian_ || !depends_on_any(graph_, only, lagrangian_->fibre.y)) return {};
    for (std::size_t a = 0; a < std::min(system_.mu.size(), lagrangian_->fibre.y.size()); ++a) {
        const auto name = names.find(graph_.input_name(system_.mu[a]));
        if (name == names.end() || name->second == f) continue;
        if (judge_->decider().status(graph_.subtract(f, lagrangian_->fibre.momenta[a])) == ProofStatus::proved)
            return name->second;
    }
    return {};
}

void Claims::decide_invariants(Report& report, const std::vector<NamedTree>& extra)
{
    std::vector<NamedTree> claims = system_.written.invariants;
    claims.insert(claims.end(), extra.begin(), extra.end());
    const bool steps = system_.discrete && system_.discrete->written;
    if (has_motions() || !steps) decide_along_motions(report, claims);
    if (steps) decide_along_steps(report, claims);
}

/// Whether a motion goes through each point of E: W ydot = f can be solved there, k^a f_a = 0 where k^a W_ab = 0.
bool Claims::motions_fill(const Regularity& regularity)
{
    if (!lagrangian_ || regularity.of != Regularity::Matrix::lagrangian ||
        regularity.kind != Regularity::Kind::degenerate)
        return true;
    const std::vector<NodeId>& y = lagrangian_->fibre.y;
    if (regularity.rank + regularity.kernel.size() != y.size()) return false;
    const LagrangeRates rates =
        lagrange_rates(graph_, system_, *lagrangian_, lagrange_balance(graph_, system_, *lagrangian_));
    Lowering lower(graph_);
    return std::ranges::all_of(regularity.kernel, [&](const auto& vector) {
        NodeId sum = graph_.constant(0);
        for (std::size_t a = 0; a < y.size(); ++a)
            for (const auto& [name, value] : vector)
                if (name == graph_.input_name(y[a]))
                    sum = graph_.add(sum, graph_.multiply(lower(value), rates.force[a]));
        return graph_.is_zero(sum) || judge_->decide(sum).status == ProofStatus::proved;
    });
}

void Claims::decide_along_motions(Report& report, const std::vector<NamedTree>& claims)
{
    const std::unique_ptr<EquationsOfMotion> motion = equations_of_motion();
    WhereConstant where = along_motions(*motion, report.mechanics.regularity);
    const Binding names = motion->names();
    Lowering lower(graph_, names);
    const bool everywhere = motions_fill(report.mechanics.regularity);
    Activity activity("functions", claims.size());
    for (const NamedTree& claim : claims) {
        activity.next();
        Check check{"invariant", {claim.name}, {}};
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
            Judge judge(graph_, setting, judge_->decider().budget());
            check.decision = judge.decide(*rate.value);
            if (check.decision.status == ProofStatus::proved)
                WhereConstant::restrict(check, where.of(functions, divisors_of(rate, report.mechanics.regularity)));
            if (check.decision.status == ProofStatus::refuted && (rate.for_every_control || !everywhere)) {
                check.decision = Decision{};
                check.decision.evidence = rate.for_every_control
                                              ? rate.obstacle
                                              : "its rate is not zero at every point of E, but the Lagrangian is "
                                                "degenerate and its motions may fill a part of E alone";
            }
        }
        report.structure.checks.push_back(std::move(check));
    }
}

void Claims::decide_controls(Report& report)
{
    if (!system_.control) return;
    // H has no first-order states: no proof of its maximum is to rest on what becomes of them.
    ProofSetting setting = setting_;
    std::erase_if(setting.variables, [&](NodeId variable) {
        return std::ranges::find(system_.states, variable) != system_.states.end() &&
               !depends_on_any(graph_, setting.defined, std::vector{variable});
    });
    report.control.maximum = decide_maximum(graph_, *system_.control, system_.mu, setting, judge_->decider().budget());
    const ControlMaximum& maximum = report.control.maximum;
    Check check{"maximum", {}, {}};
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
    Judge judge(graph_, setting, judge_->decider().budget());
    Check check{"legendre", {}, judge.decide(residual)};
    if (check.decision.status == ProofStatus::refuted)
        check.hint = "H is y^a dL/dy^a - L at mu_a = dL/dy^a; leave [hamiltonian] out, and it is found from L";
    structure.checks.push_back(std::move(check));
}

} // namespace lagen
