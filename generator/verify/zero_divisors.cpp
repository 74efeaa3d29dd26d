// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/zero_divisors.hpp"

namespace lagen {
namespace {

bool is_negative_number(const Tree& tree)
{
    if (tree->kind == TreeKind::negate)
        return tree->arguments[0]->kind == TreeKind::number && tree->arguments[0]->number > 0;
    return tree->kind == TreeKind::number && tree->number < 0;
}

/// The divisor at the root of a tree, or null.
Tree divisor_of(const Tree& tree)
{
    if (tree->kind == TreeKind::divide) return tree->arguments[1];
    if (tree->kind == TreeKind::power && is_negative_number(tree->arguments[1])) return tree->arguments[0];
    return nullptr;
}

ProofSetting without_definedness(ProofSetting setting)
{
    setting.defined.clear();
    return setting;
}

} // namespace

ZeroDivisors::ZeroDivisors(Graph& graph, ProofSetting setting, const ProofBudget& budget)
    : graph_(graph), setting_(without_definedness(std::move(setting))), decider_(graph, setting_, budget)
{
    const auto point = decider_.sample_point();
    if (point) point_.emplace(graph, *point);
}

bool ZeroDivisors::is_zero(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.is_zero(node);
    if (!nonzero_.insert(node).second || (point_ && !point_->may_vanish(node))) return false;
    return decider_.status(node) == ProofStatus::proved;
}

void ZeroDivisors::refuse(const Tree& root, const Lower& lower)
{
    const auto divides_by_zero = [&](const Tree& part) {
        const Tree divisor = divisor_of(part);
        return divisor != nullptr && is_zero(lower(divisor));
    };
    const Tree quotient = seen_(root, divides_by_zero);
    if (quotient == nullptr) return;
    const Tree divisor = divisor_of(quotient);
    throw ModelError("division by " + to_text(divisor) + ", which is zero everywhere", divisor->where,
                     "a divisor must be nonzero somewhere on the domain");
}

} // namespace lagen
