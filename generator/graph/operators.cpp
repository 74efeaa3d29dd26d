// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of the operator table. A derivative rule returns (d node / d operand k) * t with as few new nodes as it
/// can.
#include "graph/operators.hpp"

#include "expression/evaluate_stumpff.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace lagen {
namespace {

NodeId operand(const Graph& g, NodeId node, std::size_t k)
{
    return g.operands(node)[k];
}

/// t * sign: the rule of a sum, difference or minus sign.
NodeId of_add(Graph&, NodeId, std::size_t, NodeId t)
{
    return t;
}
NodeId of_subtract(Graph& g, NodeId, std::size_t k, NodeId t)
{
    return k == 0 ? t : g.negate(t);
}
NodeId of_negate(Graph& g, NodeId, std::size_t, NodeId t)
{
    return g.negate(t);
}
NodeId of_multiply(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    return g.multiply(operand(g, node, 1 - k), t);
}

/// d(a/b) = da/b - (a/b) db/b.
NodeId of_divide(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId b = operand(g, node, 1);
    return k == 0 ? g.divide(t, b) : g.negate(g.divide(g.multiply(node, t), b));
}

/// d(a^n) = n a^(n-1) da.
NodeId of_power(Graph& g, NodeId node, std::size_t, NodeId t)
{
    const auto n = static_cast<std::int32_t>(g.payload(node));
    const NodeId a = operand(g, node, 0);
    if (n == INT32_MIN) return g.multiply(g.multiply(g.constant(n), g.divide(node, a)), t);
    return g.multiply(g.multiply(g.constant(n), g.power(a, n - 1)), t);
}

/// d(a^b) = b a^(b-1) da + a^b log(a) db.
NodeId of_real_power(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId a = operand(g, node, 0);
    const NodeId b = operand(g, node, 1);
    if (k == 1) return g.multiply(g.multiply(node, g.apply(Op::log, a)), t);
    const NodeId lower = g.apply(Op::real_power, a, g.subtract(b, g.constant(1)));
    return g.multiply(g.multiply(b, lower), t);
}

NodeId of_sqrt(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.multiply(g.constant(2), node));
}
NodeId of_sin(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::cos, operand(g, node, 0)), t);
}
NodeId of_cos(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.negate(g.multiply(g.apply(Op::sin, operand(g, node, 0)), t));
}
NodeId of_tan(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.add(g.constant(1), g.power(node, 2)), t);
}

/// 1 - a^2, under the roots of the inverse sine and cosine.
NodeId complement(Graph& g, NodeId a)
{
    return g.subtract(g.constant(1), g.power(a, 2));
}

NodeId of_asin(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.apply(Op::sqrt, complement(g, operand(g, node, 0))));
}
NodeId of_acos(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    return g.negate(of_asin(g, node, k, t));
}
NodeId of_atan(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.add(g.constant(1), g.power(operand(g, node, 0), 2)));
}

/// d atan2(y, x) = (x dy - y dx) / (x^2 + y^2).
NodeId of_atan2(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId y = operand(g, node, 0);
    const NodeId x = operand(g, node, 1);
    const NodeId square = g.add(g.power(x, 2), g.power(y, 2));
    return k == 0 ? g.divide(g.multiply(x, t), square) : g.negate(g.divide(g.multiply(y, t), square));
}

NodeId of_sinh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::cosh, operand(g, node, 0)), t);
}
NodeId of_cosh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::sinh, operand(g, node, 0)), t);
}
NodeId of_tanh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(complement(g, node), t);
}
NodeId of_exp(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(node, t);
}
NodeId of_log(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, operand(g, node, 0));
}
NodeId of_abs(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.divide(operand(g, node, 0), node), t);
}

/// c_k' = (k c_{k+2} - c_{k+1}) / 2.
NodeId of_stumpff(Graph& g, NodeId node, std::size_t, NodeId t)
{
    const unsigned k = g.payload(node);
    const NodeId z = operand(g, node, 0);
    NodeId slope = g.negate(g.stumpff(k + 1, z));
    if (k != 0) slope = g.add(g.multiply(g.constant(static_cast<long>(k)), g.stumpff(k + 2, z)), slope);
    return g.multiply(g.divide(slope, g.constant(2)), t);
}

