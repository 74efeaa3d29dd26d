// SPDX-License-Identifier: GPL-2.0-or-later
/// The right-hand side through the steps of an elimination, and the solution back through them.
#include "graph/elimination/sparse_hessian.hpp"

#include <algorithm>
#include <map>

namespace lagen {
namespace {

/// A variable that needs so many terms is split; of more the products would cost more than the wait.
constexpr std::size_t most_split_terms = 3;

/// From the last step to the first, z of every variable. Where a variable needs terms that wait for the one found just
/// before, z', it is written (what does not need z') - (slope) z': the next is one operation away from it.
class BackSubstitution {
  public:
    BackSubstitution(Graph& graph, const Elimination& elimination)
        : graph_(graph), elimination_(elimination), z_(elimination.is_term.size(), graph.constant(0))
    {
    }

    std::vector<NodeId> run(const std::vector<NodeId>& force)
    {
        for (std::size_t k = elimination_.steps.size(); k-- > 0;) {
            const Elimination::Step& step = elimination_.steps[k];
            if (elimination_.is_term[step.variable])
                define(step);
            else
                solve(step, force[step.variable]);
        }
        return std::move(z_);
    }

  private:
    /// A term as older + slope z'.
    struct Split {
        NodeId older = 0;
        NodeId slope = 0;
    };

    void define(const Elimination::Step& step)
    {
        NodeId value = graph_.constant(0);
        Split split{graph_.constant(0), graph_.constant(0)};
        for (const auto& [variable, factor] : step.terms) {
            value = graph_.add(value, graph_.multiply(factor, z_[variable]));
            const Split part = split_of(variable);
            split.older = graph_.add(split.older, graph_.multiply(factor, part.older));
            split.slope = graph_.add(split.slope, graph_.multiply(factor, part.slope));
        }
        z_[step.variable] = value;
        splits_[step.variable] = split;
    }

    void solve(const Elimination::Step& step, NodeId force)
    {
        NodeId value = graph_.multiply(force, graph_.divide(graph_.constant(1), step.pivot));
        NodeId slope = graph_.constant(0);
        const bool few = step.terms.size() <= most_split_terms;
        for (const auto& [variable, factor] : step.terms) {
            const Split part = few ? split_of(variable) : Split{z_[variable], graph_.constant(0)};
            value = graph_.subtract(value, graph_.multiply(factor, part.older));
            slope = graph_.add(slope, graph_.multiply(factor, part.slope));
        }
        z_[step.variable] = graph_.subtract(value, graph_.multiply(slope, last_));
        last_ = z_[step.variable];
        splits_.clear();
        splits_[step.variable] = {graph_.constant(0), graph_.constant(1)};
    }

    [[nodiscard]] Split split_of(std::size_t variable)
    {
        const auto found = splits_.find(variable);
        return found == splits_.end() ? Split{z_[variable], graph_.constant(0)} : found->second;
    }

    Graph& graph_;
    const Elimination& elimination_;
    std::vector<NodeId> z_;
    NodeId last_ = 0;                     ///< z'
    std::map<std::size_t, Split> splits_; ///< of z' and the terms defined since
};

} // namespace

std::vector<NodeId> solve_by(Graph& graph, const Elimination& elimination, std::span<const NodeId> right)
{
    if (right.size() != elimination.order) throw InternalError("solve_by() wants one entry of b for every variable");
    std::vector<NodeId> force(elimination.is_term.size(), graph.constant(0));
    std::copy(right.begin(), right.end(), force.begin());
    for (const Elimination::Step& step : elimination.steps)
        for (const auto& [variable, factor] : step.terms) {
            const NodeId product = graph.multiply(factor, force[step.variable]);
            force[variable] = elimination.is_term[step.variable] ? graph.add(force[variable], product)
                                                                 : graph.subtract(force[variable], product);
        }
    std::vector<NodeId> z = BackSubstitution(graph, elimination).run(force);
    z.resize(elimination.order);
    return z;
}

} // namespace lagen
