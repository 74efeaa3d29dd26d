// SPDX-License-Identifier: GPL-2.0-or-later
/// Claims about what the steps of a discrete Lagrangian keep: f(t + h, t(g), F^+L(g)) = f(t, s(g), F^-L(g)) for every
/// arrow g.
#include "graph/calculus/differentiate.hpp"
#include "mechanics/discrete.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

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

} // namespace lagen
