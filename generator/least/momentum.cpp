// SPDX-License-Identifier: GPL-2.0-or-later
/// A conserved function F = F_0 + c s_i, with c free of s_i and proved nonzero, gives s_i = (F - F_0)/c with F a
/// constant of the start. Momenta whose rates cancel in a sum with whole coefficients are tried as one function.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/simplify/simplify.hpp"
#include "least/rational_span.hpp"
#include "least/reduction.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// A lane by a conserved function.
struct Solution {
    NamedNode function;
    std::size_t lane = 0;
    NodeId coefficient = 0;
    std::vector<NodeId> relations;
    double weight = 0;    ///< operations of the coefficient
    long double size = 0; ///< of the coefficient at a point
};

/// Sums of the candidates, with rational coefficients, whose rate vanishes at some points; those of one term apart.
std::vector<NamedNode> sums_of(Reduction& reduction, const std::vector<NamedNode>& changing)
{
    Graph& graph = reduction.graph();
    std::vector<NodeId> rates;
    for (const NamedNode& each : changing) rates.push_back(reduction.rate_of(each.node));
    RationalSpan span(rates.size());
    for (const NamedNumbers& point : reduction.prover.points()) span.add(evaluate<long double>(graph, rates, point));
    std::vector<NamedNode> sums;
    for (const std::vector<Rational>& row : span.kernel()) {
        NamedNode sum{graph.constant(0), ""};
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (row[k] == 0) continue;
            sum.node = graph.add(sum.node, graph.multiply(graph.constant(row[k]), changing[k].node));
            sum.name +=
                (sum.name.empty() ? "" : " + ") + (row[k] == 1 ? "" : row[k].get_str() + "*") + changing[k].name;
        }
        sums.push_back(std::move(sum));
    }
    return sums;
}

class Solver {
  public:
    explicit Solver(Reduction& reduction) : reduction_(reduction), graph_(reduction.graph()) {}

    /// Ways to solve for a lane, the simplest coefficient first, of these the largest.
    [[nodiscard]] std::vector<Solution> solutions()
    {
        std::vector<NamedNode> changing;
        for (const NamedNode& candidate : reduction_.system.candidates) {
            const NodeId root[] = {candidate.node};
            if (!depends_on_any(graph_, root, reduction_.system.lanes)) continue;
            if (!add(candidate)) changing.push_back(candidate);
        }
        if (changing.size() > 1)
            for (const NamedNode& sum : sums_of(reduction_, changing)) (void)add(sum);
        std::ranges::stable_sort(found_, [](const Solution& a, const Solution& b) {
            return a.weight != b.weight ? a.weight < b.weight : a.size > b.size;
        });
        return std::move(found_);
    }

  private:
    /// False where it is not proved to be conserved.
    bool add(const NamedNode& function)
    {
        const LaneSystem& system = reduction_.system;
        const auto needed = reduction_.prover.vanishing({reduction_.rate_of(function.node)});
        if (!needed || !reduction_.survives_jumps(function.node)) return false;
        for (std::size_t i = 0; i < system.lanes.size(); ++i) {
            const NodeId lane[] = {system.lanes[i]};
            const std::vector<NodeId> slope = simplify(graph_, gradient(graph_, function.node, lane));
            if (graph_.is_zero(slope[0]) || depends_on_any(graph_, slope, lane)) continue;
            if (reduction_.prover.points().empty() || !reduction_.prover.vanishes_nowhere(slope[0])) continue;
            const long double size = std::abs(evaluate<long double>(graph_, slope, reduction_.prover.points()[0])[0]);
            found_.push_back({function, i, slope[0], *needed, count_operations(graph_, slope).weight, size});
        }
        return true;
    }

    Reduction& reduction_;
    Graph& graph_;
    std::vector<Solution> found_;
};

} // namespace

bool solve_by_conserved(Reduction& reduction)
{
    for (const Solution& solution : Solver(reduction).solutions()) {
        Graph& graph = reduction.graph();
        const NodeId lane = reduction.system.lanes[solution.lane];
        const NodeId constant = graph.input("start of " + solution.function.name);
        const Replacements without{{lane, graph.constant(0)}};
        const auto rest = substitute_where_defined(graph, std::vector{solution.function.node}, without);
        if (!rest) continue;
        const NodeId value = graph.divide(graph.subtract(constant, (*rest)[0]), solution.coefficient);
        Reduction next = reduction;
        next.prover.bind(solution.relations);
        next.constants.push_back({constant, reduction.at_start(solution.function.node), solution.function.name});
        if (!next.prover.restrict_to({}, {constant}) || !next.define(lane, value)) continue;
        next.steps.push_back({.rule = "momentum",
                              .lane = reduction.name_of(lane),
                              .value = value,
                              .relations = solution.relations,
                              .conserved = solution.function.name});
        reduction = std::move(next);
        return true;
    }
    return false;
}

} // namespace lagen
