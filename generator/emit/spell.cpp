// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/spell.hpp"

#include "graph/core/operators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lagen {

namespace {

std::string enclose(const Spelling& spelling, int precedence)
{
    return spelling.precedence >= precedence ? spelling.text : "(" + spelling.text + ")";
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

/// b * b * .. * b, at most four factors; the fourth power is the square of the square.
Spelling repeated(const std::string& base, int count)
{
    if (count == 1) return {base, 5};
    if (count == 2) return {fmt::format("{0} * {0}", base), 2};
    if (count == 3) return {fmt::format("{0} * {0} * {0}", base), 2};
    return {fmt::format("({0} * {0}) * ({0} * {0})", base), 2};
}

} // namespace

Speller::Speller(const Graph& graph) : graph_(graph), names_(graph.size()), latest_(graph.size())
{
    for (NodeId id = 0; id < graph.size(); ++id) {
        latest_[id] = graph.op(id) == Op::input ? id : 0;
        for (const NodeId operand : graph.operands(id)) latest_[id] = std::max(latest_[id], latest_[operand]);
    }
}

std::string Speller::call(const std::string& function)
{
    functions_.insert(function);
    return function;
}

std::string Speller::at_least(int precedence, NodeId id)
{
    return enclose((*this)(id), precedence);
}

Spelling Speller::operator()(NodeId id)
{
    if (has_name(id)) return {names_[id], 5};
    return operation(id);
}

Spelling Speller::operation(NodeId id)
{
    const std::span<const NodeId> operand = graph_.operands(id);
    const Op op = graph_.op(id);
    switch (kind_of(op)) {
    case OpKind::leaf:
        if (op == Op::input) break;
        return op == Op::pi ? print_pi() : print_literal(graph_.value(id));
    case OpKind::sum:
        if (op == Op::negate) return {"-" + at_least(2, operand[0]), 1};
        return op == Op::add ? add(operand[0], operand[1]) : subtract(operand[0], operand[1]);
    case OpKind::product: return multiply(operand[0], operand[1]);
    case OpKind::quotient: return {at_least(2, operand[0]) + " / " + at_least(3, operand[1]), 2};
    case OpKind::power: return power(operand[0], static_cast<std::int32_t>(graph_.payload(id)));
    case OpKind::comparison: return comparison(id);
    case OpKind::choice: return choice(id);
    case OpKind::function: return function(id);
    case OpKind::system: throw InternalError("linear algebra inside an expression");
    }
    throw InternalError("an input without a local name: " + graph_.input_name(id));
}

/// Numbers stand in front, then what depends on the earlier inputs (parameters before coordinates); a product goes on
/// from its left end, without parentheses. Multiplication commutes bit for bit.
Spelling Speller::multiply(NodeId a, NodeId b)
{
    const auto chain = [&](NodeId id) { return graph_.op(id) == Op::multiply && !has_name(id); };
    if (graph_.is_constant(b) && !graph_.is_constant(a))
        std::swap(a, b);
    else if (!graph_.is_constant(a) && (chain(a) == chain(b) ? latest_[b] < latest_[a] : chain(b)))
        std::swap(a, b);
    return {at_least(2, a) + " * " + at_least(3, b), 2};
}

/// a + b with signs drawn out, so that "+ -" never stands in the text; -a + b is b - a, bit for bit.
Spelling Speller::add(NodeId a, NodeId b)
{
    if (const auto minus = negated(b)) return {at_least(1, a) + " - " + enclose(*minus, 2), 1};
    if (const auto minus = negated(a)) return {at_least(1, b) + " - " + enclose(*minus, 2), 1};
    return {at_least(1, a) + " + " + at_least(2, b), 1};
}

Spelling Speller::subtract(NodeId a, NodeId b)
{
    if (const auto minus = negated(b)) return {at_least(1, a) + " + " + enclose(*minus, 2), 1};
    return {at_least(1, a) + " - " + at_least(2, b), 1};
}

/// The spelling of -node where a sign stands in front of it already, and nothing otherwise.
std::optional<Spelling> Speller::negated(NodeId id)
{
    if (has_name(id)) return std::nullopt;
    const std::span<const NodeId> operand = graph_.operands(id);
    const Op op = graph_.op(id);
    if (op == Op::constant && graph_.value(id) < 0) return print_literal(-graph_.value(id));
    if (op == Op::negate) return (*this)(operand[0]);
    if (op != Op::multiply && op != Op::divide) return std::nullopt;
    NodeId a = operand[0];
    NodeId b = operand[1];
    if (op == Op::multiply && graph_.is_constant(b)) std::swap(a, b);
    const std::string sign = op == Op::multiply ? " * " : " / ";
    if (const auto minus = negated(a)) return Spelling{enclose(*minus, 2) + sign + at_least(3, b), 2};
    if (const auto minus = negated(b)) return Spelling{at_least(2, a) + sign + enclose(*minus, 3), 2};
    return std::nullopt;
}

/// Longer chains are statements of their own; the base has a name.
Spelling Speller::power(NodeId base, int exponent)
{
    const Spelling positive = repeated(at_least(5, base), std::abs(exponent));
    if (exponent > 0) return positive;
    return {"S(1) / " + enclose(positive, 3), 2};
}

/// S(..): a scalar with expression templates has another type for every sum.
Spelling Speller::choice(NodeId id)
{
    const std::span<const NodeId> operand = graph_.operands(id);
    const auto value = [&](std::size_t k) {
        const std::string text = (*this)(operand[k]).text;
        const bool plain = has_name(operand[k]) || is_choice(graph_.op(operand[k])) ||
                           (graph_.is_constant(operand[k]) && print_literal(graph_.value(operand[k])).precedence == 5);
        return plain && text.front() != '(' ? text : "S(" + text + ")";
    };
    return {fmt::format("select({}, {}, {})", condition(operand[0]).text, value(1), value(2)), 5};
}

Spelling Speller::function(NodeId id)
{
    const std::span<const NodeId> operand = graph_.operands(id);
    const Op op = graph_.op(id);
    const auto text = [&](std::size_t k) { return (*this)(operand[k]).text; };
    if (op == Op::minimum || op == Op::maximum)
        return {fmt::format("select({0} {2} {1}, {0}, {1})", at_least(1, operand[0]), at_least(1, operand[1]),
                            op == Op::minimum ? '<' : '>'),
                5};
    if (op == Op::sign) {
        const std::string x = at_least(1, operand[0]);
        return {fmt::format("select({0} > S(0), S(1), select({0} < S(0), S(-1), S(0)))", x), 5};
    }
    if (op == Op::stumpff) return {fmt::format("stumpff<{}, S>({})", graph_.payload(id), text(0)), 5};
    const std::string name = call(operator_of(op).spelling);
    if (operand.size() == 1) return {fmt::format("{}({})", name, text(0)), 5};
    return {fmt::format("{}({}, {})", name, text(0), text(1)), 5};
}

/// A mask: the comparison itself, or "is not zero".
Spelling Speller::condition(NodeId id)
{
    if (has_name(id) || !is_comparison(graph_.op(id))) return {at_least(1, id) + " != S(0)", 0};
    const std::span<const NodeId> operand = graph_.operands(id);
    return {
        fmt::format("{} {} {}", at_least(1, operand[0]), operator_of(graph_.op(id)).spelling, at_least(1, operand[1])),
        0};
}

/// A comparison as a number.
Spelling Speller::comparison(NodeId id)
{
    return {fmt::format("select({}, S(1), S(0))", condition(id).text), 5};
}

/// The square root of the runtime sets no errno, see runtime/include/lagen/roots.hpp.
std::string using_declaration(const std::string& function)
{
    return fmt::format("using {}::{};", function == "sqrt" ? "arithmetic" : "std", function);
}

} // namespace lagen
