// SPDX-License-Identifier: GPL-2.0-or-later
/// Reads a form off the graph: sums flattened and their like terms collected, products flattened, functions as atoms.
#include "graph/core/operators.hpp"
#include "graph/simplify/form.hpp"

#include <cstdlib>

namespace lagen {
namespace {

/// Terms of one multiplied-out sum.
constexpr std::size_t largest_expanded_sum = 400;
/// A sum with several users is flattened into them only while it is short; a long one keeps its own name.
constexpr std::size_t largest_shared_sum = 24;
/// Terms that the nested form may make for each node of the graph: its sums are short.
constexpr std::size_t largest_work_a_node = 40;

std::size_t largest_flattened_sum(ExpansionMode expansion)
{
    return expansion == ExpansionMode::nested ? 1 : largest_shared_sum;
}

class Collector {
  public:
    Collector(const Graph& graph, Algebra& algebra, ExpansionMode expansion, std::size_t size)
        : graph_(graph), algebra_(algebra), expansion_(expansion), values_(size), uses_(size, 0)
    {
    }

    void count_use(NodeId id) { ++uses_[id]; }
    [[nodiscard]] const Polynomial& value(NodeId id) const { return values_[id]; }

    void visit(NodeId id)
    {
        Polynomial result = algebra_.contract_circles(read(id));
        if (uses_[id] > 1 && result.size() > largest_flattened_sum(expansion_)) result = {algebra_.as_term(result)};
        values_[id] = std::move(result);
    }

  private:
    [[nodiscard]] Polynomial read(NodeId id)
    {
        const auto operands = graph_.operands(id);
        const Op op = graph_.op(id);
        switch (kind_of(op)) {
        case OpKind::leaf:
            if (op != Op::constant) return single(op, id, {});
            return graph_.is_zero(id) ? Polynomial{} : Polynomial{{graph_.value(id), {}}};
        case OpKind::sum:
            if (operands.size() == 1) return algebra_.scaled(values_[operands[0]], -1);
            if (op == Op::add) return algebra_.add(values_[operands[0]], values_[operands[1]]);
            return algebra_.add(values_[operands[0]], algebra_.scaled(values_[operands[1]], -1));
        case OpKind::product: return multiply(values_[operands[0]], values_[operands[1]]);
        case OpKind::quotient: return multiply(values_[operands[0]], {power(values_[operands[1]], -1)});
        case OpKind::power: return integer_power(id);
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice:
        case OpKind::system: break;
        }
        return function(id);
    }

    [[nodiscard]] Polynomial single(Op op, std::uint32_t payload, std::vector<Polynomial> operands)
    {
        return {{1, {{algebra_.atom(op, payload, std::move(operands)), 1}}}};
    }

    [[nodiscard]] Term power(const Polynomial& a, int n) { return algebra_.power(algebra_.as_term(a), n); }

    [[nodiscard]] bool may_distribute(const Polynomial& a, const Polynomial& b) const
    {
        if (a.size() == 1 && b.size() == 1) return true;
        if (expansion_ == ExpansionMode::none || expansion_ == ExpansionMode::nested)
            // A rational factor is no multiplication to save: it goes in, the content comes out again later.
            return (a.size() == 1 && a[0].monomial.empty()) || (b.size() == 1 && b[0].monomial.empty());
        if (expansion_ == ExpansionMode::monomials && a.size() > 1 && b.size() > 1) return false;
        return a.size() * b.size() <= largest_expanded_sum;
    }

    [[nodiscard]] Polynomial multiply(const Polynomial& a, const Polynomial& b)
    {
        if (a.empty() || b.empty()) return {};
        if (may_distribute(a, b)) return algebra_.distribute(a, b);
        return {algebra_.multiply(algebra_.as_term(a), algebra_.as_term(b))};
    }

    [[nodiscard]] Polynomial integer_power(NodeId id)
    {
        const Polynomial& base = values_[graph_.operands(id)[0]];
        const auto n = static_cast<std::int32_t>(graph_.payload(id));
        if (base.empty() && n > 0) return {};
        if (base.size() > 1 && n > 1 && n <= 4 && expansion_ == ExpansionMode::all) {
            Polynomial result = base;
            for (int k = 1; k < n; ++k) {
                if (result.size() * base.size() > largest_expanded_sum) return {power(base, n)};
                result = algebra_.distribute(result, base);
            }
            return result;
        }
        return {power(base, n)};
    }

    [[nodiscard]] Polynomial function(NodeId id)
    {
        std::vector<Polynomial> operands;
        for (const NodeId operand : graph_.operands(id)) operands.push_back(values_[operand]);
        const Op op = graph_.op(id);
        const bool indexed = op == Op::component || op == Op::factor || op == Op::stumpff;
        return single(op, indexed ? graph_.payload(id) : 0, std::move(operands));
    }

    const Graph& graph_;
    Algebra& algebra_;
    ExpansionMode expansion_;
    std::vector<Polynomial> values_;
    std::vector<std::uint32_t> uses_;
};

} // namespace

Form collect(const Graph& graph, std::span<const NodeId> outputs, ExpansionMode expansion)
{
    Form form;
    const auto nodes = reachable(graph, outputs);
    if (expansion == ExpansionMode::nested) form.algebra.allow(largest_work_a_node * nodes.size());
    Collector collector(graph, form.algebra, expansion, nodes.empty() ? 0 : std::size_t{nodes.back()} + 1);
    for (const NodeId id : nodes)
        for (const NodeId operand : graph.operands(id)) collector.count_use(operand);
    for (const NodeId id : nodes) collector.visit(id);
    for (const NodeId output : outputs) form.roots.push_back(collector.value(output));
    return form;
}

} // namespace lagen
