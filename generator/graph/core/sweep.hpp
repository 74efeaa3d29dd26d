// SPDX-License-Identifier: GPL-2.0-or-later
/// The one walk that gives nodes values, in any field. A field is an arithmetic of linear_algebra.hpp that also has
///   bool leaf(graph, id, value)                     the value of a constant, pi or an input,
///   bool operation(op, payload, operands, value)    that of an operation;
/// both answer false where there is none, and the walk ends.
#pragma once

#include "expression/linear_algebra.hpp"
#include "graph/core/operators.hpp"

#include <map>

namespace lagen {

template <class Field>
class Sweep {
  public:
    using Number = typename Field::Number;

    Sweep(const Graph& graph, Field field) : graph_(graph), field_(std::move(field)) {}

    /// Gives all `nodes`, ascending and complete, their values; false where one has none.
    bool visit(std::span<const NodeId> nodes)
    {
        values_.resize(nodes.empty() ? 0 : std::size_t{nodes.back()} + 1);
        for (const NodeId id : nodes)
            if (!visit(id)) return false;
        return true;
    }

    [[nodiscard]] const Number& value(NodeId id) const { return values_[id]; }
    [[nodiscard]] std::vector<Number> values() && { return std::move(values_); }

  private:
    bool visit(NodeId id)
    {
        const Op op = graph_.op(id);
        switch (kind_of(op)) {
        case OpKind::leaf: return field_.leaf(graph_, id, values_[id]);
        case OpKind::system: return visit_system(id);
        case OpKind::sum:
        case OpKind::product:
        case OpKind::quotient:
        case OpKind::power:
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice: break;
        }
        gather(graph_.operands(id));
        return field_.operation(op, graph_.payload(id), operands_.data(), values_[id]);
    }

    bool visit_system(NodeId id)
    {
        const auto operands = graph_.operands(id);
        if (graph_.op(id) == Op::component) {
            values_[id] = solutions_.at(operands[0])[graph_.payload(id)];
            return true;
        }
        if (graph_.op(id) == Op::factor) {
            gather(operands);
            const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(operands.size()))));
            return factors_.emplace(id, factorise(operands_, n, field_)).second;
        }
        gather(operands.subspan(1));
        return !solutions_.emplace(id, substitute(factors_.at(operands[0]), operands_, field_)).first->second.empty();
    }

    void gather(std::span<const NodeId> operands)
    {
        operands_.clear();
        for (const NodeId operand : operands) operands_.push_back(values_[operand]);
    }

    const Graph& graph_;
    Field field_;
    std::vector<Number> values_; ///< by node
    std::vector<Number> operands_;
    std::map<NodeId, Factorisation<Number>> factors_;
    std::map<NodeId, std::vector<Number>> solutions_;
};

/// The value of an input by its name.
template <class Number>
[[nodiscard]] const Number& input_value(const Graph& graph, NodeId id, const std::map<std::string, Number>& inputs)
{
    const auto found = inputs.find(graph.input_name(id));
    if (found == inputs.end())
        throw InternalError("the interpreter has no value for the input " + graph.input_name(id));
    return found->second;
}

} // namespace lagen
