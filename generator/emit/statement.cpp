// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/statement.hpp"

#include "emit/node_expressions.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>

namespace lagen {

namespace {

void add_operators(const Expression& expression, std::set<Op>& operators)
{
    operators.insert(expression.op);
    for (const Expression& operand : expression.operands) add_operators(operand, operators);
}

} // namespace

Expression variable(std::string name, std::optional<std::size_t> entry)
{
    return {.op = Op::input, .name = std::move(name), .entry = entry};
}

Expression literal(const Rational& value)
{
    return {.op = Op::constant, .value = value};
}

Expression operation(Op op, Expression a)
{
    Expression result{.op = op};
    result.operands.push_back(std::move(a));
    return result;
}

Expression operation(Op op, Expression a, Expression b)
{
    Expression result = operation(op, std::move(a));
    result.operands.push_back(std::move(b));
    return result;
}

bool has_checks(const BodyPart& part)
{
    return std::ranges::any_of(
        part, [](const Statement& each) { return each.kind == Statement::Kind::check || each.checked; });
}

bool has_checks(const Body& body)
{
    return std::ranges::any_of(body.parts, [](const BodyPart& part) { return has_checks(part); });
}

bool contains(const Body& body, Statement::Kind kind)
{
    return std::ranges::any_of(body.parts, [kind](const BodyPart& part) {
        return std::ranges::find(part, kind, &Statement::kind) != part.end();
    });
}

std::set<Op> operators_in(const Body& body)
{
    std::set<Op> operators;
    for (const BodyPart& part : body.parts)
        for (const Statement& statement : part)
            for (const Expression& expression : statement.expressions) add_operators(expression, operators);
    return operators;
}

NodeExpressions::NodeExpressions(const Graph& graph, std::string type)
    : graph_(graph), type_(std::move(type)), names_(graph.size()), latest_(graph.size())
{
    for (NodeId id = 0; id < graph.size(); ++id) {
        latest_[id] = graph.op(id) == Op::input ? id : 0;
        for (const NodeId operand : graph.operands(id)) latest_[id] = std::max(latest_[id], latest_[operand]);
    }
}

Expression NodeExpressions::operator()(NodeId id) const
{
    return has_name(id) ? *names_[id] : operation(id);
}

/// Numbers stand in front, then what depends on the earlier inputs (parameters before coordinates); a product goes on
/// from its left end, without parentheses. Multiplication commutes bit for bit.
bool NodeExpressions::comes_first(NodeId a, NodeId b) const
{
    const auto chain = [&](NodeId id) { return graph_.op(id) == Op::multiply && !has_name(id); };
    if (graph_.is_constant(a) || graph_.is_constant(b)) return graph_.is_constant(a);
    return chain(a) == chain(b) ? latest_[a] <= latest_[b] : chain(a);
}

Expression NodeExpressions::operation(NodeId id) const
{
    const Op op = graph_.op(id);
    if (op == Op::input) throw InternalError("an input without a local name: " + graph_.input_name(id));
    if (kind_of(op) == OpKind::system) throw InternalError("linear algebra inside an expression");
    Expression result{.op = op, .payload = graph_.payload(id)};
    if (op == Op::constant) {
        result.value = graph_.value(id);
        result.payload = 0;
    }
    if (op == Op::select) result.name = type_;
    for (const NodeId operand : graph_.operands(id)) result.operands.push_back((*this)(operand));
    if (op == Op::multiply && !comes_first(graph_.operands(id)[0], graph_.operands(id)[1]))
        std::swap(result.operands[0], result.operands[1]);
    return result;
}

} // namespace lagen
