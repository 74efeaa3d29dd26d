// SPDX-License-Identifier: GPL-2.0-or-later
/// What `check` says of a nonholonomic system: that its sections are independent and satisfy the constraints beside
/// them; outside the verdict whether their brackets stay in the distribution, and which energy is conserved.
#include "graph/calculus/differentiate.hpp"
#include "proof/rank.hpp"
#include "verify/claims.hpp"
#include "verify/distribution_rows.hpp"
#include "verify/judge.hpp"
#include "verify/singular_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace lagen {

/// Psi^A(e_alpha) = 0 in the linear part, Psi^A(b) = 0, and as many independent constraints as the sections leave.
void Claims::decide_constraints(StructureReport& structure)
{
    const Distribution& distribution = *system_.distribution;
    const std::size_t k = distribution.sections.size(), r = system_.r();
    if (distribution.is_solved || distribution.constraints.empty()) return;
    const auto append = [&](std::vector<std::string> indices, NodeId residual) {
        structure.append(graph_, "constraint", std::move(indices), residual, *judge_);
    };
    const std::vector<NodeId> B = constraint_rows(graph_, system_);
    for (std::size_t A = 0; A < distribution.constraints.size(); ++A) {
        const std::string& text = distribution.constraint_texts[A];
        for (std::size_t alpha = 0; alpha < k; ++alpha) {
            const auto row = B.begin() + static_cast<std::ptrdiff_t>(A * r);
            append({graph_.input_name(distribution.y[alpha]), text},
                   pairing(graph_, {row, row + static_cast<std::ptrdiff_t>(r)}, distribution.sections[alpha]));
        }
        std::vector<NodeId> drift(r, graph_.constant(0));
        for (const ColumnEntry& entry : distribution.drift) drift[entry.index] = entry.value;
        const NodeId only[] = {distribution.constraints[A]};
        append({"drift", text}, substitute(graph_, only, replacements(system_.algebroid.y, drift))[0]);
    }
    const GenericRank rank = generic_rank(graph_, B, distribution.constraints.size(), r, judge_->decider());
    if (rank.rank && *rank.rank == r - k) return;
    Check check{"constraint", {"number"}, {}};
    check.decision.evidence = "the rank of the constraints is not decided";
    if (rank.rank) {
        check.decision.status = ProofStatus::refuted;
        check.decision.evidence =
            fmt::format("{} independent constraints, where {} sections of {} leave {}", *rank.rank, k, r, r - k);
        check.hint = "the sections span what the constraints leave, all of it";
    }
    structure.checks.push_back(std::move(check));
}

void Claims::decide_independence(StructureReport& structure)
{
    const Distribution& distribution = *system_.distribution;
    std::vector<std::string> names = distribution.constraint_texts;
    if (!distribution.has_dependent) {
        names.clear();
        for (const NodeId y : distribution.y) names.push_back(graph_.input_name(y));
    }
    if (names.empty()) return;
    const std::vector<NodeId> rows =
        distribution.has_dependent ? constraint_rows(graph_, system_) : section_rows(graph_, system_);
    std::vector<NodeId> values;
    if (distribution.has_dependent)
        values = substitute(graph_, distribution.constraints,
                            replacements(system_.algebroid.y, std::vector(system_.r(), graph_.constant(0))));
    Check check = independence(graph_, rows, std::move(names), *judge_, values);
    const bool contradict = check.decision.witness && check.decision.witness->value != 0;
    if (check.decision.status == ProofStatus::refuted)
        check.hint = contradict ? "no velocity satisfies all of them there: leave out those that are not meant"
                     : distribution.has_dependent
                         ? "leave out the constraints that the others contain"
                         : "sections are independent at every point of the domain, as many as D has dimensions";
    if (check.decision.witness && !contradict)
        check.decision.witness->point =
            concerned(graph_, setting_, input_names(graph_, rows), check.decision.witness->point);
    structure.checks.push_back(std::move(check));
}

void Claims::decide_distribution(Report& report)
{
    if (!system_.distribution) return;
    decide_independence(report.structure);
    decide_constraints(report.structure);
    const auto is_refuted = [&](const char* name) {
        return std::ranges::any_of(report.structure.checks, [name](const Check& check) {
            return check.name == name && check.decision.status == ProofStatus::refuted;
        });
    };
    if (is_refuted("independent")) return;
    std::vector<NodeId> forms;
    if (!is_refuted("constraint")) forms = constraint_rows(graph_, system_);
    report.mechanics.integrable = decide_integrability(graph_, system_, setting_, judge_->decider().budget(), forms);
    report.mechanics.integrable->has_drift = !system_.distribution->drift.empty();
    if (!lagrangian_) return;
    const MomentumBalance balance = lagrange_balance(graph_, system_, *lagrangian_);
    const NodeId rate = moving_energy_rate(graph_, system_, *lagrangian_->constrained, balance);
    const bool has_drift = lagrangian_->constrained->hull.has_drift();
    report.mechanics.conserved = {has_drift ? "moving_energy" : "energy", judge_->decider().status(rate)};
}

/// Where what the constraints were solved by may vanish: the sections are not defined there.
void Claims::add_singular_minor(Regularity& regularity)
{
    const std::optional<NodeId> minor = system_.distribution->minor;
    if (!minor || judge_->decider().proves_nonzero(*minor)) return;
    if (regularity.kind == Regularity::Kind::regular) regularity.kind = Regularity::Kind::generically_regular;
    regularity.positive_definite = false;
    ProofSetting setting = setting_;
    setting.defined.clear();
    const auto list = [&](std::vector<NamedPoint> points) {
        std::ranges::move(points, std::back_inserter(regularity.singular_at));
    };
    const ProofBudget& budget = judge_->decider().budget();
    for (const SliceValue& value : {SliceValue{graph_.constant(0), Rational(0)}, quarter_turn(graph_)})
        list(singular_points(graph_, setting, budget, {*minor}, value));
    list(singular_parameters(graph_, setting, budget, {*minor}));
    const ZeroDecider bare(graph_, setting, judge_->decider().budget());
    for (std::string& factor : singular_factors(graph_, setting, bare, system_.parameter_values, {*minor}))
        regularity.singular_where.push_back(std::move(factor));
}

} // namespace lagen
