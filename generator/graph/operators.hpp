// SPDX-License-Identifier: GPL-2.0-or-later
/// The operator table: everything that is known of an operation stands in its one record.
#pragma once

#include "graph/graph.hpp"

namespace lagen {

/// How the operation is written in a text.
enum class Notation {
    leaf,    ///< constant, pi, input
    infix,   ///< a SIGN b
    prefix,  ///< SIGN a
    integer, ///< base ^ payload
    call,    ///< NAME(a, b, ...)
    block,   ///< factor, solve, component: linear algebra, more than one value
};

/// The value of an operation from the values of its operands; the integer is the payload (exponent of `power`).
template <class Scalar>
using Value = Scalar (*)(const Scalar*, std::int32_t);

/// (d node / d operand k) * t, built so that both forward (t a tangent) and reverse (t an adjoint) mode read it.
using Contribution = NodeId (*)(Graph& graph, NodeId node, std::size_t k, NodeId t);

struct Operator {
    Op op = Op::constant;
    const char* name = "";     ///< sign or function name in texts
    const char* spelling = ""; ///< sign or function name in C++, found by argument-dependent lookup or in std
    Notation notation = Notation::leaf;
    int arity = 0;      ///< -1: any number
    int precedence = 5; ///< 0 comparison, 1 sum, 2 product, 3 sign, 4 power, 5 closed
    bool commutative = false;
    double weight = 0; ///< relative cost; of `power`, `factor` and `solve` see operation_weight
    Value<float> value_float = nullptr;
    Value<double> value_double = nullptr;
    Value<long double> value_long_double = nullptr;
    Contribution contribution = nullptr; ///< null for leaves and linear algebra
};

/// The record of `op`.
[[nodiscard]] const Operator& operator_of(Op op);

/// All records, in the order of the enumeration.
[[nodiscard]] std::span<const Operator> operator_table();

/// The weight of one node: the table's, times the multiplications of a power chain, and n^3/6 + 6 n + 6 (n - 3) for a
/// factorisation of order n (general: n^3/3 + ..; the last term where n > 3), 2 n^2 for a solve.
[[nodiscard]] double operation_weight(const Graph& graph, NodeId node);

/// Multiplications of x^n by shared squares, n > 0: floor(log2 n) + ones(n) - 1.
[[nodiscard]] int power_multiplications(std::int64_t n);

} // namespace lagen
