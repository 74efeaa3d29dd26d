// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/arrow_decider.hpp"

#include "geometry/cayley.hpp"
#include "geometry/generator_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "verify/judge.hpp"

#include <algorithm>

namespace lagen {
namespace {

void append(std::vector<NodeId>& list, const std::vector<NodeId>& more)
{
    list.insert(list.end(), more.begin(), more.end());
}

} // namespace

ProofSetting arrow_setting(Graph& graph, const System& system, const std::vector<std::vector<NodeId>>& points)
{
    ProofSetting setting;
    setting.parameters = system.parameters;
    for (const std::vector<NodeId>& point : points) {
        const Replacements there = replacements(system.algebroid.x, point);
        append(setting.variables, point);
        append(setting.constraints, substitute(graph, system.functions.constraints, there));
        append(setting.domain, substitute(graph, system.domain, there));
    }
    return setting;
}

void append_step(ProofSetting& setting, const System& system)
{
    const NodeId step = system.discrete->step;
    if (system.graph.op(step) == Op::input && std::ranges::find(setting.parameters, step) == setting.parameters.end())
        setting.parameters.push_back(step);
}

std::vector<NodeId> primed(Graph& graph, const std::vector<NodeId>& inputs)
{
    std::vector<NodeId> out;
    for (const NodeId input : inputs) out.push_back(graph.input(graph.input_name(input) + "'"));
    return out;
}

ArrowDecider::ArrowDecider(Graph& graph, ProofSetting setting, const Groupoid& groupoid,
                           std::vector<std::vector<NodeId>> elements, const ProofBudget& budget)
    : graph_(graph), setting_(std::move(setting)), groupoid_(groupoid), elements_(std::move(elements)), budget_(budget)
{
}

Decision ArrowDecider::decide(NodeId residual)
{
    Decision free = on_matrices(residual);
    if (free.status == ProofStatus::proved) return free;
    bool of_group = false;
    for (const std::vector<NodeId>& W : elements_) of_group = of_group || depends_on_any(graph_, {&residual, 1}, W);
    if (!of_group) return free;
    if (has_chart(groupoid_))
        if (Decision charted = on_group(residual); charted.status != ProofStatus::undecided) return charted;
    Decision open;
    open.residual = free.residual;
    open.evidence =
        "it does not hold, or is not shown, for all matrices; of those of the group alone it is not decided";
    return open;
}

Decision ArrowDecider::on_matrices(NodeId residual) const
{
    ProofSetting setting = setting_;
    for (const std::vector<NodeId>& W : elements_) append(setting.variables, W);
    Decision decision = ZeroDecider(graph_, setting, budget_).decide(residual);
    show_concerned(graph_, setting, residual, decision);
    return decision;
}

Decision ArrowDecider::on_group(NodeId residual)
{
    if (charted_.empty()) {
        std::string prime;
        for (const std::vector<NodeId>& W : elements_) {
            const GroupChart chart = group_chart(graph_, groupoid_, W, "s" + prime);
            charted_.insert(charted_.end(), chart.element.begin(), chart.element.end());
            append(chart_variables_, chart.s);
            prime += "'";
        }
    }
    ProofSetting setting = setting_;
    append(setting.variables, chart_variables_);
    const NodeId charted = substitute(graph_, {&residual, 1}, charted_)[0];
    Decision decision = ZeroDecider(graph_, setting, budget_).decide(charted);
    show_concerned(graph_, setting, charted, decision);
    std::string text = "W = cay(s(c) E_c)";
    if (elements_.size() > 1) text += ", W' = cay(s'(c) E_c)";
    text += " with the generators E_c of the group";
    decision.evidence += decision.evidence.empty() ? text : "; " + text;
    return decision;
}

Decision decide_on_arrows(Graph& graph, const System& system, NodeId residual, const ProofBudget& budget)
{
    const Groupoid& groupoid = *system.groupoid;
    std::vector<std::vector<NodeId>> points{groupoid.arrow.x};
    if (!groupoid.arrow.next.empty()) points.push_back(groupoid.arrow.next);
    ProofSetting setting = arrow_setting(graph, system, points);
    if (depends_on_any(graph, {&residual, 1}, {&system.time, 1})) setting.variables.push_back(system.time);
    append_step(setting, system);
    const NodeId step = system.discrete->step;
    if (graph.op(step) == Op::input) setting.domain.push_back(graph.apply(Op::greater, step, graph.constant(0)));
    std::vector<std::vector<NodeId>> elements;
    if (const auto& logarithm = system.discrete->logarithm) {
        residual = substitute(graph, {&residual, 1}, replacements(groupoid.arrow.W, logarithm->element))[0];
        append(setting.variables, system.discrete->inner);
    } else if (!groupoid.arrow.W.empty()) {
        elements.push_back(groupoid.arrow.W);
    }
    return ArrowDecider(graph, setting, groupoid, elements, budget).decide(residual);
}

bool has_chart(const Groupoid& groupoid)
{
    return groupoid.has_cayley_map && groupoid.size <= most_chart_rows;
}

GroupChart group_chart(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& W, const std::string& name)
{
    GroupChart chart;
    for (std::size_t c = 0; c < groupoid.generators.size(); ++c)
        chart.s.push_back(graph.input(name + "(" + std::to_string(c + 1) + ")"));
    chart.element = replacements(W, cayley(graph, GeneratorSpan(graph, groupoid).matrix(chart.s), groupoid.size));
    return chart;
}

} // namespace lagen
