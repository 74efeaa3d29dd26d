// SPDX-License-Identifier: GPL-2.0-or-later
/// L taken apart into squares and products, and the elimination of the fibre coordinates.
#include "verify/definite_squares.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "proof/rational_matrix.hpp"

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

/// A part sum_fg c_fg df dg^T of W, where c is symmetric, of functions f that are affine in y.
struct Form {
    std::vector<NodeId> nodes;        ///< f, shape (m)
    std::vector<NodeId> coefficients; ///< c_fg, shape (m, m)
};

class Squares {
  public:
    Squares(Graph& graph, const FibreHessian& hessian) : graph_(graph), y_(hessian.y)
    {
        const NodeId roots[] = {hessian.lagrangian};
        // Degrees in y, from the operands up; 2 stands for everything that is not affine.
        for (const NodeId node : reachable(graph, roots)) degrees_[node] = degree(node);
        split({graph.constant(1), hessian.lagrangian});
        for (const auto& [factor, f, g] : products_) distribute(factor, f, g);
        if (found_) make_forms();
    }

    [[nodiscard]] bool found() const { return found_ && (!squares_.empty() || !forms_.empty()); }
    [[nodiscard]] const std::vector<Part>& squares() const { return squares_; }
    [[nodiscard]] const std::vector<Form>& forms() const { return forms_; }

  private:
    [[nodiscard]] int degree(NodeId node) const
    {
        if (std::find(y_.begin(), y_.end(), node) != y_.end()) return 1;
        const auto operands = graph_.operands(node);
        const auto of = [&](std::size_t k) { return degrees_.at(operands[k]); };
        int greatest = 0;
        for (std::size_t k = 0; k < operands.size(); ++k) greatest = std::max(greatest, of(k));
        if (greatest == 0) return 0;
        switch (kind_of(graph_.op(node))) {
        case OpKind::sum: return greatest;
        case OpKind::product: return std::min(2, of(0) + of(1));
        case OpKind::quotient: return of(1) == 0 ? of(0) : 2;
        case OpKind::leaf:
        case OpKind::power:
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice:
        case OpKind::system: break;
        }
        return 2;
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
            const Op op = graph_.op(part.node);
            const OpKind kind = kind_of(op);
            if (kind == OpKind::sum) {
                for (std::size_t k = 0; k < operands.size(); ++k)
                    open.push_back({term_sign(op, k) > 0 ? part.factor : graph_.negate(part.factor), operands[k]});
            } else if (kind == OpKind::product && degrees_.at(operands[0]) > 0 && degrees_.at(operands[1]) > 0) {
                take_product(part.factor, operands[0], operands[1], open);
            } else if (kind == OpKind::product) {
                const std::size_t plain = degrees_.at(operands[0]) == 0 ? 0 : 1;
                open.push_back({graph_.multiply(part.factor, operands[plain]), operands[1 - plain]});
            } else {
                compose(part, operands, open);
            }
        }
    }

    /// `node` without its factors that do not depend on y, which are multiplied into `factor`.
    [[nodiscard]] NodeId stripped(NodeId node, NodeId& factor)
    {
        for (;;) {
            const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
            const Op op = graph_.op(node);
            if (op == Op::negate) {
                factor = graph_.negate(factor);
                node = operands[0];
            } else if (op == Op::multiply && degrees_.at(operands[0]) == 0) {
                factor = graph_.multiply(factor, operands[0]);
                node = operands[1];
            } else if (op == Op::multiply && degrees_.at(operands[1]) == 0) {
                factor = graph_.multiply(factor, operands[1]);
                node = operands[0];
            } else if (op == Op::divide && degrees_.at(operands[1]) == 0) {
                factor = graph_.divide(factor, operands[1]);
                node = operands[0];
            } else {
                return node;
            }
        }
    }

    /// m f g is a square where f and g differ by a factor that does not depend on y; else both must be affine.
    void take_product(NodeId factor, NodeId f, NodeId g, std::vector<Part>& open)
    {
        f = stripped(f, factor);
        g = stripped(g, factor);
        if (f == g) {
            const NodeId twice = graph_.multiply(graph_.constant(2), factor);
            squares_.push_back({twice, f});
            open.push_back({graph_.multiply(twice, f), f});
            return;
        }
        found_ = degrees_.at(f) == 1 && degrees_.at(g) == 1;
        products_.push_back({factor, std::min(f, g), std::max(f, g)});
        whole_.insert(std::min(f, g));
    }

    /// g, the later one of the two, is a sum of others as a rule: of w_j in w_i (J w)_i.
    void distribute(NodeId product, NodeId f, NodeId g)
    {
        std::vector<Part> open{{product, g}};
        while (!open.empty() && found_) {
            auto [factor, node] = open.back();
            open.pop_back();
            node = stripped(node, factor);
            if (degrees_.at(node) == 0) continue; // affine with f
            const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
            const Op op = graph_.op(node);
            if (!whole_.contains(node) && (op == Op::add || op == Op::subtract)) {
                open.push_back({factor, operands[0]});
                open.push_back({op == Op::add ? factor : graph_.negate(factor), operands[1]});
                found_ = open.size() + entries_.size() < most_squares;
                continue;
            }
            entries_[{f, node}].push_back(f == node ? graph_.multiply(graph_.constant(2), factor) : factor);
            if (f != node) entries_[{node, f}].push_back(factor);
        }
    }

    /// A form for each class of functions that are coupled by products. Squares of these functions with factors that do
    /// not depend on y belong to it.
    void make_forms()
    {
        for (auto square = squares_.begin(); square != squares_.end();) {
            const NodeId factor[] = {square->factor};
            const auto coupled = entries_.lower_bound({square->node, 0});
            const bool inside = coupled != entries_.end() && coupled->first.first == square->node;
            if (inside && !depends_on_any(graph_, factor, y_)) {
                entries_[{square->node, square->node}].push_back(square->factor);
                square = squares_.erase(square);
            } else {
                ++square;
            }
        }
        std::set<NodeId> seen;
        for (const auto& [start, unused] : entries_) {
            if (!seen.insert(start.first).second) continue;
            Form form{{start.first}, {}};
            for (std::size_t next = 0; next < form.nodes.size(); ++next)
                for (const auto& [pair, terms] : entries_)
                    if (pair.first == form.nodes[next] && seen.insert(pair.second).second)
                        form.nodes.push_back(pair.second);
            for (const NodeId f : form.nodes)
                for (const NodeId g : form.nodes) {
                    const auto at = entries_.find({f, g});
                    form.coefficients.push_back(at == entries_.end() ? graph_.constant(0) : graph_.sum(at->second));
                }
            forms_.push_back(std::move(form));
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
        const Smoothness smoothness = operator_of(op).smoothness;
        found_ = found_ && (smoothness == Smoothness::meromorphic || smoothness == Smoothness::analytic ||
                            smoothness == Smoothness::cut);
        if (!found_) return;
        const NodeId z = graph_.input("argument of a function");
        std::replace(operands.begin(), operands.end(), f, z);
        const NodeId g = graph_.make(op, graph_.payload(part.node), operands);
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
    struct Product {
        NodeId factor, f, g;
    };
    std::vector<Part> squares_;
    std::vector<Product> products_;
    std::set<NodeId> whole_; ///< functions that products are written in
    std::map<std::pair<NodeId, NodeId>, std::vector<NodeId>> entries_;
    std::vector<Form> forms_;
    bool found_ = true;
};

/// Sylvester's criterion.
bool proves_definite(Graph& graph, const Form& form, const ZeroDecider& decider)
{
    const std::size_t m = form.nodes.size();
    const std::vector<NodeId>& c = form.coefficients;
    if (std::ranges::all_of(c, [&](NodeId each) { return graph.is_constant(each); })) {
        std::vector<Rational> numbers;
        for (const NodeId each : c) numbers.push_back(graph.value(each));
        return is_positive_definite(numbers, m);
    }
    if (m > determinant_limit) return false;
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < m; ++k) {
        first.push_back(k);
        if (!decider.proves_positive(determinant_of(graph, c, m, first, first))) return false;
    }
    return true;
}

