// SPDX-License-Identifier: GPL-2.0-or-later
/// The linear terms of a quadratic function and the products that it makes of them.
#include "graph/core/operators.hpp"
#include "graph/elimination/sparse_hessian.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace lagen {
namespace {

/// The degree of a node in the variables; `no_degree` where it is no polynomial of degree at most 2 as it is written.
constexpr int no_degree = -1;

class Reader {
  public:
    Reader(Graph& graph, NodeId value, std::span<const NodeId> variables)
        : graph_(graph), variables_(variables.begin(), variables.end())
    {
        const NodeId roots[] = {value};
        nodes_ = reachable(graph, roots);
        degrees_.assign(std::size_t{value} + 1, 0);
        for (const NodeId variable : variables)
            if (variable < degrees_.size()) degrees_[variable] = 1;
        for (const NodeId id : nodes_)
            if (!graph.operands(id).empty()) degrees_[id] = degree(id);
    }

    std::optional<SparseHessian> read(NodeId value)
    {
        if (degrees_[value] != 2) return {};
        weigh(value);
        SparseHessian result;
        result.order = variables_.size();
        number_terms();
        result.definitions.resize(variables_.size());
        for (const NodeId id : terms_) result.definitions.push_back(definition(id));
        for (const auto& [pair, weight] : products_) {
            const auto [row, column] = std::minmax(numbers_.at(pair.first), numbers_.at(pair.second));
            result.entries.push_back({row, column, weight});
        }
        return result;
    }

  private:
    [[nodiscard]] int degree(NodeId id) const
    {
        const auto operands = graph_.operands(id);
        const auto of = [&](std::size_t k) { return degrees_[operands[k]]; };
        int greatest = 0;
        for (const NodeId operand : operands) {
            if (degrees_[operand] == no_degree) return no_degree;
            greatest = std::max(greatest, degrees_[operand]);
        }
        if (greatest == 0) return 0;
        switch (kind_of(graph_.op(id))) {
        case OpKind::sum: return greatest;
        case OpKind::product: return of(0) + of(1) <= 2 ? of(0) + of(1) : no_degree;
        case OpKind::quotient: return of(1) == 0 ? of(0) : no_degree;
        case OpKind::power: return of(0) == 1 && graph_.payload(id) == 2 ? 2 : no_degree;
        case OpKind::leaf:
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice:
        case OpKind::system: break;
        }
        return no_degree;
    }

    /// d value / d node for the nodes of degree 2, from the value down; H from the products of linear nodes.
    void weigh(NodeId value)
    {
        std::map<NodeId, NodeId, std::greater<>> weights{{value, graph_.constant(1)}};
        const auto pass = [&](NodeId operand, NodeId weight) {
            if (degrees_[operand] != 2) return;
            const auto [place, fresh] = weights.try_emplace(operand, weight);
            if (!fresh) place->second = graph_.add(place->second, weight);
        };
        while (!weights.empty()) {
            const auto [id, weight] = *weights.begin();
            weights.erase(weights.begin());
            const std::vector<NodeId> operands(graph_.operands(id).begin(), graph_.operands(id).end());
            const Op op = graph_.op(id);
            const OpKind kind = kind_of(op);
            if (kind == OpKind::sum) {
                for (std::size_t k = 0; k < operands.size(); ++k) pass(operands[k], signed_by(op, k, weight));
            } else if (kind == OpKind::quotient) {
                pass(operands[0], graph_.divide(weight, operands[1]));
            } else if (kind == OpKind::power) {
                add_product(operands[0], operands[0], graph_.multiply(graph_.constant(2), weight));
            } else if (degrees_[operands[0]] == 1) { // a product
                add_product(operands[0], operands[1], weight);
            } else {
                const std::size_t quadratic = degrees_[operands[0]] == 2 ? 0 : 1;
                pass(operands[quadratic], graph_.multiply(weight, operands[1 - quadratic]));
            }
        }
    }

    /// The weight of the k-th operand of a sum of this weight.
    NodeId signed_by(Op op, std::size_t k, NodeId weight)
    {
        return term_sign(op, k) > 0 ? weight : graph_.negate(weight);
    }

    void add_product(NodeId a, NodeId b, NodeId weight)
    {
        const auto [place, fresh] = products_.try_emplace(std::minmax(a, b), weight);
        if (!fresh) place->second = graph_.add(place->second, weight);
    }

    /// The linear nodes below the products, operands first.
    void number_terms()
    {
        std::vector<bool> wanted(degrees_.size(), false);
        for (const auto& [pair, weight] : products_) wanted[pair.first] = wanted[pair.second] = true;
        for (std::size_t k = 0; k < variables_.size(); ++k) numbers_[variables_[k]] = k;
        for (std::size_t k = nodes_.size(); k-- > 0;) {
            const NodeId id = nodes_[k];
            if (!wanted[id] || numbers_.contains(id)) continue;
            terms_.push_back(id);
            for (const NodeId operand : graph_.operands(id))
                if (degrees_[operand] == 1) wanted[operand] = true;
        }
        std::ranges::reverse(terms_);
        for (const NodeId id : terms_) numbers_.emplace(id, numbers_.size());
    }

    [[nodiscard]] SparseHessian::Terms definition(NodeId id)
    {
        const std::vector<NodeId> operands(graph_.operands(id).begin(), graph_.operands(id).end());
        const NodeId one = graph_.constant(1);
        SparseHessian::Terms terms;
        const auto append = [&](NodeId operand, NodeId coefficient) {
            if (degrees_[operand] == 1) terms.emplace_back(numbers_.at(operand), coefficient);
        };
        const Op op = graph_.op(id);
        if (kind_of(op) == OpKind::sum) {
            for (std::size_t k = 0; k < operands.size(); ++k) append(operands[k], signed_by(op, k, one));
        } else if (kind_of(op) == OpKind::quotient) {
            append(operands[0], graph_.divide(one, operands[1]));
        } else { // a product with one linear factor
            append(operands[0], operands[1]);
            append(operands[1], operands[0]);
        }
        return terms;
    }

    Graph& graph_;
    std::vector<NodeId> variables_;
    std::vector<NodeId> nodes_;
    std::vector<int> degrees_;
    std::map<std::pair<NodeId, NodeId>, NodeId> products_;
    std::vector<NodeId> terms_;
    std::map<NodeId, std::size_t> numbers_;
};

} // namespace

std::optional<SparseHessian> read_hessian(Graph& graph, NodeId value, std::span<const NodeId> variables)
{
    return Reader(graph, value, variables).read(value);
}

} // namespace lagen