/// The branch that is taken; where both are equal, the first.
NodeId of_minimum(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId first = g.apply(Op::less_equal, operand(g, node, 0), operand(g, node, 1));
    const NodeId zero = g.constant(0);
    return k == 0 ? g.select(first, t, zero) : g.select(first, zero, t);
}
NodeId of_maximum(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId first = g.apply(Op::greater_equal, operand(g, node, 0), operand(g, node, 1));
    const NodeId zero = g.constant(0);
    return k == 0 ? g.select(first, t, zero) : g.select(first, zero, t);
}
NodeId of_step(Graph& g, NodeId, std::size_t, NodeId)
{
    return g.constant(0);
}
NodeId of_select(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId condition = operand(g, node, 0);
    const NodeId zero = g.constant(0);
    if (k == 0) return zero;
    return k == 1 ? g.select(condition, t, zero) : g.select(condition, zero, t);
}

/// x^n by squaring; 1 / x^-n for a negative n.
template <class Scalar>
Scalar integer_power(Scalar x, std::int32_t n)
{
    Scalar result = 1;
    for (std::uint32_t rest = n < 0 ? 0U - static_cast<std::uint32_t>(n) : static_cast<std::uint32_t>(n); rest != 0;
         rest >>= 1U, x *= x)
        if ((rest & 1U) != 0) result *= x;
    return n < 0 ? 1 / result : result;
}

template <class Function>
Operator row(Op op, const char* name, const char* spelling, Notation notation, int arity, int precedence, double weight,
             Function value, Contribution rule)
{
    const bool commutative = op == Op::add || op == Op::multiply || op == Op::minimum || op == Op::maximum ||
                             op == Op::equal || op == Op::not_equal;
    return {op, name, spelling, notation, arity, precedence, commutative, weight, value, value, value, rule};
}

Operator bare(Op op, const char* name, Notation notation, int arity)
{
    Operator entry;
    entry.op = op;
    entry.name = name;
    entry.spelling = name;
    entry.notation = notation;
    entry.arity = arity;
    return entry;
}

template <class Function>
Operator function(Op op, const char* name, double weight, Function value, Contribution rule)
{
    return row(op, name, name, Notation::call, 1, 5, weight, value, rule);
}

template <class Function>
Operator comparison(Op op, const char* sign, Function value)
{
    return row(op, sign, sign, Notation::infix, 2, 0, 1, value, of_step);
}

/// A polynomial of some ten terms where |z| is small, else a sine and a cosine.
constexpr double stumpff_weight = 25;

/// The value lambdas of the table; `x` are the operands, the return type is their scalar.
#define LAGEN_VALUE(expression) [](const auto* x, std::int32_t) { return expression; }
#define LAGEN_CAST(integer)                                                                                            \
    [](const auto* x, std::int32_t) { return static_cast<std::remove_cvref_t<decltype(*x)>>(integer); }

