// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/power_bounds.hpp"

#include <algorithm>

namespace lagen::proof {

namespace {

constexpr int deepest_walk = 32;

} // namespace

Ball size_of(const Ball& x)
{
    Ball out;
    mag_t size;
    mag_init(size);
    arb_get_mag(size, x.get());
    arf_set_mag(arb_midref(out.get()), size);
    mag_clear(size);
    return out;
}

bool is_exactly_zero(const Ball& x)
{
    return arb_is_zero(x.get()) != 0;
}

Ball times(const Ball& a, const Ball& b, slong bits)
{
    Ball out;
    arb_mul(out.get(), a.get(), b.get(), bits);
    return out;
}

Ball raised(const Ball& size, const Rational& e, slong bits)
{
    if (e == 0) return {Rational(1), bits};
    if (is_exactly_zero(size)) return {};
    Ball out;
    arb_pow(out.get(), size.get(), Ball(e, bits).get(), bits);
    return out;
}

std::optional<Rational> exponent_of(const Graph& graph, NodeId node)
{
    if (graph.op(node) == Op::sqrt) return Rational(1, 2);
    if (graph.op(node) != Op::real_power) return std::nullopt;
    const NodeId exponent = graph.operands(node)[1];
    return graph.is_constant(exponent) ? std::optional(graph.value(exponent)) : std::nullopt;
}

std::optional<PowerBound> PowerBounds::of(NodeId node, NodeId base)
{
    return bound_of(node, base, deepest_walk);
}

std::optional<PowerBound> PowerBounds::bound_of(NodeId node, NodeId base, int depth)
{
    auto& known = known_[base];
    if (known.empty()) descend(known, base, {Ball(Rational(1), bits_), 1}, deepest_walk);
    if (const auto found = known.find(node); found != known.end()) return found->second;
    int& looked = unseen_[base][node];
    if (depth <= looked) return std::nullopt;
    const std::optional<PowerBound> found = by_parts(node, base, depth);
    if (found)
        known.emplace(node, *found);
    else
        looked = depth;
    return found;
}

/// |node| by bounds of its operands.
std::optional<PowerBound> PowerBounds::by_parts(NodeId node, NodeId base, int depth)
{
    const std::vector<NodeId> of(graph_.operands(node).begin(), graph_.operands(node).end());
    const auto bound = [&](std::size_t k) { return bound_of(of[k], base, depth - 1); };
    const auto scaled = [&](std::optional<PowerBound> a, const Ball& factor) {
        if (a) a->C = times(a->C, size_of(factor), bits_);
        return a && a->C.is_finite() ? a : std::nullopt;
    };
    switch (graph_.op(node)) {
    case Op::negate:
    case Op::abs: return bound(0);
    case Op::multiply: {
        const auto a = bound(0), b = bound(1);
        if (a && b) return PowerBound{times(a->C, b->C, bits_), Rational(a->p + b->p)};
        return a ? scaled(a, value_(of[1])) : scaled(b, value_(of[0]));
    }
    case Op::divide: {
        Ball inverse;
        arb_inv(inverse.get(), value_(of[1]).get(), bits_);
        return scaled(bound(0), inverse);
    }
    case Op::add:
    case Op::subtract: {
        const auto a = bound(0), b = a ? bound(1) : std::nullopt;
        if (!b) return std::nullopt;
        const Rational p = std::min(a->p, b->p);
        PowerBound sum{{}, p};
        for (const auto& each : {a, b})
            arb_addmul(sum.C.get(), each->C.get(), raised(size_of(value_(base)), Rational(each->p - p), bits_).get(),
                       bits_);
        return sum;
    }
    case Op::power: {
        const auto n = static_cast<std::int32_t>(graph_.payload(node));
        return n > 0 ? powered(bound(0), n) : std::nullopt;
    }
    case Op::sqrt:
    case Op::real_power: {
        const auto q = exponent_of(graph_, node);
        return q && *q > 0 ? powered(bound(0), *q) : std::nullopt;
    }
    default: return std::nullopt;
    }
}

std::optional<PowerBound> PowerBounds::powered(std::optional<PowerBound> a, const Rational& q) const
{
    if (a) *a = {raised(a->C, q, bits_), Rational(a->p * q)};
    return a;
}

/// What a bound of a node says of the parts that it is made of.
void PowerBounds::descend(std::map<NodeId, PowerBound>& known, NodeId node, const PowerBound& bound, int depth) const
{
    if (depth == 0 || graph_.is_constant(node)) return;
    const auto [place, is_new] = known.try_emplace(node, bound);
    if (!is_new && place->second.p >= bound.p) return;
    place->second = bound;
    const auto operands = graph_.operands(node);
    const auto root = [&](NodeId of, const Rational& n) { descend(known, of, *powered(bound, 1 / n), depth - 1); };
    const auto over = [&](NodeId of, const Ball& factor) { // |factor of| is bounded
        Ball inverse;
        arb_inv(inverse.get(), factor.get(), bits_);
        if (inverse.is_finite()) descend(known, of, {times(bound.C, size_of(inverse), bits_), bound.p}, depth - 1);
    };
    switch (graph_.op(node)) {
    case Op::add:
        for (const NodeId each : operands)
            if (arb_is_nonnegative(value_(operands[0]).get()) != 0 &&
                arb_is_nonnegative(value_(operands[1]).get()) != 0)
                descend(known, each, bound, depth - 1);
        return;
    case Op::negate:
    case Op::abs: return descend(known, operands[0], bound, depth - 1);
    case Op::multiply: over(operands[1], value_(operands[0])); return over(operands[0], value_(operands[1]));
    case Op::divide:
        return descend(known, operands[0], {times(bound.C, size_of(value_(operands[1])), bits_), bound.p}, depth - 1);
    case Op::power:
        if (const auto n = static_cast<std::int32_t>(graph_.payload(node)); n > 0) root(operands[0], n);
        return;
    case Op::sqrt:
    case Op::real_power:
        if (const auto q = exponent_of(graph_, node); q && *q > 0) root(operands[0], *q);
        return;
    default: return;
    }
}

} // namespace lagen::proof
