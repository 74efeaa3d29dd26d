// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method for h(x) = 0 with steps of least length: dx = -J^T lambda, (J J^T) lambda = h.
#include "scene/project_start.hpp"

#include "expression/linear_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lagen {

namespace {

long double term_sum(const Tree& constraint, const Values& values)
{
    if (constraint->kind != TreeKind::add) return 0;
    long double sum = 0;
    for (const Tree& term : constraint->arguments) sum += std::fabs(evaluate(term, values).value);
    return sum;
}

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
        long double& x = values.at(model.base.coordinates[i].name).value;
        for (std::size_t a = 0; a < h.size(); ++a) x -= h[a].gradient[i] * lambda[a];
    }
    return true;
}

} // namespace

std::vector<ConstraintValue> constraint_values(const Model& model, Values values)
{
    std::vector<ConstraintValue> out;
    for (const Tree& constraint : model.base.constraints) {
        ConstraintValue h;
        h.value = evaluate(constraint, values).value;
        for (const Symbol& coordinate : model.base.coordinates) {
            Dual& x = values.at(coordinate.name);
            x.derivative = 1;
            h.gradient.push_back(evaluate(constraint, values).derivative);
            x.derivative = 0;
            h.scale += std::fabs(x.value * h.gradient.back());
        }
        h.scale = std::max(h.scale, term_sum(constraint, values));
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
