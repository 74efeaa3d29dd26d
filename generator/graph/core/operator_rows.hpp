// SPDX-License-Identifier: GPL-2.0-or-later
/// What rows of the operator table have in common, by kind.
#pragma once

#include "graph/core/derivative_rules.hpp"
#include "graph/core/operators.hpp"

namespace lagen::rules {

// What the rows of the operator table say of domains: the sense in which the operands are restricted, and the function
// of them that is.

template <Sense sense>
Sense where(const Graph&, NodeId)
{
    return sense;
}

inline Sense where_power(const Graph& graph, NodeId node)
{
    return static_cast<std::int32_t>(graph.payload(node)) < 0 ? Sense::nonzero : Sense::always;
}

/// x >= 0 for a number that is positive, else x > 0: x^y is exp(y log(x)) for any other y.
inline Sense where_real_power(const Graph& graph, NodeId node)
{
    const NodeId exponent = graph.operands(node)[1];
    return graph.is_constant(exponent) && sgn(graph.value(exponent)) > 0 ? Sense::nonnegative : Sense::positive;
}

inline Sense where_regular(const Graph& graph, NodeId node)
{
    const bool proved = graph.payload(node) == static_cast<std::uint32_t>(MatrixStructure::positive_definite);
    return proved ? Sense::always : Sense::regular;
}

inline NodeId difference_of(Graph& graph, NodeId node)
{
    const NodeId a = graph.operands(node)[0];
    return graph.subtract(a, graph.operands(node)[1]);
}

inline NodeId cosine_of(Graph& graph, NodeId node)
{
    return graph.apply(Op::cos, graph.operands(node)[0]);
}

constexpr Operator leaf(Op op, const char* name)
{
    return {.op = op, .name = name, .spelling = name, .word = name, .series = SeriesRule::constant};
}

constexpr Operator linear_algebra(Op op, const char* name, int arity)
{
    return {.op = op,
            .kind = OpKind::system,
            .name = name,
            .spelling = name,
            .word = name,
            .notation = Notation::block,
            .arity = arity,
            .series = SeriesRule::system,
            .smoothness = Smoothness::system};
}

/// Rows of arithmetic: sums, products, quotients, powers.
constexpr Operator arithmetic(OpKind kind, Op op, const char* sign, const char* word, int precedence, Operator row)
{
    row.op = op;
    row.kind = kind;
    row.name = sign;
    if (row.spelling[0] == 0) row.spelling = sign;
    row.word = word;
    row.precedence = precedence;
    return row;
}

/// Rows of functions cannot leave out how smooth they are, nor where they are defined (null: everywhere).
constexpr Operator function(Function f, Op op, Smoothness smoothness, Sense (*domain)(const Graph&, NodeId),
                            Operator row)
{
    const FunctionEntry& entry = entry_of(f);
    row.op = op;
    row.kind = OpKind::function;
    row.name = row.spelling = row.word = entry.name;
    row.notation = Notation::call;
    row.arity = row.arity != 0 ? row.arity : static_cast<int>(entry.arity);
    row.function = f;
    row.smoothness = smoothness;
    row.domain = domain;
    return row;
}

constexpr Operator comparison(Comparison c, Op op, const char* word, Trichotomy holds, ScalarValues value,
                              ExactValue exact)
{
    return {.op = op,
            .kind = OpKind::comparison,
            .name = spelling(c),
            .spelling = spelling(c),
            .word = word,
            .notation = Notation::infix,
            .arity = 2,
            .precedence = 0,
            .commutative = holds.below == holds.above,
            .comparison = c,
            .holds = holds,
            .weight = 1,
            .value = value,
            .exact = exact,
            .contribution = of_step,
            .slope = slope_one,
            .series = SeriesRule::constant,
            .smoothness = Smoothness::stepped,
            .condition = difference_of};
}

} // namespace lagen::rules
