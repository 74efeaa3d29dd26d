// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method for h(x) = 0 with steps of least length: dx = -J^T lambda, (J J^T) lambda = h.
#include "scene/project_start.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lagen {

namespace {

/// One Newton step; false where the gradients are dependent.
bool step(const Model& model, Values& values, const std::vector<ConstraintValue>& h)
{
    const std::size_t n = model.base.coordinates.size();
    const std::size_t m = h.size();
    std::vector<long double> JJt(m * m, 0);
    std::vector<long double> right;
    for (std::size_t a = 0; a < m; ++a) {
        right.push_back(h[a].value);
        for (std::size_t b = 0; b < m; ++b) {
            for (std::size_t i = 0; i < n; ++i) JJt[a * m + b] += h[a].gradient[i] * h[b].gradient[i];
        }
    }
    const Factorisation<long double> factors = factorise(std::move(JJt), m);
    if (!factors.regular) return false;
    const std::vector<long double> lambda = substitute(factors, right);
    for (std::size_t i = 0; i < n; ++i) {
        long double& x = values.at(model.base.coordinates[i].name);
        for (std::size_t a = 0; a < h.size(); ++a) x -= h[a].gradient[i] * lambda[a];
    }
    return true;
}

} // namespace

std::vector<ConstraintValue> constraint_values(const Model& model, const Values& values)
{
    Graph graph;
    Lowering lower(graph);
    std::vector<NodeId> coordinates;
    std::vector<long double> x;
    for (const Symbol& coordinate : model.base.coordinates) {
        coordinates.push_back(graph.input(coordinate.name));
        x.push_back(values.at(coordinate.name));
    }
    std::vector<ConstraintValue> out;
    for (const Tree& constraint : model.base.constraints) {
        std::vector<NodeId> nodes{lower(constraint)};
        const std::vector<NodeId> slopes = gradient(graph, nodes[0], coordinates);
        nodes.insert(nodes.end(), slopes.begin(), slopes.end());
        if (constraint->kind == TreeKind::add)
            for (const Tree& term : constraint->arguments) nodes.push_back(lower(term));
        const std::vector<long double> found = evaluate<long double>(graph, nodes, values);
        const auto terms = found.begin() + 1 + static_cast<std::ptrdiff_t>(x.size());
        ConstraintValue h{found[0], 0, {found.begin() + 1, terms}};
        for (std::size_t i = 0; i < x.size(); ++i) h.scale += std::fabs(x[i] * h.gradient[i]);
        h.scale = std::max(h.scale, std::accumulate(terms, found.end(), 0.0L, [](long double sum, long double term) {
                               return sum + std::fabs(term);
                           }));
        out.push_back(std::move(h));
    }
    return out;
}

bool project_start(const Model& model, Values& values)
{
    constexpr int most_steps = 50;
    constexpr long double target = 1e-17L;
    constexpr long double acceptable = 1e-15L;
    const auto all_hold = [](const std::vector<ConstraintValue>& h, long double tolerance) {
        for (const ConstraintValue& each : h) {
            if (!each.holds(tolerance)) return false;
        }
        return true;
    };
    for (int k = 0; k < most_steps; ++k) {
        const std::vector<ConstraintValue> h = constraint_values(model, values);
        if (all_hold(h, target)) return true;
        if (!step(model, values, h)) return false;
    }
    return all_hold(constraint_values(model, values), acceptable);
}

} // namespace lagen
