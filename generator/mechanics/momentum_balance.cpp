// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/momentum_balance.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// right_a -= p_c C^c_ab y^b. The two rows of a pair share the product p_c C^c_ab.
void subtract_brackets(Graph& graph, const Algebroid& algebroid, const MomentumBalance& balance,
                       std::vector<NodeId>& right)
{
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = 0; b < algebroid.r(); ++b)
            for (const ColumnEntry& C : algebroid.C(a, b)) {
                const NodeId moment = graph.multiply(C.value, balance.p[C.index]);
                right[a] = graph.subtract(right[a], graph.multiply(moment, balance.y[b]));
            }
}

/// C^c_ba is -C^c_ab as the graph writes it: what was completed from one order of the pair.
bool is_antisymmetric(Graph& graph, const Column& ab, const Column& ba)
{
    return std::ranges::equal(ab, ba, [&](const ColumnEntry& x, const ColumnEntry& y) {
        return x.index == y.index && (graph.negate(x.value) == y.value || graph.negate(y.value) == x.value);
    });
}

} // namespace

BaseSlopes base_slopes(Graph& graph, const System& system, NodeId f)
{
    std::vector<NodeId> variables = system.algebroid.x;
    variables.push_back(system.time);
    BaseSlopes slopes{gradient(graph, f, variables), 0};
    slopes.t = slopes.x.back();
    slopes.x.pop_back();
    return slopes;
}

std::vector<NodeId> base_velocity(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& y)
{
    std::vector<NodeId> xdot(algebroid.n(), graph.constant(0));
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (const ColumnEntry& rho : algebroid.anchor[a])
            xdot[rho.index] = graph.add(xdot[rho.index], graph.multiply(rho.value, y[a]));
    return xdot;
}

std::vector<NodeId> momentum_rates(Graph& graph, const Algebroid& algebroid, const MomentumBalance& balance)
{
    std::vector<NodeId> pdot(algebroid.r(), graph.constant(0));
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        for (const ColumnEntry& rho : algebroid.anchor[a])
            pdot[a] = graph.add(pdot[a], graph.multiply(rho.value, balance.df_dx[rho.index]));
        pdot[a] = graph.add(pdot[a], balance.forces[a]);
    }
    subtract_brackets(graph, algebroid, balance, pdot);
    return pdot;
}

NodeId energy_rate(Graph& graph, const Algebroid& algebroid, const MomentumBalance& balance)
{
    NodeId rate = graph.subtract(contraction(graph, balance.forces, balance.y), balance.df_dt);
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a; b < algebroid.r(); ++b) {
            if (a != b && is_antisymmetric(graph, algebroid.C(a, b), algebroid.C(b, a))) continue;
            const Column both = a == b ? algebroid.C(a, a) : sum(graph, algebroid.C(a, b), algebroid.C(b, a));
            for (const ColumnEntry& C : both) {
                const NodeId factors[] = {balance.p[C.index], C.value, balance.y[a], balance.y[b]};
                rate = graph.subtract(rate, graph.product(factors));
            }
        }
    return rate;
}

NodeId contraction(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b)
{
    NodeId sum = graph.constant(0);
    for (std::size_t k = 0; k < a.size(); ++k) sum = graph.add(sum, graph.multiply(a[k], b[k]));
    return sum;
}

} // namespace lagen
