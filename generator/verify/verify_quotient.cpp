// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/verify_quotient.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/transplant.hpp"
#include "mechanics/routh.hpp"
#include "mechanics/symmetry.hpp"
#include "text/activity.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lagen {

namespace {

/// W ydot - f of the reduced system, over inputs of `graph` that have the same names.
std::vector<NodeId> reduced_residuals(Graph& graph, const System& reduced, const Quotient& quotient,
                                      const std::vector<NodeId>& x, const std::vector<NodeId>& u,
                                      const std::vector<NodeId>& rates)
{
    Graph own = reduced.graph;
    const LagrangianNodes lagrangian = lagrangian_nodes(own, reduced);
    const LagrangeRates motion = lagrange_rates(own, reduced, lagrangian, lagrange_balance(own, reduced, lagrangian));
    const std::size_t r = reduced.r();
    std::map<NodeId, NodeId> inputs;
    for (std::size_t j = 0; j < x.size(); ++j) {
        inputs[reduced.algebroid.x[j]] = x[j];
        inputs[reduced.algebroid.y[j]] = u[j];
    }
    for (std::size_t b = 0; b < quotient.w.size(); ++b) inputs[reduced.algebroid.y[x.size() + b]] = quotient.w[b];
    const std::vector<NodeId> W = transplant(graph, own, lagrangian.fibre.hessian, inputs);
    std::vector<NodeId> out = transplant(graph, own, motion.force, inputs);
    for (std::size_t a = 0; a < r; ++a) {
        out[a] = graph.negate(out[a]);
        for (std::size_t b = 0; b < r; ++b) out[a] = graph.add(out[a], graph.multiply(W[a * r + b], rates[b]));
    }
    return out;
}

} // namespace

StructureReport verify_right_action(const System& moving, const ProofBudget& budget)
{
    StructureReport report = verify(moving).structure;
    std::string hint; // where it is a left action
    for (const Check& check : report.checks)
        if (check.name == "action" && hint.empty()) hint = check.hint;
    std::erase_if(report.checks, [](const Check& check) { return check.name == "action"; });
    Graph graph = moving.graph;
    const Groupoid& groupoid = *moving.groupoid;
    const std::vector<NodeId>& x = moving.algebroid.x;
    const std::vector<NodeId> coordinates = groupoid.coordinates();
    const std::vector<NodeId> moved = target(graph, groupoid, groupoid.arrow);
    ArrowDecider decider(graph, arrow_setting(graph, moving, {x}), groupoid, {groupoid.arrow.W}, budget);
    counted("generators of the action", moving.r(), [&](std::size_t b) {
        Replacements field;
        for (const ColumnEntry& entry : groupoid.left[b]) field.emplace_back(coordinates[entry.index], entry.value);
        const std::vector<NodeId> rates = directional(graph, moved, field);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const NodeId xi = Algebroid::entry(graph, moving.algebroid.anchor[b], i);
            const NodeId residual = graph.subtract(rates[i], substitute(graph, {&xi, 1}, replacements(x, moved))[0]);
            report.append(graph, "action", {graph.input_name(moving.algebroid.y[b]), graph.input_name(x[i])}, residual,
                          decider);
            if (!graph.is_zero(residual) && report.checks.back().decision.status != ProofStatus::proved)
                report.checks.back().hint = std::exchange(hint, {});
        }
    });
    report.verdict = verdict_of(report);
    return report;
}

bool is_invariant(Graph& graph, const System& whole, const InfinitesimalAction& action, NodeId f,
                  const ProofBudget& budget)
{
    Judge judge(graph, proof_setting(graph, whole), budget);
    return std::ranges::all_of(action.fields, [&](const std::vector<NodeId>& X) {
        const NodeId rate = lift_of_function(graph, whole, f, X);
        return graph.is_zero(rate) || judge.decide(rate).status == ProofStatus::proved;
    });
}

bool is_invariant_set(Graph& graph, const System& whole, const InfinitesimalAction& action, NodeId f,
                      const ProofBudget& budget)
{
    Judge judge(graph, proof_setting(graph, whole), budget);
    const auto is_zero = [&](NodeId node) {
        return graph.is_zero(node) || judge.decide(node).status == ProofStatus::proved;
    };
    return std::ranges::all_of(action.fields, [&](const std::vector<NodeId>& X) {
        const NodeId rate = lift_of_function(graph, whole, f, X);
        return is_zero(rate) || std::ranges::all_of(gradient(graph, graph.divide(rate, f), whole.algebroid.x), is_zero);
    });
}

StructureReport verify_symmetry(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                const std::vector<std::string>& names, const ProofBudget& budget)
{
    StructureReport report;
    Judge judge(graph, proof_setting(graph, whole), budget);
    counted("symmetries of L", action.fields.size(), [&](std::size_t b) {
        Decision decision = judge.decide(lift_of_function(graph, whole, *whole.lagrangian, action.fields[b]));
        report.checks.push_back({"symmetry", {names[b]}, std::move(decision)});
    });
    report.verdict = verdict_of(report);
    return report;
}

StructureReport verify_quotient(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                const Quotient& quotient, const System& reduced, const ProofBudget& budget)
{
    StructureReport report;
    const auto name_of = [&](std::size_t a) { return reduced.graph.input_name(reduced.algebroid.y[a]); };
    std::vector<NodeId> x, u, rates;
    for (const std::size_t i : quotient.free) {
        x.push_back(whole.algebroid.x[i]);
        u.push_back(whole.algebroid.y[i]);
    }
    for (std::size_t a = 0; a < reduced.r(); ++a) rates.push_back(graph.input(fmt::format("rate of {}", name_of(a))));
    const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(u.size());
    const std::vector<NodeId> xddot =
        accelerations(graph, whole, action, quotient, {rates.begin(), middle}, {middle, rates.end()});

    // Lagrange's expressions of the whole at free accelerations, then on the slice.
    std::vector<NodeId> free_rates;
    std::vector<std::size_t> all(whole.n());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const std::size_t i : all) free_rates.push_back(graph.input(fmt::format("rate number {}", i)));
    std::vector<NodeId> expressions = euler_lagrange(graph, whole, *whole.lagrangian, all, free_rates);
    Replacements there = quotient.on_slice(whole);
    for (const std::size_t i : all) {
        there.emplace_back(whole.algebroid.y[i], quotient.velocity[i]);
        there.emplace_back(free_rates[i], xddot[i]);
    }
    expressions = substitute(graph, expressions, there);
    const std::vector<NodeId> wanted = reduced_residuals(graph, reduced, quotient, x, u, rates);

    ProofSetting setting = proof_setting(graph, whole);
    setting.variables.insert(setting.variables.end(), rates.begin(), rates.end());
    setting.variables.insert(setting.variables.end(), quotient.w.begin(), quotient.w.end());
    setting.defined.push_back(graph.divide(graph.constant(1), quotient.determinant));
    Judge judge(graph, setting, budget);
    counted("equations of the quotient", reduced.r(), [&](std::size_t a) {
        NodeId sum = graph.negate(wanted[a]);
        if (a < u.size())
            sum = graph.add(sum, expressions[quotient.free[a]]);
        else
            for (const std::size_t i : all)
                sum = graph.add(sum, graph.multiply(quotient.xi[a - u.size()][i], expressions[i]));
        report.checks.push_back({"projects", {name_of(a)}, judge.decide(sum)});
    });
    report.verdict = verdict_of(report);
    return report;
}

} // namespace lagen
