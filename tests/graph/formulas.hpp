// SPDX-License-Identifier: GPL-2.0-or-later
/// Shared by the tests of the graph: seeded random expressions, and mechanical right-hand sides made by the graph's own
/// derivatives, as the kernels make them.
#pragma once

#include "graph/calculus/differentiate.hpp"
#include "graph/core/graph.hpp"

#include <string>
#include <vector>

namespace lagen::test {

/// A small linear congruential generator: the same numbers on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 2654435761U + 12345U) {}
    /// 0 .. n - 1.
    std::size_t below(std::size_t n)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>(state_ >> 33U) % n;
    }

  private:
    std::uint64_t state_;
};

/// A random rational expression of `steps` operations in x, y, z; no division by sums that may vanish unless
/// `divisions`.
inline NodeId random_rational(Graph& g, Random& random, int steps, bool divisions)
{
    std::vector<NodeId> pool{g.input("x"), g.input("y"), g.input("z"), g.constant(2), g.constant(Rational(-3, 2))};
    for (int k = 0; k < steps; ++k) {
        const NodeId a = pool[random.below(pool.size())];
        const NodeId b = pool[random.below(pool.size())];
        switch (random.below(divisions ? 7 : 6)) {
        case 0: pool.push_back(g.add(a, b)); break;
        case 1: pool.push_back(g.subtract(a, b)); break;
        case 2:
        case 3: pool.push_back(g.multiply(a, b)); break;
        case 4: pool.push_back(g.power(a, 2)); break;
        case 5: pool.push_back(g.negate(a)); break;
        default: pool.push_back(g.divide(a, g.add(g.constant(1), g.power(b, 2))));
        }
    }
    NodeId sum = g.constant(0);
    for (std::size_t k = pool.size() - 3; k < pool.size(); ++k) sum = g.add(sum, pool[k]);
    return sum;
}

/// Lagrange's equations on a tangent bundle: accelerations from W ydot = dL/dx - (d2L/dy dx) y.
inline std::vector<NodeId> accelerations(Graph& g, NodeId lagrangian, const std::vector<NodeId>& x,
                                         const std::vector<NodeId>& y)
{
    const auto force = gradient(g, lagrangian, x);
    const auto momenta = gradient(g, lagrangian, y);
    std::vector<std::pair<NodeId, NodeId>> along;
    for (std::size_t i = 0; i < x.size(); ++i) along.emplace_back(x[i], y[i]);
    const auto drift = directional(g, momenta, along);
    const auto mass = jacobian(g, momenta, y);
    std::vector<NodeId> matrix;
    std::vector<NodeId> right;
    for (std::size_t i = 0; i < y.size(); ++i) {
        matrix.insert(matrix.end(), mass[i].begin(), mass[i].end());
        right.push_back(g.subtract(force[i], drift[i]));
    }
    return g.solve(matrix, right, MatrixStructure::positive_definite);
}

/// Euler-Poincare equations of a heavy top with I = diag(I1, I2, I3): w and gamma.
inline std::vector<NodeId> heavy_top(Graph& g)
{
    std::vector<NodeId> w;
    std::vector<NodeId> gamma;
    std::vector<NodeId> inertia;
    for (const char* k : {"1", "2", "3"}) {
        gamma.push_back(g.input(std::string("g") + k));
        w.push_back(g.input(std::string("w") + k));
        inertia.push_back(g.input(std::string("I") + k));
    }
    NodeId kinetic = g.constant(0);
    for (std::size_t k = 0; k < 3; ++k)
        kinetic = g.add(kinetic, g.multiply(g.multiply(g.constant(Rational(1, 2)), inertia[k]), g.power(w[k], 2)));
    const NodeId lagrangian = g.subtract(kinetic, g.multiply(g.input("mgl"), gamma[2]));
    const auto momenta = gradient(g, lagrangian, w);
    const auto slope = gradient(g, lagrangian, gamma);
    const auto cross = [&](const std::vector<NodeId>& a, const std::vector<NodeId>& b, std::size_t k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        return g.subtract(g.multiply(a[i], b[j]), g.multiply(a[j], b[i]));
    };
    const auto mass = jacobian(g, momenta, w);
    std::vector<NodeId> matrix;
    std::vector<NodeId> right;
    std::vector<NodeId> result;
    for (std::size_t k = 0; k < 3; ++k) {
        result.push_back(cross(gamma, w, k));
        right.push_back(g.add(cross(momenta, w, k), cross(slope, gamma, k)));
        matrix.insert(matrix.end(), mass[k].begin(), mass[k].end());
    }
    for (const NodeId a : g.solve(matrix, right, MatrixStructure::positive_definite)) result.push_back(a);
    return result;
}

/// Kepler in the plane, L = (u^2 + v^2)/2 + k/sqrt(x^2 + y^2).
inline std::vector<NodeId> kepler(Graph& g)
{
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const NodeId u = g.input("u");
    const NodeId v = g.input("v");
    const NodeId kinetic = g.divide(g.add(g.power(u, 2), g.power(v, 2)), g.constant(2));
    const NodeId radius = g.apply(Op::sqrt, g.add(g.power(x, 2), g.power(y, 2)));
    return accelerations(g, g.add(kinetic, g.divide(g.input("k"), radius)), {x, y}, {u, v});
}

/// Double pendulum by positions of the two masses, absolute angles.
inline std::vector<NodeId> double_pendulum(Graph& g)
{
    const std::vector<NodeId> q{g.input("q1"), g.input("q2")};
    const std::vector<NodeId> v{g.input("v1"), g.input("v2")};
    const NodeId half = g.constant(Rational(1, 2));
    NodeId vx = g.constant(0);
    NodeId vy = g.constant(0);
    NodeId height = g.constant(0);
    NodeId lagrangian = g.constant(0);
    for (std::size_t k = 0; k < 2; ++k) {
        const NodeId m = g.input("m" + std::to_string(k + 1));
        const NodeId l = g.input("l" + std::to_string(k + 1));
        vx = g.add(vx, g.multiply(g.multiply(l, g.apply(Op::cos, q[k])), v[k]));
        vy = g.add(vy, g.multiply(g.multiply(l, g.apply(Op::sin, q[k])), v[k]));
        height = g.subtract(height, g.multiply(l, g.apply(Op::cos, q[k])));
        const NodeId square = g.add(g.power(vx, 2), g.power(vy, 2));
        lagrangian = g.add(lagrangian, g.multiply(g.multiply(half, m), square));
        lagrangian = g.subtract(lagrangian, g.multiply(g.multiply(m, g.input("grav")), height));
    }
    return accelerations(g, lagrangian, q, v);
}

} // namespace lagen::test
