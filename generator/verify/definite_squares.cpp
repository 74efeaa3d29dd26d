// SPDX-License-Identifier: GPL-2.0-or-later
/// L taken apart into squares, and the elimination of the fibre coordinates.
#include "verify/definite_squares.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t most_squares = 2000; ///< of one Lagrangian

/// factor * node while L is taken apart, then factor * d(node) d(node)^T, a part of W.
struct Part {
    NodeId factor;
    NodeId node;
};

class Squares {
  public:
    Squares(Graph& graph, const FibreHessian& hessian) : graph_(graph), y_(hessian.y)
    {
        const NodeId roots[] = {hessian.lagrangian};
        // Degrees in y, from the operands up; 2 stands for everything that is not affine.
        for (const NodeId node : reachable(graph, roots)) degrees_[node] = degree(node);
        split({graph.constant(1), hessian.lagrangian});
    }

    [[nodiscard]] bool found() const { return found_ && !squares_.empty(); }
    [[nodiscard]] const std::vector<Part>& squares() const { return squares_; }

  private:
    [[nodiscard]] int degree(NodeId node) const
    {
        if (std::find(y_.begin(), y_.end(), node) != y_.end()) return 1;
        const auto operands = graph_.operands(node);
        const auto of = [&](std::size_t k) { return degrees_.at(operands[k]); };
        int greatest = 0;
        for (std::size_t k = 0; k < operands.size(); ++k) greatest = std::max(greatest, of(k));
        if (greatest == 0) return 0;
        switch (graph_.op(node)) {
        case Op::add:
        case Op::subtract:
        case Op::negate: return greatest;
        case Op::multiply: return std::min(2, of(0) + of(1));
        case Op::divide: return of(1) == 0 ? of(0) : 2;
        default: return 2;
        }
    }

    void split(const Part& root)
    {
        std::vector<Part> open{root};
        while (!open.empty() && found_) {
            const Part part = open.back();
            open.pop_back();
            if (degrees_.at(part.node) <= 1) continue; // nothing of W
            found_ = squares_.size() + open.size() < most_squares;
            const std::vector<NodeId> operands(graph_.operands(part.node).begin(), graph_.operands(part.node).end());
            switch (graph_.op(part.node)) {
            case Op::add:
                open.push_back({part.factor, operands[0]});
                open.push_back({part.factor, operands[1]});
                break;
            case Op::subtract:
                open.push_back({part.factor, operands[0]});
                open.push_back({graph_.negate(part.factor), operands[1]});
                break;
            case Op::negate: open.push_back({graph_.negate(part.factor), operands[0]}); break;
            case Op::multiply: {
                const std::size_t plain = degrees_.at(operands[0]) == 0 ? 0 : 1;
                found_ = degrees_.at(operands[plain]) == 0; // no product of two functions of y
                open.push_back({graph_.multiply(part.factor, operands[plain]), operands[1 - plain]});
                break;
            }
            default: compose(part, operands, open);
            }
        }
    }

    /// m g(f) where one operand f alone depends on y, or is f in all places where g has one that does.
    void compose(const Part& part, std::vector<NodeId> operands, std::vector<Part>& open)
    {
        NodeId f = part.node;
        for (const NodeId operand : operands) {
            if (degrees_.at(operand) == 0) continue;
            found_ = found_ && (f == part.node || f == operand);
            f = operand;
        }
        const Op op = graph_.op(part.node);
        found_ = found_ && op < Op::abs;
        if (!found_) return;
        const NodeId z = graph_.input("argument of a function");
        std::replace(operands.begin(), operands.end(), f, z);
        NodeId g = 0;
        if (op == Op::power)
            g = graph_.power(z, static_cast<std::int32_t>(graph_.payload(part.node)));
        else if (op == Op::divide)
            g = graph_.divide(operands[0], operands[1]);
        else
            g = operands.size() == 1 ? graph_.apply(op, z) : graph_.apply(op, operands[0], operands[1]);
        const NodeId argument[] = {z};
        const NodeId first = gradient(graph_, g, argument)[0];
        const NodeId derivatives[] = {first, gradient(graph_, first, argument)[0]};
        const std::pair<NodeId, NodeId> back[] = {{z, f}};
        const std::vector<NodeId> there = substitute(graph_, derivatives, back);
        open.push_back({graph_.multiply(part.factor, there[0]), f});
        if (!graph_.is_zero(there[1])) squares_.push_back({graph_.multiply(part.factor, there[1]), f});
    }

    Graph& graph_;
    const std::vector<NodeId>& y_;
    std::map<NodeId, int> degrees_;
    std::vector<Part> squares_;
    bool found_ = true;
};

/// The nodes of the squares with a positive factor; nothing where a factor may be negative.
std::optional<std::vector<NodeId>> positive_squares(const Squares& squares, const ZeroDecider& decider)
{
    if (!squares.found()) return {};
    std::map<NodeId, bool> positive;
    std::vector<NodeId> nodes;
    for (const auto& [factor, node] : squares.squares()) {
        if (positive.count(factor) == 0) positive[factor] = decider.proves_positive(factor);
        if (!positive[factor] && !decider.proves_nonnegative(factor)) return {};
        if (positive[factor]) nodes.push_back(node);
    }
    return nodes;
}

/// The one coordinate of a row that is still open; row.size() where there are none or several.
std::size_t only_open(const Graph& graph, const std::vector<NodeId>& row, const std::vector<bool>& closed)
{
    std::size_t only = row.size();
    for (std::size_t a = 0; a < row.size(); ++a) {
        if (closed[a] || graph.is_zero(row[a])) continue;
        if (only != row.size()) return row.size();
        only = a;
    }
    return only;
}

} // namespace

bool proves_semidefinite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return positive_squares(Squares(graph, hessian), decider).has_value();
}

bool proves_definite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const std::size_t r = hessian.y.size();
    if (r == 0) return false;
    const auto nodes = positive_squares(Squares(graph, hessian), decider);
    if (!nodes) return false;
    std::vector<std::vector<NodeId>> rows; // J_i
    for (const NodeId node : *nodes) rows.push_back(gradient(graph, node, hessian.y));
    std::vector<bool> closed(r, false);
    for (std::size_t count = 0; count < r;) {
        std::map<std::size_t, std::vector<NodeId>> sums;
        for (const std::vector<NodeId>& row : rows)
            if (const std::size_t a = only_open(graph, row, closed); a < r) sums[a].push_back(graph.power(row[a], 2));
        bool progress = false;
        for (const auto& [a, terms] : sums) {
            if (!decider.proves_positive(graph.sum(terms))) continue;
            closed[a] = progress = true;
            ++count;
        }
        if (!progress) return false;
    }
    return true;
}

} // namespace lagen