/// The nodes of the squares with a positive factor and of the definite forms; nothing where a factor may be negative or
/// a form is not shown to be definite.
std::optional<std::vector<NodeId>> positive_squares(Graph& graph, const Squares& squares, const ZeroDecider& decider)
{
    if (!squares.found()) return {};
    std::map<NodeId, bool> positive;
    std::vector<NodeId> nodes;
    for (const auto& [factor, node] : squares.squares()) {
        if (positive.count(factor) == 0) positive[factor] = decider.proves_positive(factor);
        if (!positive[factor] && !decider.proves_nonnegative(factor)) return {};
        if (positive[factor]) nodes.push_back(node);
    }
    for (const Form& form : squares.forms()) {
        if (!proves_definite(graph, form, decider)) return {};
        nodes.insert(nodes.end(), form.nodes.begin(), form.nodes.end());
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

/// Whether the sum of the squares is positive: one that is a number makes it so, whatever the others are.
bool have_positive_squares(Graph& graph, const std::vector<NodeId>& slopes, const ZeroDecider& decider)
{
    std::vector<NodeId> squares;
    for (const NodeId slope : slopes) {
        if (graph.is_constant(slope) && !graph.is_zero(slope)) return true;
        squares.push_back(graph.power(slope, 2));
    }
    return decider.proves_positive(graph.sum(squares));
}

} // namespace

bool proves_semidefinite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return positive_squares(graph, Squares(graph, hessian), decider).has_value();
}

bool proves_definite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const std::size_t r = hessian.y.size();
    if (r == 0) return false;
    const auto nodes = positive_squares(graph, Squares(graph, hessian), decider);
    if (!nodes) return false;
    std::vector<std::vector<NodeId>> rows; // J_i
    for (const NodeId node : *nodes) rows.push_back(gradient(graph, node, hessian.y));
    std::vector<bool> closed(r, false);
    for (std::size_t count = 0; count < r;) {
        std::map<std::size_t, std::vector<NodeId>> entries;
        for (const std::vector<NodeId>& row : rows)
            if (const std::size_t a = only_open(graph, row, closed); a < r) entries[a].push_back(row[a]);
        bool progress = false;
        for (const auto& [a, slopes] : entries) {
            if (!have_positive_squares(graph, slopes, decider)) continue;
            closed[a] = progress = true;
            ++count;
        }
        if (!progress) return false;
    }
    return true;
}

} // namespace lagen
