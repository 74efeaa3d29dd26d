// SPDX-License-Identifier: GPL-2.0-or-later
/// min, max, sign, comparisons and if: by signs where these are known, else as free generators.
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

/// Whether a comparison of d with 0 holds, where the signs that d may have decide it.
std::optional<bool> compared(Op op, const Signs& d)
{
    const auto decided = [](bool possible, bool otherwise) {
        return possible && otherwise ? std::nullopt : std::optional(possible);
    };
    switch (op) {
    case Op::less: return decided(d.negative, d.zero || d.positive);
    case Op::less_equal: return decided(d.negative || d.zero, d.positive);
    case Op::greater: return decided(d.positive, d.zero || d.negative);
    case Op::greater_equal: return decided(d.positive || d.zero, d.negative);
    case Op::equal: return decided(d.zero, d.negative || d.positive);
    default: return decided(d.negative || d.positive, d.zero);
    }
}

} // namespace

std::optional<bool> NormalForm::holds(NodeId condition)
{
    const Op op = graph_.op(condition);
    if (op >= Op::less && op <= Op::not_equal)
        return compared(op, elementary_.sign_of(ring_.add(operand(condition, 0), operand(condition, 1), -1)));
    return compared(Op::not_equal, elementary_.sign_of(done_.at(condition)));
}

Fraction NormalForm::nonsmooth(NodeId node)
{
    static constexpr const char* names[] = {"less", "less_equal", "greater", "greater_equal", "equal", "not_equal"};
    const Op op = graph_.op(node);
    const Fraction& a = operand(node, 0);
    if (op == Op::minimum || op == Op::maximum) {
        // min, max = (a + b -+ |a - b|)/2
        const Fraction& b = operand(node, 1);
        const Fraction gap = elementary_.absolute(ring_.add(a, b, -1));
        return ring_.times(ring_.constant(mpq_class(1, 2)),
                           ring_.add(ring_.add(a, b), gap, op == Op::minimum ? -1 : 1));
    }
    std::vector<Fraction> arguments;
    for (const NodeId id : graph_.operands(node)) arguments.push_back(done_.at(id));
    if (op == Op::sign) {
        const Signs signs = elementary_.sign_of(a);
        if (static_cast<int>(signs.negative) + signs.zero + signs.positive == 1)
            return ring_.constant(signs.positive ? 1 : signs.negative ? -1 : 0);
        return elementary_.opaque("sign", arguments);
    }
    if (op == Op::select) {
        const std::optional<bool> known = holds(graph_.operands(node)[0]);
        return known ? arguments[*known ? 1 : 2] : elementary_.opaque("if", arguments);
    }
    if (const std::optional<bool> known = holds(node)) return ring_.constant(*known ? 1 : 0);
    return elementary_.opaque(names[static_cast<int>(op) - static_cast<int>(Op::less)], arguments);
}

} // namespace lagen::proof
