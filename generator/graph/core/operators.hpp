// SPDX-License-Identifier: GPL-2.0-or-later
/// The operator table: everything that is known of an operation stands in its one record. Who wants to know something
/// of an operation asks here; what is another algorithm for each (an enclosure, a normal form) is a switch without a
/// default, so that the compiler names what a new operation lacks.
#pragma once

#include "graph/core/exact_rules.hpp"
#include "graph/core/graph.hpp"

namespace lagen {

/// What an operation is to a walk that takes expressions apart.
enum class OpKind : std::uint8_t {
    leaf,       ///< constant, pi, input
    sum,        ///< add, subtract, negate: operands with signs, `term_sign`
    product,    ///< multiply
    quotient,   ///< divide
    power,      ///< integer power
    function,   ///< real_power, and what is called by a name
    comparison, ///< 1 or 0
    choice,     ///< select
    system,     ///< factor, solve, component: linear algebra
};

/// How the operation is written in a text.
enum class Notation {
    leaf,    ///< constant, pi, input
    infix,   ///< a SIGN b
    prefix,  ///< SIGN a
    integer, ///< base ^ payload
    call,    ///< NAME(a, b, ...)
    block,   ///< factor, solve, component: linear algebra, more than one value
};

/// How a value depends on the operands.
enum class Smoothness : std::uint8_t {
    meromorphic, ///< single-valued and analytic in the complex plane, but for poles where its condition vanishes
    analytic,    ///< analytic inside its domain, with branches or an end in the complex plane: roots, logarithms, atan
    cut,         ///< atan2: analytic, but for a jump across a = 0, b < 0
    kinked,      ///< continuous, and analytic on either side of a zero of its condition: abs, min, max
    stepped,     ///< constant on either side of a zero of its condition: sign, comparisons
    chosen,      ///< select: one of its operands
    system,      ///< rational in the entries of a linear system
};

/// How the Taylor coefficients of a value along a curve follow from those of the operands: graph/series/taylor.hpp.
enum class SeriesRule : std::uint8_t {
    missing,    ///< no row may have it
    constant,   ///< all of them but the first are 0: leaves, what is constant between jumps
    linear,     ///< the derivative's rule, on coefficients
    choice,     ///< that of the operand which the first coefficients choose
    product,    ///< Cauchy's product
    quotient,   ///< q b = a
    power,      ///< an integer power: products, or p' a = n a' p
    real_power, ///< p' a = n a' p, or exp(b log a)
    root,       ///< f f = a
    logarithm,  ///< a f' = a'
    chain,      ///< f' = (df/da) a', by the derivative's rule
    modulus,    ///< |a|: the sign of the first coefficient
    system,     ///< A z = b
    refused,    ///< derivatives of all orders are made of ever new functions
};

/// What the operands must satisfy. "Condition" is one function of them, see condition_of().
enum class Sense : std::uint8_t {
    always,      ///< nothing
    nonzero,     ///< the condition is not 0
    nonnegative, ///< the condition is >= 0
    positive,    ///< the condition is > 0. Both are intervals of the first operand, so a convex set where it is affine
    off_origin,  ///< of atan2(v, u): u and v are not both 0
    off_cut,     ///< of atan2(v, u): v != 0 or u > 0
    same_branch, ///< of select: its condition keeps its truth value
    regular,     ///< of factor: the matrix is
};

/// The value of an operation from the values of its operands; the integer is the payload (exponent of `power`).
template <class Scalar>
using ValueAt = Scalar (*)(const Scalar*, std::int32_t);

struct ScalarValues {
    ValueAt<float> in_float = nullptr;
    ValueAt<double> in_double = nullptr;
    ValueAt<long double> in_long_double = nullptr;
};

/// The rational value at rational operands; nothing where there is none, or a longer one than `most_bits`.
using ExactValue = std::optional<Rational> (*)(const Rational*, std::int32_t payload, std::size_t most_bits);

/// (d node / d operand k) * t, built so that both forward (t a tangent) and reverse (t an adjoint) mode read it.
using Contribution = NodeId (*)(Graph& graph, NodeId node, std::size_t k, NodeId t);

/// Of comparisons: do they hold where the first operand is below, equal to, above the second?
struct Trichotomy {
    bool below = false;
    bool equal = false;
    bool above = false;
};

struct Operator {
    Op op = Op::constant;
    OpKind kind = OpKind::leaf;
    const char* name = "";     ///< sign or function name in texts
    const char* spelling = ""; ///< sign or function name in C++, found by argument-dependent lookup or in std
    const char* word = "";     ///< name where it stands in front of all operands: "less" for "<"
    Notation notation = Notation::leaf;
    int arity = 0;      ///< -1: any number
    int precedence = 5; ///< 0 comparison, 1 sum, 2 product, 3 sign, 4 power, 5 closed
    bool commutative = false;
    std::optional<Function> function = std::nullopt;     ///< of the expression language; parity and LaTeX stand there
    std::optional<Comparison> comparison = std::nullopt; ///< of the expression language
    Trichotomy holds = {};                               ///< of comparisons
    double weight = 0;                                   ///< relative cost; see operation_weight
    ScalarValues value = {};
    ExactValue exact = nullptr;          ///< null for leaves and linear algebra
    Contribution contribution = nullptr; ///< null for leaves and linear algebra
    /// A bound of |d node / d operand k|, which carries rounding errors; null: of the derivative itself.
    NodeId (*slope)(Graph&, NodeId node, std::size_t k) = nullptr;
    SeriesRule series = SeriesRule::missing;
    Smoothness smoothness = Smoothness::meromorphic;
    Sense (*domain)(const Graph&, NodeId node) = nullptr; ///< where the node is certainly defined; null: always
    int condition_operand = -1;                           ///< the operand that is the condition; -1: `condition`
    NodeId (*condition)(Graph&, NodeId node) = nullptr;
    bool vanishes_with_operand = false; ///< where it is defined, it is 0 exactly where its first operand is
};

/// The record of `op`.
[[nodiscard]] const Operator& operator_of(Op op);

/// All records, in the order of the enumeration.
[[nodiscard]] std::span<const Operator> operator_table();

[[nodiscard]] inline OpKind kind_of(Op op)
{
    return operator_of(op).kind;
}

/// The operation of a function or comparison of the expression language.
[[nodiscard]] Op op_of(Function function);
[[nodiscard]] Op op_of(Comparison comparison);

/// Leaves, sums, products, quotients and integer powers: what a fraction of polynomials is made of.
[[nodiscard]] bool is_rational(Op op);

[[nodiscard]] inline bool is_meromorphic(Op op)
{
    return operator_of(op).smoothness == Smoothness::meromorphic;
}

/// 1 or -1: with which sign the k-th operand of a sum counts.
[[nodiscard]] inline int term_sign(Op op, std::size_t k)
{
    return op == Op::negate || (op == Op::subtract && k == 1) ? -1 : 1;
}

/// Where the node is certainly defined, given its operands.
[[nodiscard]] Sense domain_of(const Graph& graph, NodeId node);

/// What certainly holds where the node is defined: its domain, but for powers with an exponent that is no number, which
/// may be an integer.
[[nodiscard]] Sense known_where_defined(const Graph& graph, NodeId node);

/// Where the node has all derivatives in its operands. Inside its domain, or off its kinks, jumps and cut.
[[nodiscard]] Sense smooth_where(const Graph& graph, NodeId node);

/// The function of the operands that Sense::nonzero, nonnegative and positive are about: the divisor, the radicand,
/// 1 - a^2 of asin(a), cos(a) of tan(a), a - b of min(a, b). Nodes that are none of the graph's yet are made.
[[nodiscard]] NodeId condition_of(Graph& graph, NodeId node);

/// Exact value at rational operands, of any node but leaves and linear algebra.
[[nodiscard]] inline std::optional<Rational> exact_value(Op op, const Rational* operands, std::uint32_t payload,
                                                         std::size_t most_bits)
{
    return operator_of(op).exact(operands, static_cast<std::int32_t>(payload), most_bits);
}

/// |d node / d operand k| or a bound of it, of what has a derivative.
[[nodiscard]] NodeId slope_bound(Graph& graph, NodeId node, std::size_t k);

/// The weight of one node: the table's, times the multiplications of a power chain, and n^3/6 + 6 n + 6 (n - 3) for a
/// factorisation of order n (general: n^3/3 + ..; the last term where n > 3), 2 n^2 for a solve.
[[nodiscard]] double operation_weight(const Graph& graph, NodeId node);

/// Multiplications of x^n by shared squares, n > 0: floor(log2 n) + ones(n) - 1.
[[nodiscard]] int power_multiplications(std::int64_t n);

} // namespace lagen
