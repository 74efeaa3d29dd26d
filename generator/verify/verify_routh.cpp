// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/verify_routh.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/transplant.hpp"
#include "graph/core/lower.hpp"
#include "text/activity.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"
#include "verify/singular_set.hpp"
#include "verify/where_constant.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

/// The Lagrangian of `from` over the inputs of the same names of `graph`.
NodeId moved_lagrangian(Graph& graph, const System& from)
{
    std::map<NodeId, NodeId> inputs;
    for (const auto* nodes : {&from.parameters, &from.algebroid.x, &from.algebroid.y})
        for (const NodeId node : *nodes) inputs[node] = graph.input(from.graph.input_name(node));
    inputs[from.time] = graph.input(from.graph.input_name(from.time));
    const NodeId only[] = {*from.lagrangian};
    return transplant(graph, from.graph, only, inputs)[0];
}

/// The first of `factors` that is proved to vanish for the parameter values of the file, or null.
Tree factor_that_vanishes(Graph& graph, const System& system, const ProofSetting& setting,
                          const std::vector<Tree>& factors, const ProofBudget& budget)
{
    const auto there = at_values(graph, std::vector<NodeId>(), setting, budget, system.parameter_values);
    for (const Tree& factor : factors) {
        const NodeId node[] = {Lowering(graph)(factor)};
        const auto value = substitute_where_defined(graph, node, system.parameter_values);
        if (!value) continue;
        if (graph.is_zero((*value)[0]) || (there && there->decider->status((*value)[0]) == ProofStatus::proved))
            return factor;
    }
    return nullptr;
}

} // namespace

std::vector<Tree> singular_factors_of_momenta(Graph& graph, const System& system, const Routhian& routhian,
                                              const ProofBudget& budget)
{
    ProofSetting setting = proof_setting(graph, system);
    setting.defined.clear(); // that L is written with 1/x is no reason to leave x != 0 out
    const ZeroDecider decider(graph, setting, budget);
    const NodeId determinant = routhian.determinant;
    if (decider.status(determinant) == ProofStatus::proved) throw SingularMomenta(system.name);
    const std::vector<Tree> factors = factors_of(graph, determinant, writing_order(graph, setting), decider)
                                          .value_or(std::vector{to_tree(graph, determinant)});
    if (const Tree zero = factor_that_vanishes(graph, system, setting, factors, budget))
        throw MathematicsError(fmt::format("the momenta of the cyclic coordinates of model '{}' do not determine their "
                                           "velocities for the parameter values of the file: the factor {} of "
                                           "det d2L/dy2 is 0 in them",
                                           system.name, to_text(zero)),
                               "--set gives a parameter another value");
    std::vector<Tree> open;
    std::set<std::string> seen;
    for (const Tree& factor : factors)
        if (!decider.proves_nonzero(Lowering(graph)(factor)) && seen.insert(to_text(factor)).second)
            open.push_back(factor);
    return open;
}

StructureReport verify_routh(Graph& graph, const System& system, const Routhian& routhian, const System& reduced,
                             const StructureReport& cyclic, const std::vector<std::string>& where,
                             const ProofBudget& budget)
{
    StructureReport report;
    const auto name_of = [&](NodeId node) { return graph.input_name(node); };
    for (const Check& check : cyclic.checks)
        for (const std::size_t k : routhian.cyclic)
            if (check.indices[0] == name_of(system.algebroid.x[k])) report.checks.push_back(check);

    std::vector<NodeId> ydot;
    std::vector<std::size_t> rest;
    for (std::size_t a = 0; a < system.r(); ++a) {
        ydot.push_back(graph.input(fmt::format("rate of {}", name_of(system.algebroid.y[a]))));
        if (std::ranges::find(routhian.cyclic, a) == routhian.cyclic.end()) rest.push_back(a);
    }
    ProofSetting setting = proof_setting(graph, system);
    std::vector<NodeId> variables = system.mu;
    variables.insert(variables.end(), ydot.begin(), ydot.end());
    for (const NodeId node : variables)
        if (std::ranges::find(setting.variables, node) == setting.variables.end()) setting.variables.push_back(node);
    setting.defined.insert(setting.defined.end(), routhian.velocities.begin(), routhian.velocities.end());
    Judge judge(graph, setting, budget);
    const auto append = [&](const char* name, NodeId about, NodeId residual) -> Check& {
        return report.checks.emplace_back(Check{name, {name_of(about)}, judge.decide(residual)});
    };
    // The momenta are constant where they do not jump.
    WhereConstant jumps(graph, setting, budget,
                        [&](NodeId f) { return !depends_on_any(graph, std::vector{f}, setting.variables); });
    WhereConstant::Conditions conditions = jumps.of(routhian.momenta);
    if (!conditions.obstacle.empty()) conditions = {}; // the equations are proved all the same
    for (const std::string& each : where)
        if (std::ranges::find(conditions.texts, each) == conditions.texts.end()) conditions.texts.push_back(each);
    const auto append_at_velocities = [&](const char* name, NodeId about, NodeId residual) {
        WhereConstant::restrict(append(name, about, residual), conditions);
    };

    // On the level set: velocities Theta, and the accelerations that follow from them.
    const std::vector<NodeId>& y = routhian.y;
    std::vector<std::pair<NodeId, NodeId>> along{{system.time, graph.constant(1)}};
    const Replacements level = replacements(y, routhian.velocities);
    for (std::size_t i = 0; i < system.n(); ++i) {
        const auto k = std::ranges::find(routhian.cyclic, i);
        along.emplace_back(system.algebroid.x[i],
                           k == routhian.cyclic.end()
                               ? system.algebroid.y[i]
                               : routhian.velocities[static_cast<std::size_t>(k - routhian.cyclic.begin())]);
    }
    for (const std::size_t a : rest) along.emplace_back(system.algebroid.y[a], ydot[a]);
    const std::vector<NodeId> rates = directional(graph, routhian.velocities, along);
    Replacements on_level = level;
    for (std::size_t k = 0; k < y.size(); ++k) on_level.emplace_back(ydot[routhian.cyclic[k]], rates[k]);

    const std::vector<NodeId> forces = system.forces_or_zero(graph);
    const std::vector<NodeId> momenta = substitute(graph, routhian.momenta, level);
    counted("momenta", y.size(), [&](std::size_t k) {
        const NodeId p = system.mu[routhian.cyclic[k]];
        append("conserved", p, forces[routhian.cyclic[k]]);
        append_at_velocities("momentum", p, graph.subtract(momenta[k], p));
    });
    const std::vector<NodeId> whole =
        substitute(graph, euler_lagrange(graph, system, *system.lagrangian, rest, ydot), on_level);
    const std::vector<NodeId> ours = euler_lagrange(graph, system, moved_lagrangian(graph, reduced), rest, ydot);
    counted("equations of the rest", rest.size(), [&](std::size_t j) {
        append_at_velocities("routh", system.algebroid.y[rest[j]], graph.subtract(whole[j], ours[j]));
    });
    report.verdict = verdict_of(report);
    return report;
}

} // namespace lagen
