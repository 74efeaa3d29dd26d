// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/almost_everywhere.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/substitute.hpp"
#include "graph/core/operators.hpp"
#include "proof/rational_matrix.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t most_roots = 3;

bool is_root(Op op)
{
    return op == Op::sqrt || op == Op::abs;
}

class AlmostEverywhere {
  public:
    AlmostEverywhere(Graph& graph, const ProofSetting& setting, const ZeroDecider& decider)
        : graph_(graph), setting_(setting), decider_(decider),
          on_domain_(graph, without_definedness(setting), decider.budget())
    {
    }

    bool holds(NodeId f)
    {
        const NodeId only[] = {f};
        const std::vector<NodeId> nodes = reachable(graph_, only);
        if (!stands_on_irreducible(only)) return false;
        std::vector<NodeId> roots;
        for (const NodeId node : nodes) {
            const Op op = graph_.op(node);
            if (is_root(op))
                roots.push_back(node);
            else if (!is_meromorphic(op) && !(is_convex() && is_analytic(node)))
                return false;
        }
        if (roots.size() > most_roots) return false;
        for (const NodeId root : roots)
            for (const NodeId below : reachable(graph_, graph_.operands(root)))
                if (is_root(graph_.op(below))) return false;
        NodeId product = f;
        for (std::size_t signs = 1; signs < std::size_t{1} << roots.size(); ++signs)
            product = graph_.multiply(product, with_signs(f, nodes, roots, signs));
        return decider_.status(product) == ProofStatus::refuted;
    }

    bool all_analytic(const std::vector<NodeId>& functions)
    {
        return stands_on_irreducible(functions) && std::ranges::all_of(reachable(graph_, functions), [&](NodeId node) {
                   // Solutions of linear systems are quotients of determinants.
                   return is_meromorphic(graph_.op(node)) || kind_of(graph_.op(node)) == OpKind::system ||
                          (is_convex() && is_analytic(node));
               });
    }

  private:
    /// Where the functions of the model are defined need not be connected: on all of the domain.
    static ProofSetting without_definedness(ProofSetting setting)
    {
        setting.defined.clear();
        return setting;
    }

    /// The functions do not depend on what is constrained, or the constraints are level sets c + x^T A x / 2 = 0, A
    /// regular and c not zero, of two variables or more each, of its own: smooth and irreducible over the complex
    /// numbers. (x^2 = 1 or x y = 0 fall into parts.)
    bool stands_on_irreducible(std::span<const NodeId> functions)
    {
        std::vector<NodeId> constrained;
        bool irreducible = true;
        for (const NodeId constraint : setting_.constraints) {
            const NodeId only[] = {constraint};
            const std::vector<NodeId> all = jacobian(graph_, only, setting_.variables).front();
            std::vector<NodeId> x, slopes;
            for (std::size_t k = 0; k < all.size(); ++k) {
                if (graph_.is_zero(all[k])) continue;
                irreducible = irreducible && std::ranges::find(constrained, setting_.variables[k]) == constrained.end();
                x.push_back(setting_.variables[k]);
                slopes.push_back(all[k]);
            }
            constrained.insert(constrained.end(), x.begin(), x.end());
            irreducible = irreducible && is_regular_quadric(constraint, x, slopes);
        }
        return irreducible || !depends_on_any(graph_, functions, constrained);
    }

    bool is_regular_quadric(NodeId constraint, const std::vector<NodeId>& x, const std::vector<NodeId>& slopes)
    {
        std::vector<Rational> A;
        for (const NodeId entry : joined_rows(jacobian(graph_, slopes, x))) {
            if (!graph_.is_constant(entry)) return false;
            A.push_back(graph_.value(entry));
        }
        std::vector<std::pair<NodeId, NodeId>> origin;
        for (const NodeId variable : x) origin.emplace_back(variable, graph_.constant(0));
        std::vector<NodeId> there = slopes;
        there.push_back(constraint);
        there = substitute(graph_, there, origin);
        const NodeId level = there.back();
        there.pop_back();
        return x.size() >= 2 && rank_of(A, x.size()) == x.size() &&
               std::ranges::all_of(there, [&](NodeId slope) { return graph_.is_zero(slope); }) &&
               on_domain_.proves_nonzero(level);
    }

    /// f with the roots whose bit is set negated.
    NodeId with_signs(NodeId f, const std::vector<NodeId>& nodes, const std::vector<NodeId>& roots, std::size_t signs)
    {
        Rebuilder walk(graph_, graph_.size());
        for (const NodeId node : nodes) {
            const auto root = std::ranges::find(roots, node);
            const bool negated = root != roots.end() && (signs >> (root - roots.begin()) & 1U) != 0;
            negated ? walk.set(node, graph_.negate(node)) : walk.rebuild(node);
        }
        return walk[f];
    }

    bool is_affine(NodeId f)
    {
        std::vector<NodeId> inputs = setting_.variables;
        inputs.insert(inputs.end(), setting_.parameters.begin(), setting_.parameters.end());
        const NodeId only[] = {f};
        return !depends_on_any(graph_, jacobian(graph_, only, inputs).front(), inputs);
    }

    /// The domain is given by affine inequalities alone.
    bool is_convex()
    {
        const auto is_half_space = [&](NodeId condition) {
            if (graph_.is_constant(condition)) return true; // for the parameter values of the file
            const std::vector<NodeId> sides(graph_.operands(condition).begin(), graph_.operands(condition).end());
            return graph_.op(condition) != Op::not_equal && is_affine(graph_.subtract(sides[0], sides[1]));
        };
        return setting_.constraints.empty() && std::ranges::all_of(setting_.domain, is_half_space);
    }

    /// On the whole domain, or its part where affine operands are positive, which is convex too.
    bool is_analytic(NodeId f)
    {
        const NodeId only[] = {f};
        return std::ranges::all_of(reachable(graph_, only), [&](NodeId node) { return is_analytic_here(node); });
    }

    /// As a function of its operands, at all their values. What makes a condition positive is an interval of the first
    /// operand.
    bool is_analytic_here(NodeId node)
    {
        const Smoothness smoothness = operator_of(graph_.op(node)).smoothness;
        if (smoothness != Smoothness::meromorphic && smoothness != Smoothness::analytic) return false;
        switch (smooth_where(graph_, node)) {
        case Sense::always: return true;
        case Sense::nonzero: return on_domain_.proves_nonzero(condition_of(graph_, node));
        case Sense::nonnegative:
        case Sense::positive:
            return is_affine(graph_.operands(node)[0]) || on_domain_.proves_positive(condition_of(graph_, node));
        case Sense::off_origin:
        case Sense::off_cut:
        case Sense::same_branch:
        case Sense::regular: break;
        }
        return false;
    }

    Graph& graph_;
    const ProofSetting& setting_;
    const ZeroDecider& decider_;
    const ZeroDecider on_domain_;
};

} // namespace

bool is_nonzero_almost_everywhere(Graph& graph, NodeId f, const ProofSetting& setting, const ZeroDecider& decider)
{
    return AlmostEverywhere(graph, setting, decider).holds(f);
}

bool are_analytic(Graph& graph, const std::vector<NodeId>& functions, const ProofSetting& setting,
                  const ZeroDecider& decider)
{
    return AlmostEverywhere(graph, setting, decider).all_analytic(functions);
}

} // namespace lagen
