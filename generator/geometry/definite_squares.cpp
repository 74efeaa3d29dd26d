// SPDX-License-Identifier: GPL-2.0-or-later
/// L taken apart into squares, and the elimination of the fibre coordinates.
#include "geometry/definite_squares.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t most_squares = 2000; ///< of one Lagrangian

/// factor * node^2, or factor * node while L is taken apart.
struct Part {
    NodeId factor;
    NodeId node;
};

class Squares {
  public:
    Squares(Graph& graph, const FibreHessian& hessian) : graph_(graph), y_(hessian.y)
    {
        const NodeId roots[] = {hessian.lagrangian};
        // Degrees in y, from the operands up; 3 stands for "not a polynomial of degree 2".
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
        case Op::multiply: return std::min(3, of(0) + of(1));
        case Op::divide: return of(1) == 0 ? of(0) : 3;
        case Op::power: return graph_.payload(node) == 2 ? std::min(3, 2 * of(0)) : 3;
        default: return 3;
        }
    }

    void split(const Part& root)
    {
        std::vector<Part> open{root};
        while (!open.empty() && found_) {
            const Part part = open.back();
            open.pop_back();
            const int degree = degrees_.at(part.node);
            if (degree <= 1) continue; // nothing of W
            if (degree == 3 || squares_.size() + open.size() > most_squares) {
                found_ = false;
                return;
            }
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
            case Op::divide: open.push_back({graph_.divide(part.factor, operands[1]), operands[0]}); break;
            case Op::multiply: {
                const std::size_t plain = degrees_.at(operands[0]) == 0 ? 0 : 1;
                found_ = degrees_.at(operands[plain]) == 0; // no product of two linear forms
                open.push_back({graph_.multiply(part.factor, operands[plain]), operands[1 - plain]});
                break;
            }
            default: squares_.push_back({part.factor, operands[0]}); // the square of a linear form
            }
        }
    }

    Graph& graph_;
    const std::vector<NodeId>& y_;
    std::map<NodeId, int> degrees_;
    std::vector<Part> squares_;
    bool found_ = true;
};

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

bool proves_definite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const std::size_t r = hessian.y.size();
    if (r == 0) return false;
    const Squares squares(graph, hessian);
    if (!squares.found()) return false;
    std::set<NodeId> positive;
    std::vector<std::vector<NodeId>> rows; // J_i
    for (const auto& [factor, form] : squares.squares()) {
        if (positive.count(factor) == 0 && !decider.proves_positive(factor)) return false;
        positive.insert(factor);
        rows.push_back(gradient(graph, form, hessian.y));
    }
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
