// SPDX-License-Identifier: GPL-2.0-or-later
/// A zero decision from texts: names, constraints, domain, residual.
#pragma once

#include "expression/parse.hpp"
#include "graph/core/lower.hpp"
#include "proof/decide.hpp"

#include <memory>

namespace lagen::test {

/// What a test states about a model; every entry is a text of the expression language.
struct Statement {
    std::vector<std::string> variables;
    std::vector<std::string> parameters;
    std::vector<std::string> constraints;
    std::vector<std::string> domain;
    std::vector<std::string> defined;
};

/// The graph and the decider of a statement. Names are declared in the order of the statement.
class Problem {
  public:
    explicit Problem(const Statement& statement, ProofBudget budget = {})
    {
        ProofSetting setting;
        for (const auto& name : statement.parameters) setting.parameters.push_back(graph.input(name));
        for (const auto& name : statement.variables) setting.variables.push_back(graph.input(name));
        for (const auto& text : statement.constraints) setting.constraints.push_back(node(text));
        for (const auto& text : statement.defined) setting.defined.push_back(node(text));
        for (const auto& text : statement.domain)
            setting.domain.push_back(Lowering(graph)(parse_comparison(whole_text("<domain>", text))));
        decider = std::make_unique<ZeroDecider>(graph, setting, budget);
    }

    NodeId node(const std::string& text) { return Lowering(graph)(parse_expression(whole_text("<test>", text))); }
    Decision decide(const std::string& text) { return decider->decide(node(text)); }

    Graph graph;
    std::unique_ptr<ZeroDecider> decider;
};

/// "x=1 y=3/5"
inline std::string point_text(const Decision& decision)
{
    std::string text;
    if (!decision.witness) return text;
    for (const auto& [name, value] : decision.witness->point)
        text += (text.empty() ? "" : " ") + name + '=' + to_text(value);
    return text;
}

} // namespace lagen::test