std::array<Operator, 38> make_table()
{
    using N = Notation;
    return {
        bare(Op::constant, "constant", N::leaf, 0),
        bare(Op::pi, "pi", N::leaf, 0),
        bare(Op::input, "input", N::leaf, 0),
        row(Op::add, "+", "+", N::infix, 2, 1, 1, LAGEN_VALUE(x[0] + x[1]), of_add),
        row(Op::subtract, "-", "-", N::infix, 2, 1, 1, LAGEN_VALUE(x[0] - x[1]), of_subtract),
        row(Op::multiply, "*", "*", N::infix, 2, 2, 1, LAGEN_VALUE(x[0] * x[1]), of_multiply),
        row(Op::divide, "/", "/", N::infix, 2, 2, 6, LAGEN_VALUE(x[0] / x[1]), of_divide),
        row(Op::negate, "-", "-", N::prefix, 1, 3, 1, LAGEN_VALUE(-x[0]), of_negate),
        row(
            Op::power, "^", "", N::integer, 1, 4, 1,
            [](const auto* x, std::int32_t n) { return integer_power(x[0], n); }, of_power),
        row(Op::real_power, "^", "pow", N::infix, 2, 4, 40, LAGEN_VALUE(std::pow(x[0], x[1])), of_real_power),
        function(Op::sqrt, "sqrt", 8, LAGEN_VALUE(std::sqrt(x[0])), of_sqrt),
        function(Op::sin, "sin", 15, LAGEN_VALUE(std::sin(x[0])), of_sin),
        function(Op::cos, "cos", 15, LAGEN_VALUE(std::cos(x[0])), of_cos),
        function(Op::tan, "tan", 20, LAGEN_VALUE(std::tan(x[0])), of_tan),
        function(Op::asin, "asin", 20, LAGEN_VALUE(std::asin(x[0])), of_asin),
        function(Op::acos, "acos", 20, LAGEN_VALUE(std::acos(x[0])), of_acos),
        function(Op::atan, "atan", 20, LAGEN_VALUE(std::atan(x[0])), of_atan),
        row(Op::atan2, "atan2", "atan2", N::call, 2, 5, 25, LAGEN_VALUE(std::atan2(x[0], x[1])), of_atan2),
        function(Op::sinh, "sinh", 20, LAGEN_VALUE(std::sinh(x[0])), of_sinh),
        function(Op::cosh, "cosh", 20, LAGEN_VALUE(std::cosh(x[0])), of_cosh),
        function(Op::tanh, "tanh", 20, LAGEN_VALUE(std::tanh(x[0])), of_tanh),
        function(Op::exp, "exp", 15, LAGEN_VALUE(std::exp(x[0])), of_exp),
        function(Op::log, "log", 15, LAGEN_VALUE(std::log(x[0])), of_log),
        function(Op::abs, "abs", 1, LAGEN_VALUE(std::abs(x[0])), of_abs),
        row(Op::minimum, "min", "min", N::call, 2, 5, 1, LAGEN_VALUE(x[0] <= x[1] ? x[0] : x[1]), of_minimum),
        row(Op::maximum, "max", "max", N::call, 2, 5, 1, LAGEN_VALUE(x[0] >= x[1] ? x[0] : x[1]), of_maximum),
        function(Op::sign, "sign", 2, LAGEN_CAST((x[0] > 0) - (x[0] < 0)), of_step),
        row(
            Op::stumpff, "stumpff", "stumpff", N::call, 1, 5, stumpff_weight,
            [](const auto* x, std::int32_t k) { return evaluate_stumpff(static_cast<unsigned>(k), x[0]); }, of_stumpff),
        comparison(Op::less, "<", LAGEN_CAST(x[0] < x[1])),
        comparison(Op::less_equal, "<=", LAGEN_CAST(x[0] <= x[1])),
        comparison(Op::greater, ">", LAGEN_CAST(x[0] > x[1])),
        comparison(Op::greater_equal, ">=", LAGEN_CAST(x[0] >= x[1])),
        comparison(Op::equal, "==", LAGEN_CAST(x[0] == x[1])),
        comparison(Op::not_equal, "!=", LAGEN_CAST(x[0] != x[1])),
        row(Op::select, "if", "select", N::call, 3, 5, 1, LAGEN_VALUE(x[0] != 0 ? x[1] : x[2]), of_select),
        bare(Op::factor, "factor", N::block, -1),
        bare(Op::solve, "solve", N::block, -1),
        bare(Op::component, "component", N::block, 1),
    };
}

#undef LAGEN_VALUE
#undef LAGEN_CAST

} // namespace

std::span<const Operator> operator_table()
{
    static const std::array<Operator, 38> table = make_table();
    return table;
}

const Operator& operator_of(Op op)
{
    return operator_table()[static_cast<std::size_t>(op)];
}

int power_multiplications(std::int64_t n)
{
    const auto bits = static_cast<std::uint64_t>(n);
    return static_cast<int>(std::bit_width(bits)) + std::popcount(bits) - 2;
}

double operation_weight(const Graph& graph, NodeId node)
{
    const Op op = graph.op(node);
    if (op == Op::power) {
        const auto n = static_cast<std::int32_t>(graph.payload(node));
        return n < 0 ? operator_of(Op::divide).weight + power_multiplications(-std::int64_t{n})
                     : power_multiplications(n);
    }
    if (op == Op::factor) {
        const double n = std::sqrt(static_cast<double>(graph.operands(node).size()));
        const bool general = graph.payload(node) == static_cast<std::uint32_t>(MatrixStructure::general);
        const double waits = std::max(0.0, n - 3); // a pivot waits for the one before; orders up to 3 are closed forms
        return n * n * n / (general ? 3 : 6) + operator_of(Op::divide).weight * (n + waits);
    }
    if (op == Op::solve) {
        const auto n = static_cast<double>(graph.operands(node).size() - 1);
        return 2 * n * n;
    }
    return operator_of(op).weight;
}

} // namespace lagen
