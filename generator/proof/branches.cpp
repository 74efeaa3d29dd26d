// SPDX-License-Identifier: GPL-2.0-or-later
/// min, max, sign, comparisons and if: by signs where these are known, else as free generators.
#include "graph/core/operators.hpp"
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

/// Whether a comparison of d with 0 holds, where the signs that d may have decide it.
std::optional<bool> compared(const Trichotomy& holds, const Signs& d)
{
    const bool yes = (d.negative && holds.below) || (d.zero && holds.equal) || (d.positive && holds.above);
    const bool no = (d.negative && !holds.below) || (d.zero && !holds.equal) || (d.positive && !holds.above);
    return yes && no ? std::nullopt : std::optional(yes);
}

} // namespace

std::optional<bool> NormalForm::holds(NodeId condition)
{
    const Op op = graph_.op(condition);
    if (kind_of(op) == OpKind::comparison)
        return compared(operator_of(op).holds,
                        elementary_.sign_of(ring_.add(operand(condition, 0), operand(condition, 1), -1)));
    return compared(operator_of(Op::not_equal).holds, elementary_.sign_of(done_.at(condition)));
}

Fraction NormalForm::comparison(NodeId node)
{
    if (const std::optional<bool> known = holds(node)) return ring_.constant(*known ? 1 : 0);
    return elementary_.opaque(operator_of(graph_.op(node)).word, {operand(node, 0), operand(node, 1)});
}

Fraction NormalForm::choice(NodeId node)
{
    const std::vector<Fraction> arguments{operand(node, 0), operand(node, 1), operand(node, 2)};
    const std::optional<bool> known = holds(graph_.operands(node)[0]);
    return known ? arguments[*known ? 1 : 2] : elementary_.opaque("if", arguments);
}

/// min, max = (a + b -+ |a - b|)/2
Fraction NormalForm::extremum(NodeId node, int sign)
{
    const Fraction& a = operand(node, 0);
    const Fraction& b = operand(node, 1);
    const Fraction gap = elementary_.absolute(ring_.add(a, b, -1));
    return ring_.times(ring_.constant(mpq_class(1, 2)), ring_.add(ring_.add(a, b), gap, sign));
}

Fraction NormalForm::sign(const Fraction& a)
{
    const Signs signs = elementary_.sign_of(a);
    if (static_cast<int>(signs.negative) + signs.zero + signs.positive == 1)
        return ring_.constant(signs.positive ? 1 : signs.negative ? -1 : 0);
    return elementary_.opaque("sign", {a});
}

} // namespace lagen::proof
