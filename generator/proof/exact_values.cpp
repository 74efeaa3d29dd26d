// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact rational evaluation, as far as every operation is rational at the point.
#include "graph/core/operators.hpp"
#include "proof/enclosure.hpp"

namespace lagen::proof {

namespace {

constexpr std::size_t longest_number = 20'000; ///< bits

} // namespace

std::optional<std::vector<Rational>> Evaluation::exactly(const ExactInputs& inputs) const
{
    std::vector<Rational> values(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const NodeId node = order_[k];
        if (graph_.op(node) == Op::input) {
            const auto at = inputs.find(node);
            if (at == inputs.end()) return std::nullopt;
            values[k] = at->second;
        } else if (!exact_node(node, values, values[k]) || bits_of(values[k]) > longest_number) {
            return std::nullopt;
        }
    }
    std::vector<Rational> results;
    for (const NodeId root : roots_) results.push_back(values[slots_.at(root)]);
    return results;
}

bool Evaluation::exact_node(NodeId node, const std::vector<Rational>& values, Rational& result) const
{
    if (graph_.is_constant(node)) {
        result = graph_.value(node);
        return true;
    }
    const OpKind kind = kind_of(graph_.op(node));
    if (kind == OpKind::leaf || kind == OpKind::system) return false;
    const auto operands = graph_.operands(node);
    Rational x[3];
    for (std::size_t k = 0; k < operands.size(); ++k) x[k] = operand(node, k, values);
    const auto exact = exact_value(graph_.op(node), x, graph_.payload(node), 4 * longest_number);
    if (exact) result = *exact;
    return exact.has_value();
}

} // namespace lagen::proof
