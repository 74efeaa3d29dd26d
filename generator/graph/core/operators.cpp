// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of the operator table.
#include "graph/core/operators.hpp"

#include "expression/evaluate_stumpff.hpp"
#include "graph/core/operator_rows.hpp"
#include "graph/core/special_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <type_traits>

namespace lagen {
namespace {

using namespace rules;

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

template <class Lambda>
constexpr ScalarValues values(Lambda value)
{
    return {value, value, value};
}

/// The value lambdas of the table; `x` are the operands, the return type is their scalar.
#define LAGEN_VALUE(expression) values([](const auto* x, std::int32_t) { return expression; })
#define LAGEN_CAST(integer)                                                                                            \
    values([](const auto* x, std::int32_t) { return static_cast<std::remove_cvref_t<decltype(*x)>>(integer); })
#define LAGEN_EXACT(expression) [](const Rational* x, std::int32_t, std::size_t) -> Exact { return expression; }

/// A polynomial of some ten terms where |z| is small, else a sine and a cosine.
constexpr double stumpff_weight = 25;

using enum Smoothness;
constexpr auto total = nullptr;

constexpr std::array table{
    leaf(Op::constant, "constant"),
    leaf(Op::pi, "pi"),
    leaf(Op::input, "input"),
    arithmetic(OpKind::sum, Op::add, "+", "add", 1,
               {.notation = Notation::infix,
                .arity = 2,
                .commutative = true,
                .weight = 1,
                .value = LAGEN_VALUE(x[0] + x[1]),
                .exact = LAGEN_EXACT(Rational(x[0] + x[1])),
                .contribution = of_add,
                .series = SeriesRule::linear}),
    arithmetic(OpKind::sum, Op::subtract, "-", "subtract", 1,
               {.notation = Notation::infix,
                .arity = 2,
                .weight = 1,
                .value = LAGEN_VALUE(x[0] - x[1]),
                .exact = LAGEN_EXACT(Rational(x[0] - x[1])),
                .contribution = of_subtract,
                .series = SeriesRule::linear}),
    arithmetic(OpKind::product, Op::multiply, "*", "multiply", 2,
               {.notation = Notation::infix,
                .arity = 2,
                .commutative = true,
                .weight = 1,
                .value = LAGEN_VALUE(x[0] * x[1]),
                .exact = LAGEN_EXACT(Rational(x[0] * x[1])),
                .contribution = of_multiply,
                .series = SeriesRule::product}),
    arithmetic(OpKind::quotient, Op::divide, "/", "divide", 2,
               {.notation = Notation::infix,
                .arity = 2,
                .weight = 6,
                .value = LAGEN_VALUE(x[0] / x[1]),
                .exact = LAGEN_EXACT(exact_quotient(x[0], x[1])),
                .contribution = of_divide,
                .series = SeriesRule::quotient,
                .domain = where<Sense::nonzero>,
                .condition_operand = 1,
                .vanishes_with_operand = true}),
    arithmetic(OpKind::sum, Op::negate, "-", "negate", 3,
               {.notation = Notation::prefix,
                .arity = 1,
                .weight = 1,
                .value = LAGEN_VALUE(-x[0]),
                .exact = LAGEN_EXACT(Rational(-x[0])),
                .contribution = of_negate,
                .series = SeriesRule::linear,
                .vanishes_with_operand = true}),
    arithmetic(OpKind::power, Op::power, "^", "power", 4,
               {.notation = Notation::integer,
                .arity = 1,
                .weight = 1,
                .value = values([](const auto* x, std::int32_t n) { return integer_power(x[0], n); }),
                .exact = [](const Rational* x, std::int32_t n, std::size_t most) { return exact_power(x[0], n, most); },
                .contribution = of_power,
                .series = SeriesRule::power,
                .domain = where_power,
                .condition_operand = 0,
                .vanishes_with_operand = true}),
    arithmetic(
        OpKind::function, Op::real_power, "^", "power", 4,
        {.spelling = "pow",
         .notation = Notation::infix,
         .arity = 2,
         .weight = 40,
         .value = LAGEN_VALUE(std::pow(x[0], x[1])),
         .exact = [](const Rational* x, std::int32_t, std::size_t most) { return exact_real_power(x[0], x[1], most); },
         .contribution = of_real_power,
         .slope = slope_of_real_power,
         .series = SeriesRule::real_power,
         .smoothness = analytic,
         .domain = where_real_power,
         .condition_operand = 0}),
    function(Function::sqrt, Op::sqrt, analytic, where<Sense::nonnegative>,
             {.weight = 8,
              .value = LAGEN_VALUE(std::sqrt(x[0])),
              .exact = LAGEN_EXACT(exact_root(x[0])),
              .contribution = of_sqrt,
              .slope = slope_of_root,
              .series = SeriesRule::root,
              .condition_operand = 0,
              .vanishes_with_operand = true}),
    function(Function::sin, Op::sin, meromorphic, total,
             {.weight = 15,
              .value = LAGEN_VALUE(std::sin(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_sin,
              .slope = slope_one,
              .series = SeriesRule::chain}),
    function(Function::cos, Op::cos, meromorphic, total,
             {.weight = 15,
              .value = LAGEN_VALUE(std::cos(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 1)),
              .contribution = of_cos,
              .slope = slope_one,
              .series = SeriesRule::chain}),
    function(Function::tan, Op::tan, meromorphic, where<Sense::nonzero>,
             {.weight = 20,
              .value = LAGEN_VALUE(std::tan(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_tan,
              .slope = slope_of_tan,
              .series = SeriesRule::chain,
              .condition = cosine_of}),
    function(Function::asin, Op::asin, analytic, where<Sense::nonnegative>,
             {.weight = 20,
              .value = LAGEN_VALUE(std::asin(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_asin,
              .slope = slope_of_inverse_sine,
              .series = SeriesRule::chain,
              .condition = complement_of,
              .vanishes_with_operand = true}),
    function(Function::acos, Op::acos, analytic, where<Sense::nonnegative>,
             {.weight = 20,
              .value = LAGEN_VALUE(std::acos(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 1, 0)),
              .contribution = of_acos,
              .slope = slope_of_inverse_sine,
              .series = SeriesRule::chain,
              .condition = complement_of}),
    function(Function::atan, Op::atan, analytic, total,
             {.weight = 20,
              .value = LAGEN_VALUE(std::atan(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_atan,
              .slope = slope_one,
              .series = SeriesRule::chain,
              .vanishes_with_operand = true}),
    function(Function::atan2, Op::atan2, cut, where<Sense::off_origin>,
             {.weight = 25,
              .value = LAGEN_VALUE(std::atan2(x[0], x[1])),
              .exact = LAGEN_EXACT(x[1] > 0 ? exact_at(x[0], 0, 0) : std::nullopt),
              .contribution = of_atan2,
              .series = SeriesRule::chain}),
    function(Function::sinh, Op::sinh, meromorphic, total,
             {.weight = 20,
              .value = LAGEN_VALUE(std::sinh(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_sinh,
              .slope = slope_of_sinh,
              .series = SeriesRule::chain,
              .vanishes_with_operand = true}),
    function(Function::cosh, Op::cosh, meromorphic, total,
             {.weight = 20,
              .value = LAGEN_VALUE(std::cosh(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 1)),
              .contribution = of_cosh,
              .slope = slope_is_value,
              .series = SeriesRule::chain}),
    function(Function::tanh, Op::tanh, meromorphic, total,
             {.weight = 20,
              .value = LAGEN_VALUE(std::tanh(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_tanh,
              .slope = slope_one,
              .series = SeriesRule::chain,
              .vanishes_with_operand = true}),
    function(Function::exp, Op::exp, meromorphic, total,
             {.weight = 15,
              .value = LAGEN_VALUE(std::exp(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 1)),
              .contribution = of_exp,
              .slope = slope_is_value,
              .series = SeriesRule::chain}),
    function(Function::log, Op::log, analytic, where<Sense::positive>,
             {.weight = 15,
              .value = LAGEN_VALUE(std::log(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 1, 0)),
              .contribution = of_log,
              .slope = slope_of_log,
              .series = SeriesRule::logarithm,
              .condition_operand = 0}),
    function(Function::abs, Op::abs, kinked, total,
             {.weight = 1,
              .value = LAGEN_VALUE(std::abs(x[0])),
              .exact = LAGEN_EXACT(Rational(abs(x[0]))),
              .contribution = of_abs,
              .slope = slope_one,
              .series = SeriesRule::modulus,
              .condition_operand = 0,
              .vanishes_with_operand = true}),
    function(Function::minimum, Op::minimum, kinked, total,
             {.commutative = true,
              .weight = 1,
              .value = LAGEN_VALUE(x[0] <= x[1] ? x[0] : x[1]),
              .exact = LAGEN_EXACT(x[0] <= x[1] ? x[0] : x[1]),
              .contribution = of_minimum,
              .slope = slope_one,
              .series = SeriesRule::choice,
              .condition = difference_of}),
    function(Function::maximum, Op::maximum, kinked, total,
             {.commutative = true,
              .weight = 1,
              .value = LAGEN_VALUE(x[0] >= x[1] ? x[0] : x[1]),
              .exact = LAGEN_EXACT(x[0] >= x[1] ? x[0] : x[1]),
              .contribution = of_maximum,
              .slope = slope_one,
              .series = SeriesRule::choice,
              .condition = difference_of}),
    function(Function::sign, Op::sign, stepped, total,
             {.weight = 2,
              .value = LAGEN_CAST((x[0] > 0) - (x[0] < 0)),
              .exact = LAGEN_EXACT(Rational(sgn(x[0]))),
              .contribution = of_step,
              .slope = slope_one,
              .series = SeriesRule::constant,
              .condition_operand = 0,
              .vanishes_with_operand = true}),
    function(Function::stumpff, Op::stumpff, meromorphic, total,
             {.arity = 1,
              .weight = stumpff_weight,
              .value = values(
                  [](const auto* x, std::int32_t k) { return evaluate_stumpff(static_cast<unsigned>(k), x[0]); }),
              .exact = [](const Rational* x, std::int32_t k, std::size_t) -> Exact {
                  return sgn(x[0]) == 0 ? Exact(stumpff_at_zero(static_cast<unsigned>(k))) : std::nullopt;
              },
              .contribution = of_stumpff,
              .series = SeriesRule::refused}),
    function(Function::erf, Op::erf, meromorphic, total,
             {.weight = 25,
              .value = LAGEN_VALUE(std::erf(x[0])),
              .exact = LAGEN_EXACT(exact_at(x[0], 0, 0)),
              .contribution = of_erf,
              .slope = slope_of_erf,
              .series = SeriesRule::chain,
              .vanishes_with_operand = true}),
    comparison(Comparison::less, Op::less, "less", {.below = true}, LAGEN_CAST(x[0] < x[1]),
               LAGEN_EXACT(exact_truth(x[0] < x[1]))),
    comparison(Comparison::less_equal, Op::less_equal, "less_equal", {.below = true, .equal = true},
               LAGEN_CAST(x[0] <= x[1]), LAGEN_EXACT(exact_truth(x[0] <= x[1]))),
    comparison(Comparison::greater, Op::greater, "greater", {.above = true}, LAGEN_CAST(x[0] > x[1]),
               LAGEN_EXACT(exact_truth(x[0] > x[1]))),
    comparison(Comparison::greater_equal, Op::greater_equal, "greater_equal", {.equal = true, .above = true},
               LAGEN_CAST(x[0] >= x[1]), LAGEN_EXACT(exact_truth(x[0] >= x[1]))),
    comparison(Comparison::equal, Op::equal, "equal", {.equal = true}, LAGEN_CAST(x[0] == x[1]),
               LAGEN_EXACT(exact_truth(x[0] == x[1]))),
    comparison(Comparison::not_equal, Op::not_equal, "not_equal", {.below = true, .above = true},
               LAGEN_CAST(x[0] != x[1]), LAGEN_EXACT(exact_truth(x[0] != x[1]))),
    [] {
        Operator row = function(Function::select, Op::select, chosen, total,
                                {.weight = 1,
                                 .value = LAGEN_VALUE(x[0] != 0 ? x[1] : x[2]),
                                 .exact = LAGEN_EXACT(sgn(x[0]) != 0 ? x[1] : x[2]),
                                 .contribution = of_select,
                                 .series = SeriesRule::choice});
        row.kind = OpKind::choice;
        row.spelling = "select";
        return row;
    }(),
    [] {
        Operator row = linear_algebra(Op::factor, "factor", -1);
        row.domain = where_regular;
        return row;
    }(),
    linear_algebra(Op::solve, "solve", -1),
    linear_algebra(Op::component, "component", 1),
};

#undef LAGEN_VALUE
#undef LAGEN_CAST
#undef LAGEN_EXACT

consteval bool require(bool holds, const char* what)
{
    return holds ? true : throw what;
}

/// Every operation has its row, in order, and every row what an operation of its kind must have.
consteval bool is_complete()
{
    for (std::size_t k = 0; k < table.size(); ++k) {
        const Operator& row = table[k];
        require(row.series != SeriesRule::missing, "an operation without Taylor coefficients");
        require(row.op == static_cast<Op>(k), "a row does not stand at the place of its operation");
        if (row.kind == OpKind::leaf || row.kind == OpKind::system) continue;
        require(row.value.in_float && row.value.in_double && row.value.in_long_double, "an operation without value");
        require(row.exact != nullptr, "an operation without exact values");
        require(row.contribution != nullptr, "an operation without derivative");
        require(row.weight > 0, "an operation without cost");
        const bool conditional =
            row.smoothness == kinked || row.smoothness == stepped || (row.domain != nullptr && row.smoothness != cut);
        require(!conditional || row.condition_operand >= 0 || row.condition != nullptr,
                "an operation that is not smooth everywhere, without the condition under which it is");
    }
    return table.back().op == Op::component;
}
static_assert(is_complete());

} // namespace

std::span<const Operator> operator_table()
{
    return table;
}

const Operator& operator_of(Op op)
{
    return table[static_cast<std::size_t>(op)];
}

// The questions that are asked of the operator table.

Op op_of(Function function)
{
    const auto row = std::ranges::find(operator_table(), std::optional(function), &Operator::function);
    if (row == operator_table().end()) throw InternalError("a built-in function without an operation");
    return row->op;
}

Op op_of(Comparison comparison)
{
    return std::ranges::find(operator_table(), std::optional(comparison), &Operator::comparison)->op;
}

bool is_rational(Op op)
{
    switch (kind_of(op)) {
    case OpKind::leaf:
    case OpKind::sum:
    case OpKind::product:
    case OpKind::quotient:
    case OpKind::power: return true;
    case OpKind::function:
    case OpKind::comparison:
    case OpKind::choice:
    case OpKind::system: break;
    }
    return false;
}

Sense domain_of(const Graph& graph, NodeId node)
{
    const Operator& row = operator_of(graph.op(node));
    return row.domain != nullptr ? row.domain(graph, node) : Sense::always;
}

Sense known_where_defined(const Graph& graph, NodeId node)
{
    if (graph.op(node) == Op::real_power) {
        const NodeId exponent = graph.operands(node)[1];
        if (!graph.is_constant(exponent) || graph.value(exponent).get_den() == 1) return Sense::always;
    }
    return domain_of(graph, node);
}

Sense smooth_where(const Graph& graph, NodeId node)
{
    switch (operator_of(graph.op(node)).smoothness) {
    case Smoothness::meromorphic:
    case Smoothness::analytic: {
        const Sense domain = domain_of(graph, node);
        return domain == Sense::nonnegative ? Sense::positive : domain;
    }
    case Smoothness::cut: return Sense::off_cut;
    case Smoothness::kinked:
    case Smoothness::stepped: return Sense::nonzero;
    case Smoothness::chosen: return Sense::same_branch;
    case Smoothness::system: break;
    }
    return domain_of(graph, node);
}

NodeId condition_of(Graph& graph, NodeId node)
{
    const Operator& row = operator_of(graph.op(node));
    return row.condition_operand >= 0 ? graph.operands(node)[static_cast<std::size_t>(row.condition_operand)]
                                      : row.condition(graph, node);
}

NodeId slope_bound(Graph& graph, NodeId node, std::size_t k)
{
    const Operator& row = operator_of(graph.op(node));
    if (row.slope != nullptr) return row.slope(graph, node, k);
    return graph.apply(Op::abs, row.contribution(graph, node, k, graph.constant(1)));
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
