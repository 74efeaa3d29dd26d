// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/routh.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

SingularMomenta::SingularMomenta(const std::string& model)
    : MathematicsError(fmt::format("the momenta of the cyclic coordinates of model '{}' do not determine their "
                                   "velocities: det d2L/dy2 is 0 in them",
                                   model),
                       "leave out a coordinate whose velocity L does not have, or has in a sum with another")
{
}

namespace {

/// L where the cyclic coordinates, on which it does not depend, are 0, or 1 where it is not defined there: algebra may
/// have left them in it, sin(x)^2 + cos(x)^2.
NodeId without_cyclic(Graph& graph, const System& system, const std::vector<std::size_t>& cyclic)
{
    const NodeId L[] = {*system.lagrangian};
    for (const int value : {0, 1}) {
        std::vector<std::pair<NodeId, NodeId>> there;
        for (const std::size_t k : cyclic) there.emplace_back(system.algebroid.x[k], graph.constant(value));
        if (const auto found = substitute_where_defined(graph, L, there)) return (*found)[0];
    }
    return L[0];
}

} // namespace

Routhian routhian(Graph& graph, const System& system, std::vector<std::size_t> cyclic)
{
    if (cyclic.size() > determinant_limit)
        throw MathematicsError(
            fmt::format("{} cyclic coordinates of model '{}' are too many to be reduced at once, where {} "
                        "are possible",
                        cyclic.size(), system.name, determinant_limit),
            "reduce by some of them, and what is written by the others");
    Routhian made;
    std::vector<NodeId> mu;
    std::vector<std::pair<NodeId, NodeId>> at_rest;
    for (const std::size_t k : cyclic) {
        made.y.push_back(system.algebroid.y[k]);
        mu.push_back(system.mu[k]);
        at_rest.emplace_back(made.y.back(), graph.constant(0));
    }
    made.cyclic = std::move(cyclic);
    const NodeId L = without_cyclic(graph, system, made.cyclic);
    made.momenta = gradient(graph, L, made.y);
    const std::vector<NodeId> W = joined_rows(jacobian(graph, made.momenta, made.y));
    if (depends_on_any(graph, W, made.y))
        throw MathematicsError(
            fmt::format("the momenta of the cyclic coordinates of model '{}' are not affine in their velocities: these "
                        "have no formula",
                        system.name),
            "`run --form hamilton` keeps the momenta without reducing");
    made.determinant = determinant_of(graph, W, mu.size());
    if (graph.is_zero(made.determinant)) throw SingularMomenta(system.name);
    std::vector<NodeId> right = substitute(graph, made.momenta, at_rest);
    for (std::size_t k = 0; k < mu.size(); ++k) right[k] = graph.subtract(mu[k], right[k]);
    const Places all = first_places(mu.size());
    made.velocities = CramersRule{graph, W, all.size(), all, all, right}.solution();
    // L is quadratic in the cyclic velocities: R = L(y^k = 0) - (p - b)_k Theta^k / 2.
    const NodeId only[] = {L};
    made.value = substitute(graph, only, at_rest)[0];
    for (std::size_t k = 0; k < mu.size(); ++k)
        made.value = graph.subtract(
            made.value, graph.multiply(graph.constant(Rational(1, 2)), graph.multiply(right[k], made.velocities[k])));
    return made;
}

std::vector<NodeId> euler_lagrange(Graph& graph, const System& system, NodeId F,
                                   const std::vector<std::size_t>& sections, const std::vector<NodeId>& ydot)
{
    const std::vector<NodeId>&x = system.algebroid.x, &y = system.algebroid.y;
    std::vector<NodeId> x_a, y_a;
    for (const std::size_t a : sections) x_a.push_back(x[a]), y_a.push_back(y[a]);
    std::vector<std::pair<NodeId, NodeId>> along{{system.time, graph.constant(1)}};
    for (std::size_t i = 0; i < x.size(); ++i) along.emplace_back(x[i], y[i]);
    for (std::size_t a = 0; a < y.size(); ++a) along.emplace_back(y[a], ydot[a]);
    std::vector<NodeId> out = directional(graph, gradient(graph, F, y_a), along);
    const std::vector<NodeId> slopes = gradient(graph, F, x_a);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = graph.subtract(out[k], slopes[k]);
    return out;
}

} // namespace lagen
