// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/core/special_values.hpp"

#include "expression/special_angles.hpp"

#include <algorithm>

namespace lagen::rules {

namespace {

constexpr std::size_t longest_power = std::size_t{1} << 16U; ///< bits
constexpr int deepest_constant = 12;                         ///< constants are short; a longer one stays a call

/// q of the node q pi, made of pi and rational numbers.
std::optional<Rational> turn_of(const Graph& graph, NodeId id, int depth = deepest_constant)
{
    if (graph.op(id) == Op::pi) return Rational(1);
    if (graph.is_zero(id)) return Rational(0);
    if (depth == 0) return std::nullopt;
    const auto of = graph.operands(id);
    const auto turn = [&](std::size_t k) { return turn_of(graph, of[k], depth - 1); };
    switch (graph.op(id)) {
    case Op::negate:
        if (const auto a = turn(0)) return Rational(-*a);
        return std::nullopt;
    case Op::multiply:
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
            if (graph.is_constant(of[k]))
                if (const auto a = turn(1 - k)) return Rational(graph.value(of[k]) * *a);
        return std::nullopt;
    case Op::divide:
        if (graph.is_constant(of[1]))
            if (const auto a = turn(0)) return Rational(*a / graph.value(of[1]));
        return std::nullopt;
    case Op::add:
    case Op::subtract: {
        const auto b = turn(1); // the last term first: most sums end in what is no constant
        const auto a = b ? turn(0) : std::nullopt;
        if (!a) return std::nullopt;
        return graph.op(id) == Op::add ? Rational(*a + *b) : Rational(*a - *b);
    }
    default: return std::nullopt;
    }
}

/// A product of rational numbers and square roots of them.
std::optional<SignedRoot> root_of(const Graph& graph, NodeId id, int depth = deepest_constant)
{
    if (graph.is_constant(id)) return signed_root(graph.value(id));
    if (depth == 0) return std::nullopt;
    const auto of = graph.operands(id);
    const auto root = [&](std::size_t k) { return root_of(graph, of[k], depth - 1); };
    switch (graph.op(id)) {
    case Op::sqrt:
        if (graph.is_constant(of[0]) && graph.value(of[0]) >= 0) return SignedRoot{1, graph.value(of[0])};
        return std::nullopt;
    case Op::negate:
        if (const auto a = root(0)) return SignedRoot{-a->sign, a->square};
        return std::nullopt;
    case Op::multiply:
    case Op::divide: {
        const auto b = root(1), a = b ? root(0) : std::nullopt;
        if (!a) return std::nullopt;
        return graph.op(id) == Op::multiply ? *a * *b : SignedRoot{a->sign * b->sign, a->square / b->square};
    }
    default: return std::nullopt;
    }
}

/// With the square root of an integer above the bar: sqrt(3)/3.
NodeId node_of(Graph& graph, const SignedRoot& value)
{
    const mpz_class &p = value.square.get_num(), &q = value.square.get_den();
    const auto below = rational_root(Rational(q));
    const NodeId radicand = graph.constant(below ? Rational(p) : Rational(p * q));
    const NodeId size = graph.divide(graph.apply(Op::sqrt, radicand), graph.constant(below ? *below : Rational(q)));
    return value.sign < 0 ? graph.negate(size) : size;
}

NodeId pi_times(Graph& graph, const Rational& turn)
{
    const NodeId above = graph.multiply(graph.constant(Rational(turn.get_num())), graph.pi());
    return graph.divide(above, graph.constant(Rational(turn.get_den())));
}

std::optional<NodeId> node_of(Graph& graph, const std::optional<SignedRoot>& value)
{
    return value ? std::optional(node_of(graph, *value)) : std::nullopt;
}

std::optional<NodeId> pi_times(Graph& graph, const std::optional<Rational>& turn)
{
    return turn ? std::optional(pi_times(graph, *turn)) : std::nullopt;
}

} // namespace

std::optional<NodeId> special_value(Graph& graph, Op op, NodeId a)
{
    const auto inverse_of = [&](Op function) -> std::optional<NodeId> {
        if (graph.op(a) != function || !graph.is_constant(graph.operands(a)[0])) return std::nullopt;
        return graph.operands(a)[0];
    };
    const auto at_turn = [&](auto function) {
        const auto turn = turn_of(graph, a);
        return node_of(graph, turn ? function(*turn) : std::nullopt);
    };
    const auto at_root = [&](auto function) {
        const auto root = root_of(graph, a);
        return root ? function(*root) : std::nullopt;
    };
    switch (op) {
    case Op::sin: return at_turn(sine_of_turn);
    case Op::cos: return at_turn(cosine_of_turn);
    case Op::tan: return at_turn(tangent_of_turn);
    case Op::asin: return pi_times(graph, at_root(turn_of_sine));
    case Op::acos: {
        const auto turn = at_root(turn_of_sine);
        return turn ? std::optional(pi_times(graph, Rational(Rational(1, 2) - *turn))) : std::nullopt;
    }
    case Op::atan: return pi_times(graph, at_root(turn_of_tangent));
    case Op::exp: return inverse_of(Op::log);
    case Op::log: return inverse_of(Op::exp);
    default: return std::nullopt;
    }
}

std::optional<NodeId> special_angle(Graph& graph, NodeId a, NodeId b)
{
    const auto y = root_of(graph, a), x = y ? root_of(graph, b) : std::nullopt;
    if (!x || (y->sign == 0 && x->sign == 0)) return std::nullopt;
    if (x->sign == 0) return pi_times(graph, Rational(y->sign, 2));
    const auto turn = turn_of_tangent({y->sign * x->sign, y->square / x->square});
    if (!turn) return std::nullopt;
    return pi_times(graph, x->sign > 0 ? *turn : Rational(*turn + (y->sign < 0 ? -1 : 1)));
}

Exact exact_real_power(const Rational& a, const Rational& b, std::size_t most_bits)
{
    if (a == 1) return Rational(1);
    if (sgn(a) <= 0 || !b.get_num().fits_slong_p() || !b.get_den().fits_ulong_p()) return std::nullopt;
    Rational root;
    const unsigned long degree = b.get_den().get_ui();
    if (mpz_root(root.get_num_mpz_t(), a.get_num_mpz_t(), degree) == 0 ||
        mpz_root(root.get_den_mpz_t(), a.get_den_mpz_t(), degree) == 0)
        return std::nullopt;
    return exact_power(root, b.get_num().get_si(), std::min(most_bits, longest_power));
}

std::optional<Rational> special_square(const Graph& graph, NodeId a)
{
    const auto root = root_of(graph, a);
    return root ? std::optional(root->square) : std::nullopt;
}

} // namespace lagen::rules
