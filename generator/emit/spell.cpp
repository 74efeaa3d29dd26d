// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/spell.hpp"

#include "graph/core/operators.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace lagen {

namespace {

std::string list_of(const std::vector<Expression>& expressions)
{
    return comma_list(expressions, [](const Expression& each) { return spell(each).text; });
}

std::string enclose(const Spelling& spelling, int precedence)
{
    return spelling.precedence >= precedence ? spelling.text : "(" + spelling.text + ")";
}

/// In parentheses unless it binds at least as tightly as `precedence`.
std::string at_least(int precedence, const Expression& expression)
{
    return enclose(spell(expression), precedence);
}

bool is_comparison(Op op)
{
    return kind_of(op) == OpKind::comparison;
}

/// Written by `select`, so that its type is the scalar's.
bool is_choice(Op op)
{
    return op == Op::select || op == Op::sign || op == Op::minimum || op == Op::maximum || is_comparison(op);
}

/// A call of a function that has the name that the operator table gives it.
bool is_plain_function(Op op)
{
    return kind_of(op) == OpKind::function && !is_choice(op) && op != Op::stumpff;
}

/// b * b * .. * b, at most four factors; the fourth power is the square of the square. Longer chains are statements of
/// their own; the base has a name.
Spelling spell_power(const Expression& power)
{
    const auto exponent = static_cast<std::int32_t>(power.payload);
    const std::string base = at_least(5, power.operands[0]);
    Spelling result{base, 5};
    if (const int count = std::abs(exponent); count == 4)
        result = {fmt::format("({0} * {0}) * ({0} * {0})", base), 2};
    else
        for (int k = 1; k < count; ++k) result = {result.text + " * " + base, 2};
    if (exponent > 0) return result;
    return {"S(1) / " + enclose(result, 3), 2};
}

/// The spelling of -x where a sign stands in front of it already, and nothing otherwise.
std::optional<Spelling> negated(const Expression& x)
{
    if (x.op == Op::constant && x.value < 0) return print_literal(-x.value);
    if (x.op == Op::negate) return spell(x.operands[0]);
    if (x.op != Op::multiply && x.op != Op::divide) return std::nullopt;
    const Expression& a = x.operands[0];
    const Expression& b = x.operands[1];
    const char* sign = x.op == Op::multiply ? " * " : " / ";
    if (const auto minus = negated(a)) return Spelling{enclose(*minus, 2) + sign + at_least(3, b), 2};
    if (const auto minus = negated(b)) return Spelling{at_least(2, a) + sign + enclose(*minus, 3), 2};
    return std::nullopt;
}

/// With signs drawn out, so that "+ -" never stands in the text; -a + b is b - a, bit for bit.
Spelling spell_sum(const Expression& sum)
{
    if (sum.op == Op::negate) return {"-" + at_least(2, sum.operands[0]), 1};
    const Expression& a = sum.operands[0];
    const Expression& b = sum.operands[1];
    const bool add = sum.op == Op::add;
    if (const auto minus = negated(b)) return {at_least(1, a) + (add ? " - " : " + ") + enclose(*minus, 2), 1};
    if (const auto minus = add ? negated(a) : std::nullopt) return {at_least(1, b) + " - " + enclose(*minus, 2), 1};
    return {at_least(1, a) + (add ? " + " : " - ") + at_least(2, b), 1};
}

/// A mask: the comparison itself, or "is not zero".
std::string condition(const Expression& expression)
{
    if (!is_comparison(expression.op)) return at_least(1, expression) + " != S(0)";
    return fmt::format("{} {} {}", at_least(1, expression.operands[0]), operator_of(expression.op).spelling,
                       at_least(1, expression.operands[1]));
}

/// Makes a value of `type` of an expression; no type but S is made of a number by its own name.
std::string made(const std::string& type, const std::string& value)
{
    return fmt::format("{}({})", type == "S" ? "S" : "columns<S>", value);
}

/// S(..): a scalar with expression templates has another type for every sum.
Spelling spell_choice(const Expression& choice)
{
    const auto value = [&](std::size_t k) {
        const Expression& operand = choice.operands[k];
        const Spelling spelling = spell(operand);
        const bool number = operand.op == Op::pi ||
                            (operand.op == Op::constant && spelling.precedence == 5 && spelling.text.front() != '(');
        const bool plain = operand.is_variable() || is_choice(operand.op) || (number && choice.name == "S");
        return plain ? spelling.text : made(choice.name, spelling.text);
    };
    return {fmt::format("select({}, {}, {})", condition(choice.operands[0]), value(1), value(2)), 5};
}

Spelling spell_function(const Expression& call)
{
    if (call.op == Op::minimum || call.op == Op::maximum)
        return {fmt::format("select({0} {2} {1}, {0}, {1})", at_least(1, call.operands[0]),
                            at_least(1, call.operands[1]), call.op == Op::minimum ? '<' : '>'),
                5};
    if (call.op == Op::sign)
        return {fmt::format("select({0} > S(0), S(1), select({0} < S(0), S(-1), S(0)))", at_least(1, call.operands[0])),
                5};
    if (call.op == Op::stumpff)
        return {fmt::format("stumpff<{}, S>({})", call.payload, spell(call.operands[0]).text), 5};
    return {fmt::format("{}({})", operator_of(call.op).spelling, list_of(call.operands)), 5};
}

std::string spell_check(const Statement& check)
{
    std::string failure = at_least(1, check.expressions[0]);
    if (check.expressions.size() == 1)
        failure += " == S(0)";
    else
        failure += fmt::format(" <= singular_tolerance<S>({}) * {}", check.index, at_least(3, check.expressions[1]));
    return fmt::format("StatusOf<S>::fail(status, {}, Status::singular_mass_matrix);", failure);
}

std::vector<std::string> spell_factor(const Statement& factor)
{
    const std::string call = fmt::format("{}.factor({{{}}})", factor.names[0], list_of(factor.expressions));
    return {fmt::format("PivotedLu<S, {}> {};", factor.index, factor.names[0]),
            factor.checked ? fmt::format("StatusOf<S>::fail(status, {}, Status::singular_mass_matrix);", call)
                           : fmt::format("static_cast<void>({});", call)};
}

/// A right-hand side of another type is linear in what it varies with: a number in it is zero.
std::string spell_solve(const Statement& solve)
{
    if (solve.type == "S")
        return fmt::format("const std::array<S, {}> {} = {}.solve({{{}}});", solve.expressions.size(), solve.names[0],
                           solve.names[1], list_of(solve.expressions));
    std::vector<std::string> right;
    for (const Expression& each : solve.expressions)
        right.push_back(each.op == Op::constant ? made(solve.type, spell(each).text) : spell(each).text);
    return fmt::format("const auto {} = {}.solve(std::array<{}, {}>{{{}}});", solve.names[0], solve.names[1],
                       solve.type, right.size(), fmt::join(right, ", "));
}

} // namespace

