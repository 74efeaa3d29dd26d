// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/statement.hpp"

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

} // namespace lagen
