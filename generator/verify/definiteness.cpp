// SPDX-License-Identifier: GPL-2.0-or-later
/// Sylvester's criterion, part by part or block by block, and the elimination of the fibre coordinates.
#include "verify/definiteness.hpp"

#include "expression/linear_algebra.hpp"
#include "geometry/section.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "mechanics/fibre_hessian.hpp"
#include "proof/rational_matrix.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {

namespace {

// The sign rule: W = d2L/dy2 of a Lagrangian that is written as a sum of functions of one variable each, which may be
// sums of such functions themselves, from
//   d2 (m g(f)) = m g'(f) d2f + m g''(f) df df^T,
// so that m (J y + c)^2 gives 2 m J J^T and -m sqrt(1 - |y|^2) gives m/sqrt(..) 1 + m/sqrt(..)^3 y y^T. Products of
// functions f that are affine in y give quadratic forms c_fg f g, and these sum_fg c_fg df dg^T. L is convex where all
// c are positive semidefinite: sums of convex functions are convex.
// A function taken apart from the outside in, and its products gathered into quadratic forms.

/// A part sum_fg c_fg df dg^T of W, where c is symmetric.
struct ConvexPart {
    std::vector<NodeId> functions;    ///< f, shape (m); affine in y where m > 1
    std::vector<NodeId> coefficients; ///< c_fg, shape (m, m), by rows
};

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

/// The parts whose sum is d2f/dy2, of any sign; nothing where f is not written in that way, or is affine in y.
std::vector<ConvexPart> convex_parts(Graph& graph, NodeId f, const std::vector<NodeId>& y)
{
    return Parts(graph, f, y).parts();
}

/// True where a matrix has one entry, which is nowhere negative.
bool is_nonnegative_number(const std::vector<NodeId>& entries, const ZeroDecider& decider)
{
    return entries.size() == 1 && decider.proves_nonnegative(entries[0]);
}

/// The functions of the definite parts; nothing where a part may be negative, or there are none.
std::optional<std::vector<NodeId>> definite_functions(Graph& graph, const FibreHessian& hessian,
                                                      const ZeroDecider& decider)
{
    const std::vector<ConvexPart> parts = convex_parts(graph, hessian.lagrangian, hessian.y);
    if (parts.empty()) return {};
    std::map<std::vector<NodeId>, bool> known; // many squares have the same factor
    std::vector<NodeId> functions;
    for (const auto& [f, c] : parts) {
        const auto [at, first] = known.emplace(c, false);
        if (first) at->second = proves_matrix_definite(graph, c, f.size(), decider);
        if (at->second)
            functions.insert(functions.end(), f.begin(), f.end());
        else if (!is_nonnegative_number(c, decider))
            return {};
    }
    return functions;
}

/// The one entry of a row whose coordinate is still open; null where there are none or several.
const ColumnEntry* only_open(const Column& row, const std::vector<bool>& closed)
{
    const ColumnEntry* only = nullptr;
    for (const ColumnEntry& entry : row) {
        if (closed[entry.index]) continue;
        if (only != nullptr) return nullptr;
        only = &entry;
    }
    return only;
}

/// True where the sum of the squares is proved positive: one that is a number makes it so, whatever the others are.
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

std::vector<Rational> numbers_of(const Graph& graph, const std::vector<NodeId>& nodes)
{
    std::vector<Rational> numbers;
    for (const NodeId node : nodes) {
        if (!graph.is_constant(node)) return {};
        numbers.push_back(graph.value(node));
    }
    return numbers;
}

bool proves_matrix_definite(Graph& graph, const std::vector<NodeId>& entries, std::size_t m, const ZeroDecider& decider)
{
    if (const std::vector<Rational> numbers = numbers_of(graph, entries); !numbers.empty())
        return is_positive_definite(numbers, m);
    if (m > determinant_limit) return false;
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < m; ++k) {
        first.push_back(k);
        if (!decider.proves_positive(determinant_of(graph, entries, m, first, first))) return false;
    }
    return true;
}

bool proves_semidefinite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return definite_functions(graph, hessian, decider).has_value() ||
           std::ranges::all_of(hessian.blocks, [&](const std::vector<std::size_t>& block) {
               const std::vector<NodeId> entries = hessian.submatrix(block);
               return is_nonnegative_number(entries, decider) ||
                      proves_matrix_definite(graph, entries, block.size(), decider);
           });
}

bool proves_definite_by_parts(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const std::size_t r = hessian.y.size();
    const auto functions = definite_functions(graph, hessian, decider);
    if (!functions) return false;
    BaseGradient slopes_of(graph, hessian.y);
    std::vector<Column> rows; // df
    for (const NodeId f : *functions) rows.push_back(slopes_of.of(f));
    std::vector<bool> closed(r, false);
    for (std::size_t count = 0; count < r;) {
        std::map<std::size_t, std::vector<NodeId>> entries;
        for (const Column& row : rows)
            if (const ColumnEntry* entry = only_open(row, closed)) entries[entry->index].push_back(entry->value);
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

bool proves_definite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return proves_definite_by_parts(graph, hessian, decider) ||
           std::ranges::all_of(hessian.blocks, [&](const std::vector<std::size_t>& block) {
               return proves_matrix_definite(graph, hessian.submatrix(block), block.size(), decider);
           });
}

} // namespace lagen
