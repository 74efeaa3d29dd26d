// SPDX-License-Identifier: GPL-2.0-or-later
/// A function taken apart from the outside in, and its products gathered into quadratic forms.
#include "verify/convex_parts.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t most_parts = 2000; ///< of one function

/// factor * node, where the factor of a product of affine functions does not depend on y.
struct Term {
    NodeId factor;
    NodeId node;
};

class Parts {
  public:
    Parts(Graph& graph, NodeId f, const std::vector<NodeId>& y) : graph_(graph), y_(y), is_y_(y.begin(), y.end())
    {
        const NodeId roots[] = {f};
        // Degrees in y, from the operands up; 2 stands for everything that is not affine.
        for (const NodeId node : reachable(graph, roots)) degrees_[node] = degree(node);
        split({graph.constant(1), f});
        for (const auto& [factor, first, second] : products_) distribute(factor, first, second);
        if (found_) gather();
    }

    [[nodiscard]] std::vector<ConvexPart> parts() const { return found_ ? parts_ : std::vector<ConvexPart>{}; }

  private:
    [[nodiscard]] int degree(NodeId node) const
    {
        if (is_y_.contains(node)) return 1;
        const auto operands = graph_.operands(node);
        const auto of = [&](std::size_t k) { return degrees_.at(operands[k]); };
        int greatest = 0;
        for (std::size_t k = 0; k < operands.size(); ++k) greatest = std::max(greatest, of(k));
        if (greatest == 0) return 0;
        const OpKind kind = kind_of(graph_.op(node));
        if (kind == OpKind::sum) return greatest;
        if (kind == OpKind::product) return std::min(2, of(0) + of(1));
        return kind == OpKind::quotient && of(1) == 0 ? of(0) : 2;
    }

    [[nodiscard]] std::vector<NodeId> operands_of(NodeId node) const
    {
        return {graph_.operands(node).begin(), graph_.operands(node).end()};
    }

    /// Without factors of the node that do not depend on y, which are multiplied into `factor`.
    [[nodiscard]] Term stripped(Term term)
    {
        for (;;) {
            const std::vector<NodeId> operands = operands_of(term.node);
            const Op op = graph_.op(term.node);
            if (op == Op::negate) {
                term = {graph_.negate(term.factor), operands[0]};
            } else if (op == Op::multiply && degrees_.at(operands[0]) == 0) {
                term = {graph_.multiply(term.factor, operands[0]), operands[1]};
            } else if (op == Op::multiply && degrees_.at(operands[1]) == 0) {
                term = {graph_.multiply(term.factor, operands[1]), operands[0]};
            } else if (op == Op::divide && degrees_.at(operands[1]) == 0) {
                term = {graph_.divide(term.factor, operands[1]), operands[0]};
            } else {
                return term;
            }
        }
    }

    void push_summands(std::vector<Term>& open, const Term& sum)
    {
        const std::vector<NodeId> operands = operands_of(sum.node);
        for (std::size_t k = 0; k < operands.size(); ++k) {
            const bool plus = term_sign(graph_.op(sum.node), k) > 0;
            open.push_back({plus ? sum.factor : graph_.negate(sum.factor), operands[k]});
        }
    }

    void split(const Term& root)
    {
        std::vector<Term> open{root};
        while (!open.empty() && found_) {
            const Term term = stripped(open.back());
            open.pop_back();
            if (degrees_.at(term.node) <= 1) continue; // nothing of W
            found_ = parts_.size() + products_.size() + open.size() < most_parts;
            const OpKind kind = kind_of(graph_.op(term.node));
            if (kind == OpKind::sum)
                push_summands(open, term);
            else if (kind == OpKind::product)
                take_product(term, open);
            else
                compose(term, open);
        }
    }

    /// m f g is a square where f and g differ by a factor that does not depend on y; else both must be affine.
    void take_product(const Term& product, std::vector<Term>& open)
    {
        const std::vector<NodeId> operands = operands_of(product.node);
        const Term first = stripped({product.factor, operands[0]});
        const Term second = stripped({first.factor, operands[1]});
        const NodeId f = std::min(first.node, second.node), g = std::max(first.node, second.node);
        if (f == g) {
            const NodeId square = graph_.power(f, 2);
            degrees_[square] = 2;
            open.push_back({second.factor, square});
            return;
        }
        found_ = degrees_.at(f) == 1 && degrees_.at(g) == 1;
        products_.push_back({second.factor, f, g});
        whole_.insert(f);
    }

