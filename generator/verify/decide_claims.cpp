// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a model, one kind after another, with names for people.
#include "graph/calculus/differentiate.hpp"
#include "mechanics/discrete.hpp"
#include "mechanics/hamilton_jacobi.hpp"
#include "mechanics/symmetry.hpp"
#include "proof/partial_parts.hpp"
#include "text/activity.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"
#include "verify/construction.hpp"
#include "verify/control_maximum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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
    for (const std::size_t& index : residual.indices) {
        const bool last = &index == &residual.indices.back();
        if (last && residual.name == "anchor")
            check.indices.push_back(graph_.input_name(system_.algebroid.x[index]));
        else if (last && residual.name == "tangency")
            check.indices.push_back(system_.constraints[index].name);
        else if (last && residual.name == "casimir")
            check.indices.push_back(system_.casimirs[index].name);
        else if (system_.rates.empty()) // else along the rates
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

/// The algebroid whose anchor constraints and Casimirs are constant along: that of the system, or of a system of first
/// order the line bundle with its rates as anchor, whose motions have the velocity 1.
Algebroid Claims::leaves()
{
    if (system_.rates.empty()) return system_.algebroid;
    AlgebroidBuilder line(graph_, system_.algebroid.x, 1);
    for (std::size_t i = 0; i < system_.rates.size(); ++i) line.add_anchor(i, 0, system_.rates[i]);
    return line.finish({graph_.input("velocity along the rates")});
}

void Claims::decide_structure(StructureReport& structure)
{
    const ResidualList list = structure_equations(partial_, leaves(), system_.functions);
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

/// True where a motion goes through each point of E: W ydot = f can be solved there, k^a f_a = 0 where k^a W_ab = 0.
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

// Sections that are claimed to be symmetries: of L, else of H, and of a discrete L that is written out. (That of a
// scheme is as symmetric as its curves; a run measures what it keeps.)

void Claims::decide_symmetries(StructureReport& structure)
{
    if (system_.symmetries.empty()) return;
    const auto append = [&](Check check, const char* hint) {
        if (check.decision.status == ProofStatus::refuted) check.hint = hint;
        structure.checks.push_back(std::move(check));
    };
    const char* const rate = "the residual is the rate of the momentum p_a s^a along motions without forces";
    WhereConstant where = along_anchor();
    for (const SymmetryClaim& claim : system_.symmetries) {
        if (lagrangian_ || system_.hamiltonian) {
            const NodeId change = lagrangian_ ? lift_of_lagrangian(graph_, system_, *lagrangian_, claim.s)
                                              : lift_of_hamiltonian(graph_, system_, claim.s);
            Check check{"symmetry", {claim.name}, judge_->decide(change)};
            const NodeId momentum = contraction(graph_, lagrangian_ ? lagrangian_->fibre.momenta : system_.mu, claim.s);
            if (check.decision.status == ProofStatus::proved)
                if (WhereConstant::Conditions found = where.of({momentum}); found.obstacle.empty())
                    check.where = std::move(found.texts);
            append(std::move(check), rate);
        }
        if (!system_.discrete || !system_.discrete->written) continue;
        const NodeId residual = lift_of_discrete_lagrangian(graph_, system_, claim.s);
        Check steps{"symmetry", {claim.name}, decide_on_arrows(graph_, system_, residual, judge_->decider().budget())};
        if (lagrangian_ || system_.hamiltonian) steps.indices.emplace_back("discrete");
        steps.meaning = "the derivative of the discrete Lagrangian along the complete lift of " + claim.name;
        append(std::move(steps), "the residual is the change of the momentum p_a s^a over a step without forces");
    }
}

// Claims about what the steps of a discrete Lagrangian keep: f(t + h, t(g), F^+L(g)) = f(t, s(g), F^-L(g)) for every
// arrow g.

namespace {

/// Names of f that neither points nor momenta have: velocities, functions of the arrow.
std::string foreign_name(const System& system, const Tree& f)
{
    const auto is_one_of = [&](const std::vector<NodeId>& inputs, const std::string& name) {
        return std::ranges::any_of(inputs, [&](NodeId node) { return system.graph.input_name(node) == name; });
    };
    for (const std::string& name : names_in(f))
        if (!is_one_of(system.algebroid.x, name) && !is_one_of(system.mu, name) &&
            !is_one_of(system.parameters, name) && !is_one_of({system.time, system.discrete->step}, name))
            return name;
    return {};
}

} // namespace

void Claims::decide_along_steps(Report& report, const std::vector<NamedTree>& claims)
{
    if (claims.empty() || !system_.discrete->lagrangian) return;
    const Groupoid& groupoid = *system_.groupoid;
    const DiscreteLegendre legendre = discrete_legendre(graph_, groupoid, *system_.discrete->lagrangian);
    Replacements before = replacements(system_.mu, legendre.minus), behind = replacements(system_.mu, legendre.plus);
    for (const auto& moved : replacements(system_.algebroid.x, target(graph_, groupoid, groupoid.arrow)))
        behind.push_back(moved);
    behind.emplace_back(system_.time, graph_.add(system_.time, system_.discrete->step));
    const bool everywhere = report.mechanics.discrete.kind != Regularity::Kind::degenerate;
    Lowering lower(graph_);
    for (const NamedTree& claim : claims) {
        Check check{"invariant", {claim.name}, {}};
        check.meaning = fmt::format("the change of {} over a step", claim.name);
        if (has_motions()) check.indices.emplace_back("discrete");
        if (const std::string name = foreign_name(system_, claim.value); !name.empty()) {
            if (has_motions()) continue; // a claim about those alone
            check.decision.evidence = fmt::format("'{}' is no function of the points and momenta of a step", name);
        } else {
            const NodeId f = lower(claim.value);
            const NodeId only[] = {f};
            const NodeId residual =
                graph_.subtract(substitute(graph_, only, behind)[0], substitute(graph_, only, before)[0]);
            check.decision = decide_on_arrows(graph_, system_, residual, judge_->decider().budget());
            if (check.decision.status == ProofStatus::refuted && !everywhere) {
                check.decision = Decision{};
                check.decision.evidence = "not every arrow keeps it, but the discrete Lagrangian is degenerate and its "
                                          "motions may pass through a part of the arrows alone";
            }
        }
        if (has_motions() && check.decision.status == ProofStatus::refuted)
            check.hint =
                "the steps of the discrete Lagrangian do not keep it, whatever the motions of L or H do; a claim "
                "that is written with velocities is about those alone";
        report.structure.checks.push_back(std::move(check));
    }
}

// Says whether the candidate of [hamilton_jacobi] is closed and solves Hamilton and Jacobi's equation.

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
