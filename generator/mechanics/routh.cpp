// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/routh.hpp"

#include "diagnostic.hpp"
#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// The velocities W^-1 right by Cramer's rule, over one determinant.
std::vector<NodeId> solved(Graph& graph, const std::vector<NodeId>& W, const std::vector<NodeId>& right,
                           NodeId determinant)
{
    const std::size_t k = right.size();
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < k; ++i) all.push_back(i);
    std::vector<NodeId> out;
    for (std::size_t column = 0; column < k; ++column) {
        std::vector<NodeId> replaced = W;
        for (std::size_t row = 0; row < k; ++row) replaced[row * k + column] = right[row];
        out.push_back(graph.divide(determinant_of(graph, replaced, k, all, all), determinant));
    }
    return out;
}

} // namespace

Routhian routhian(Graph& graph, const System& system, std::vector<std::size_t> cyclic)
{
    Routhian made;
    std::vector<NodeId> y, mu;
    for (std::size_t a = 0; a < system.r(); ++a)
        if (std::ranges::find(cyclic, a) == cyclic.end())
            made.rest.push_back(system.algebroid.y[a]);
        else
            y.push_back(system.algebroid.y[a]), mu.push_back(system.mu[a]);
    std::ranges::sort(cyclic);
    made.cyclic = std::move(cyclic);
    const NodeId L = *system.lagrangian;
    const std::vector<NodeId> p = gradient(graph, L, y);
    const std::vector<NodeId> W = joined_rows(jacobian(graph, p, y));
    if (depends_on_any(graph, W, y))
        throw MathematicsError(
            fmt::format("the momenta of the cyclic coordinates of model '{}' are not affine in their velocities: these "
                        "have no formula",
                        system.name),
            "`run --form hamilton` keeps the momenta without reducing");
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < y.size(); ++i) all.push_back(i);
    made.determinant = determinant_of(graph, W, y.size(), all, all);
    if (graph.is_zero(made.determinant))
        throw MathematicsError(fmt::format("the momenta of the cyclic coordinates of model '{}' do not determine their "
                                           "velocities: det d2L/dy2 is 0 in them",
                                           system.name),
                               "leave out a coordinate whose velocity L does not have, or has in a sum with another");
    std::vector<std::pair<NodeId, NodeId>> at_rest;
    for (const NodeId each : y) at_rest.emplace_back(each, graph.constant(0));
    std::vector<NodeId> right = substitute(graph, p, at_rest);
    for (std::size_t k = 0; k < y.size(); ++k) right[k] = graph.subtract(mu[k], right[k]);
    made.velocities = solved(graph, W, right, made.determinant);
    // L is quadratic in the cyclic velocities: R = L(y^k = 0) - (p - b)_k Theta^k / 2.
    const NodeId only[] = {L};
    made.value = substitute(graph, only, at_rest)[0];
    for (std::size_t k = 0; k < y.size(); ++k)
        made.value = graph.subtract(
            made.value, graph.multiply(graph.constant(Rational(1, 2)), graph.multiply(right[k], made.velocities[k])));
    return made;
}

std::vector<NodeId> euler_lagrange(Graph& graph, const System& system, NodeId F,
                                   const std::vector<std::size_t>& sections, const std::vector<NodeId>& ydot)
{
    const std::vector<NodeId>&x = system.algebroid.x, &y = system.algebroid.y;
    std::vector<NodeId> p;
    for (const std::size_t a : sections) p.push_back(gradient(graph, F, std::vector<NodeId>{y[a]})[0]);
    std::vector<std::pair<NodeId, NodeId>> along{{system.time, graph.constant(1)}};
    for (std::size_t i = 0; i < x.size(); ++i) along.emplace_back(x[i], y[i]);
    for (std::size_t a = 0; a < y.size(); ++a) along.emplace_back(y[a], ydot[a]);
    std::vector<NodeId> out = directional(graph, p, along);
    for (std::size_t k = 0; k < sections.size(); ++k)
        out[k] = graph.subtract(out[k], gradient(graph, F, std::vector<NodeId>{x[sections[k]]})[0]);
    return out;
}

} // namespace lagen