Spelling spell(const Expression& expression)
{
    switch (kind_of(expression.op)) {
    case OpKind::leaf:
        if (expression.op == Op::constant) return print_literal(expression.value);
        if (expression.op == Op::pi) return print_pi();
        if (!expression.operands.empty())
            return {fmt::format("{}({})", expression.name, list_of(expression.operands)), 5};
        return {expression.entry ? fmt::format("{}[{}]", expression.name, *expression.entry) : expression.name, 5};
    case OpKind::sum: return spell_sum(expression);
    case OpKind::product: return {at_least(2, expression.operands[0]) + " * " + at_least(3, expression.operands[1]), 2};
    case OpKind::quotient:
        return {at_least(2, expression.operands[0]) + " / " + at_least(3, expression.operands[1]), 2};
    case OpKind::power: return spell_power(expression);
    case OpKind::comparison: return {fmt::format("select({}, S(1), S(0))", condition(expression)), 5};
    case OpKind::choice: return spell_choice(expression);
    case OpKind::function: return spell_function(expression);
    case OpKind::system: break;
    }
    throw InternalError("linear algebra inside an expression");
}

std::vector<std::string> spell(const Statement& statement)
{
    using Kind = Statement::Kind;
    const auto& names = statement.names;
    const auto argument = [&] { return spell(statement.expressions[0]).text; };
    const auto call = [&](const char* function) {
        return fmt::format("{}<S, {}>({{{}}})", function, statement.expressions.size(), list_of(statement.expressions));
    };
    switch (statement.kind) {
    case Kind::define: return {fmt::format("const {} {} = {};", statement.type, names[0], argument())};
    case Kind::angles:
        return {fmt::format("const auto [{}, {}] = {};", names[0], names[1],
                            statement.expressions.size() > 1 ? call("sincos") : "sincos<S>(" + argument() + ")")};
    case Kind::roots: return {fmt::format("const auto {} = {};", names[0], call("square_roots"))};
    case Kind::reciprocals: return {fmt::format("const auto {} = {};", names[0], call("reciprocals"))};
    case Kind::terms: {
        std::vector<std::string> lines{fmt::format("const auto {} = {};", names[0], argument())};
        if (names.size() > 1) lines.push_back(fmt::format("const auto {} = {}.lanes();", names[1], names[0]));
        return lines;
    }
    case Kind::stumpff:
        return {fmt::format("const auto {} = stumpff_orders<{}, {}, S>({});", names[0], statement.index, statement.last,
                            argument())};
    case Kind::factor: return spell_factor(statement);
    case Kind::solve: return {spell_solve(statement)};
    case Kind::check: return {spell_check(statement)};
    case Kind::keep: return {fmt::format("work[{}] = {};", statement.index, argument())};
    case Kind::recall: return {fmt::format("const {} {} = work[{}];", statement.type, names[0], statement.index)};
    case Kind::load:
    case Kind::store: break;
    }
    throw InternalError("a load or a store outside of a function");
}

/// The square root of the runtime sets no errno, see runtime/include/lagen/roots.hpp.
std::vector<std::string> using_declarations(const Body& body)
{
    std::set<std::string> functions;
    for (const Op op : operators_in(body))
        if (is_plain_function(op)) functions.insert(operator_of(op).spelling);
    std::vector<std::string> declarations;
    for (const std::string& function : functions)
        declarations.push_back(fmt::format("using {}::{};", function == "sqrt" ? "arithmetic" : "std", function));
    return declarations;
}

std::set<std::string> includes_of(const Body& body)
{
    using Kind = Statement::Kind;
    const std::set<Op> operators = operators_in(body);
    std::set<std::string> includes;
    const auto compares = [](const Statement& each) {
        return each.kind == Kind::check && each.expressions.size() == 2;
    };
    const bool of_terms =
        std::ranges::any_of(body.parts, [&](const BodyPart& part) { return std::ranges::any_of(part, compares); });
    if (of_terms || contains(body, Kind::factor)) includes.insert("lagen/linear.hpp");
    if (operators.contains(Op::sqrt) || contains(body, Kind::roots) || contains(body, Kind::reciprocals))
        includes.insert("lagen/roots.hpp");
    if (contains(body, Kind::terms)) includes.insert("lagen/lanes/terms.hpp");
    if (contains(body, Kind::angles)) includes.insert("lagen/sincos.hpp");
    if (operators.contains(Op::stumpff) || contains(body, Kind::stumpff)) includes.insert("lagen/stumpff.hpp");
    return includes;
}

} // namespace lagen
