// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method for h(x) = 0, c(x) = c(x_0) with steps of least length: dx = -J^T lambda, (J J^T) lambda = h.
#include "scene/project_start.hpp"

#include "expression/linear_algebra.hpp"
#include "geometry/orthonormal_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lagen {

namespace {

constexpr long double dependent_slopes = 1e-9L;

/// One Newton step; false where the gradients are dependent.
bool step(const std::vector<std::string>& coordinates, Values& values, const std::vector<ConstraintValue>& h)
{
    const std::size_t n = coordinates.size();
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
        long double& x = values.at(coordinates[i]);
        for (std::size_t a = 0; a < h.size(); ++a) x -= h[a].gradient[i] * lambda[a];
    }
    return true;
}

} // namespace

ConstraintFunctions::ConstraintFunctions(const Model& model)
{
    Lowering lower(graph_);
    std::vector<NodeId> x;
    for (const Symbol& coordinate : model.base.coordinates) {
        coordinates_.push_back(coordinate.name);
        x.push_back(graph_.input(coordinate.name));
    }
    const auto append = [&](Functions& functions, const Tree& tree) {
        std::vector<NodeId>& nodes = functions.emplace_back(1, lower(tree));
        const std::vector<NodeId> slopes = gradient(graph_, nodes[0], x);
        nodes.insert(nodes.end(), slopes.begin(), slopes.end());
        if (tree->kind == TreeKind::add)
            for (const Tree& term : tree->arguments) nodes.push_back(lower(term));
    };
    for (const Tree& constraint : model.base.constraints) append(constraints_, constraint);
    for (const NamedTree& casimir : model.base.casimirs) append(casimirs_, casimir.value);
    for (const Tree& casimir : model.base.found_casimirs) append(casimirs_, casimir);
}

std::vector<ConstraintValue> ConstraintFunctions::at(const Values& values) const
{
    return at(constraints_, values);
}

std::vector<ConstraintValue> ConstraintFunctions::casimirs_at(const Values& values) const
{
    return at(casimirs_, values);
}

std::vector<ConstraintValue> ConstraintFunctions::at(const Functions& functions, const Values& values) const
{
    std::vector<ConstraintValue> out;
    for (const std::vector<NodeId>& nodes : functions) {
        const std::vector<long double> found = evaluate<long double>(graph_, nodes, values);
        const auto terms = found.begin() + 1 + static_cast<std::ptrdiff_t>(coordinates_.size());
        ConstraintValue h{found[0], 0, {found.begin() + 1, terms}};
        for (std::size_t i = 0; i < coordinates_.size(); ++i)
            h.scale += std::fabs(values.at(coordinates_[i]) * h.gradient[i]);
        h.scale = std::max(h.scale, std::accumulate(terms, found.end(), 0.0L, [](long double sum, long double term) {
                               return sum + std::fabs(term);
                           }));
        out.push_back(std::move(h));
    }
    return out;
}

bool project_start(const ConstraintFunctions& constraints, Values& values)
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
    const std::vector<ConstraintValue> start = constraints.casimirs_at(values);
    const auto conditions = [&] {
        std::vector<ConstraintValue> h = constraints.at(values), casimirs = constraints.casimirs_at(values);
        OrthonormalSpan span(dependent_slopes);
        for (const ConstraintValue& each : h) (void)span.add(each.gradient);
        for (std::size_t k = 0; k < casimirs.size(); ++k) {
            casimirs[k].value -= start[k].value;
            if (span.add(casimirs[k].gradient)) h.push_back(std::move(casimirs[k]));
        }
        return h;
    };
    for (int k = 0; k < most_steps; ++k) {
        const std::vector<ConstraintValue> h = conditions();
        if (all_hold(h, target)) return true;
        if (!step(constraints.coordinates(), values, h)) return false;
    }
    return all_hold(conditions(), acceptable);
}

} // namespace lagen