    /// g, the later one of the two, is a sum of others as a rule: of w_j in w_i (J w)_i.
    void distribute(NodeId product, NodeId f, NodeId g)
    {
        std::vector<Term> open{{product, g}};
        while (!open.empty() && found_) {
            const auto [factor, node] = stripped(open.back());
            open.pop_back();
            if (degrees_.at(node) == 0) continue; // affine with f
            if (!whole_.contains(node) && kind_of(graph_.op(node)) == OpKind::sum) {
                push_summands(open, {factor, node});
                found_ = open.size() + entries_.size() < most_parts;
                continue;
            }
            entries_[{f, node}].push_back(f == node ? graph_.multiply(graph_.constant(2), factor) : factor);
            if (f != node) entries_[{node, f}].push_back(factor);
        }
    }

    /// A part for each class of functions that are coupled by products.
    void gather()
    {
        std::vector<NodeId> functions;
        for (const auto& [pair, unused] : entries_)
            if (functions.empty() || functions.back() != pair.first) functions.push_back(pair.first);
        const auto place = [&](NodeId f) {
            return static_cast<std::size_t>(std::ranges::lower_bound(functions, f) - functions.begin());
        };
        const std::size_t count = functions.size();
        std::vector<bool> is_entry(count * count, false);
        for (const auto& [pair, unused] : entries_) is_entry[place(pair.first) * count + place(pair.second)] = true;
        const auto coupled = [&](std::size_t i, std::size_t j) { return is_entry[i * count + j]; };
        for (const std::vector<std::size_t>& members : connected_classes(count, coupled)) {
            ConvexPart& part = parts_.emplace_back();
            for (const std::size_t i : members) {
                part.functions.push_back(functions[i]);
                for (const std::size_t j : members) {
                    const auto at = entries_.find({functions[i], functions[j]});
                    part.coefficients.push_back(at == entries_.end() ? graph_.constant(0) : graph_.sum(at->second));
                }
            }
        }
    }

    /// m g(f) where one operand f alone depends on y, or is f in all places where g has one that does.
    void compose(const Term& term, std::vector<Term>& open)
    {
        std::vector<NodeId> operands = operands_of(term.node);
        NodeId f = term.node;
        for (const NodeId operand : operands) {
            if (degrees_.at(operand) == 0) continue;
            found_ = found_ && (f == term.node || f == operand);
            f = operand;
        }
        const Op op = graph_.op(term.node);
        const Smoothness smoothness = operator_of(op).smoothness;
        found_ = found_ && (smoothness == Smoothness::meromorphic || smoothness == Smoothness::analytic ||
                            smoothness == Smoothness::cut);
        if (!found_) return;
        const NodeId z = graph_.input("argument of a function");
        std::replace(operands.begin(), operands.end(), f, z);
        const NodeId g = graph_.make(op, graph_.payload(term.node), operands);
        const NodeId argument[] = {z};
        const NodeId first = gradient(graph_, g, argument)[0];
        const NodeId derivatives[] = {first, gradient(graph_, first, argument)[0]};
        const std::pair<NodeId, NodeId> back[] = {{z, f}};
        const std::vector<NodeId> there = substitute(graph_, derivatives, back);
        open.push_back({graph_.multiply(term.factor, there[0]), f});
        if (!graph_.is_zero(there[1])) add_square(graph_.multiply(term.factor, there[1]), f);
    }

    /// m df df^T. Of an affine f with a plain factor it joins the products of f.
    void add_square(NodeId m, NodeId f)
    {
        if (degrees_.at(f) == 1 && !depends_on_any(graph_, std::vector{m}, y_))
            entries_[{f, f}].push_back(m);
        else
            parts_.push_back({{f}, {m}});
    }

    struct Product {
        NodeId factor, f, g;
    };

    Graph& graph_;
    const std::vector<NodeId>& y_;
    std::set<NodeId> is_y_;
    std::map<NodeId, int> degrees_;
    std::vector<ConvexPart> parts_;
    std::vector<Product> products_;
    std::set<NodeId> whole_; ///< functions that products are written in
    std::map<std::pair<NodeId, NodeId>, std::vector<NodeId>> entries_;
    bool found_ = true;
};

} // namespace

std::vector<ConvexPart> convex_parts(Graph& graph, NodeId f, const std::vector<NodeId>& y)
{
    return Parts(graph, f, y).parts();
}

} // namespace lagen
