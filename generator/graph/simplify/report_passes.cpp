// SPDX-License-Identifier: GPL-2.0-or-later
/// What `simplify` did, as a text: operations before and after every pass, and the terms that cost most.
#include "graph/core/operators.hpp"
#include "graph/core/schedule.hpp"
#include "graph/simplify/simplify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace lagen {
namespace {

constexpr std::size_t longest_term = 90;

std::string counts(const OperationCount& count)
{
    return fmt::format("{:>6} {:>6} {:>6} {:>9} {:>6} {:>8.0f}", count.additions, count.multiplications,
                       count.divisions, count.functions, count.solves, count.weight);
}

std::string row(const std::string& text, const OperationCount& count)
{
    return fmt::format("  {:<60} {}\n", text, counts(count));
}

} // namespace

std::vector<CostlyTerm> costliest_terms(const Graph& graph, std::span<const NodeId> outputs, std::size_t count)
{
    const Schedule plan = schedule(graph, outputs);
    std::vector<bool> named(graph.size(), false);
    for (const NodeId id : plan.temporaries) named[id] = true;
    for (const NodeId id : outputs) named[id] = true;
    std::vector<double> weights(graph.size(), 0); // with the unnamed operands
    std::vector<CostlyTerm> terms;
    std::vector<NodeId> nodes;
    for (const NodeId id : reachable(graph, outputs)) {
        weights[id] = operation_weight(graph, id);
        for (const NodeId operand : graph.operands(id))
            if (!named[operand]) weights[id] += weights[operand];
        if (named[id] && weights[id] > 0) nodes.push_back(id);
    }
    std::ranges::stable_sort(nodes, std::greater<>(), [&](NodeId id) { return weights[id]; });
    if (nodes.size() > count) nodes.resize(count);
    for (const NodeId id : nodes) terms.push_back({to_text(graph, id, longest_term), weights[id], plan.uses[id]});
    return terms;
}

const char* to_text(Stage stage)
{
    switch (stage) {
    case Stage::pass: return "one pass";
    case Stage::lightest: return "the lightest form that keeps its digits";
    case Stage::mixed: return "outputs of several forms";
    case Stage::eliminated: return "solved through the terms of a Hessian";
    }
    return "";
}

std::string to_text(const SimplifyReport& report, const std::string& kernel)
{
    std::string text = fmt::format("{}\n  {:<60} {:>6} {:>6} {:>6} {:>9} {:>6} {:>8}\n", kernel, "", "+ -", "*", "/",
                                   "functions", "solves", "weight");
    text += row("as written", report.written);
    std::string form;
    for (const PassReport& pass : report.passes) {
        if (pass.form != form && pass.stage == Stage::pass) text += row(pass.form, pass.before);
        form = pass.form;
        text += row(pass.stage != Stage::pass ? pass.form : "  " + pass.pass, pass.after);
    }
    text += row("kept", report.kept);
    if (!report.costliest.empty()) text += "  costliest terms: weight, uses, term\n";
    for (const CostlyTerm& term : report.costliest)
        text += fmt::format("  {:>8.0f} {:>5}  {}\n", term.weight, term.uses, term.text);
    return text;
}

} // namespace lagen
