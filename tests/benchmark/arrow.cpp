// SPDX-License-Identifier: GPL-2.0-or-later
/// Nanoseconds a step of the discrete heavy top: lagen::Discrete on the generated header, a code of the same map by
/// hand, and the explicit RK4 of the heavy top. Compiled by scripts/arrow-table; the argument is the number of steps.
#include "lagen/lagen.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "heavy_top.hpp"
#include "heavy_top_discrete.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using Discrete = lagen::models::heavy_top_discrete_discrete<double>;

Matrix hat(const Vector& v)
{
    Matrix m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
}

Vector axial(const Matrix& m)
{
    return {m(2, 1), m(0, 2), m(1, 0)};
}

/// Pi' = W^T Pi + mgl h^2 G' x e, G' = W^T G, and W' J - J W'^T = hat(Pi') by Newton's method in the increments
/// W' <- W' cay(d), from the step before and its last change: as one would write it for this body alone.
struct ByHand {
    Vector I{1.2, 2.1, 2.9}, e{0.48, 0.6, 0.64}, J;
    double mgl = 1.7, h = 0.05;
    Matrix W;
    Vector G{0.6, 0, 0.8}, Pi, drift = Vector::Zero();
    std::size_t iterations = 0;

    ByHand()
    {
        const double half = I.sum() / 2;
        J = Vector(half - I[0], half - I[1], half - I[2]);
    }

    [[nodiscard]] Vector momentum(const Matrix& R) const
    {
        return {R(2, 1) * J[1] - J[2] * R(1, 2), R(0, 2) * J[2] - J[0] * R(2, 0), R(1, 0) * J[0] - J[1] * R(0, 1)};
    }

    static Matrix cayley(const Vector& d)
    {
        const Vector v = d / 2;
        const double factor = 2 / (1 + v.squaredNorm());
        return Matrix::Identity() + factor * (hat(v) + hat(v) * hat(v));
    }

    void step()
    {
        const Vector next = W.transpose() * G;
        Pi = W.transpose() * Pi + mgl * h * h * next.cross(e);
        G = next;
        // Back to the group, and ahead.
        W = cayley(2 * axial(W - W.transpose()) / (1 + W.trace())) * cayley(drift);
        Vector total = drift;
        for (int k = 0; k < 20; ++k) {
            ++iterations;
            const Vector residual = Pi - momentum(W);
            Matrix WJ = W;
            for (int j = 0; j < 3; ++j) WJ.col(j) *= J[j];
            const Matrix N = (WJ.trace() * Matrix::Identity() - WJ) * W;
            const Vector d = N.inverse() * residual;
            W = W * cayley(d);
            total += d;
            if (d.squaredNorm() < 1e-17) break; // what is left is of the order of its square
        }
        drift = total;
    }
};

Discrete::State start(const Discrete& model, ByHand& hand)
{
    hand.W = ByHand::cayley({0.06, 0.03, 0.1});
    hand.Pi = hand.momentum(hand.W);
    Discrete::State s = Discrete::State::Zero();
    s.head<3>() = hand.G;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) s[3 + 3 * i + j] = hand.W(i, j) - (i == j ? 1 : 0);
    return lagen::at_arrow(model, 0.0, s);
}

template <class Run>
double nanoseconds(std::size_t steps, const Run& run)
{
    const auto begin = std::chrono::steady_clock::now();
    run();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    return 1e9 * seconds.count() / static_cast<double>(steps);
}

double median(std::array<double, 5> times)
{
    std::sort(times.begin(), times.end());
    return times[2];
}

} // namespace

int main(int argc, char** argv)
{
    const std::size_t steps = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    const Discrete model;
    std::array<double, 5> ours{}, theirs{}, rk4{};
    double difference = 0, iterations = 0, by_hand = 0;
    for (std::size_t round = 0; round < 5; ++round) {
        ByHand hand;
        const Discrete::State s = start(model, hand);
        ours[round] = nanoseconds(steps, [&] {
            const auto run =
                lagen::integrate(model, s, {0.0, model.step() * static_cast<double>(steps)}, lagen::Discrete{});
            iterations = static_cast<double>(run.newton_iterations) / static_cast<double>(steps);
            if (!run) std::printf("the run ended with %s\n", to_text(run.status()));
        });
        theirs[round] = nanoseconds(steps, [&] {
            for (std::size_t k = 0; k < steps; ++k) hand.step();
        });
        by_hand = static_cast<double>(hand.iterations) / static_cast<double>(steps);
        const lagen::models::heavy_top<double> top;
        using Top = lagen::models::heavy_top<double>;
        Top::State y = Top::State::Zero();
        for (int i = 0; i < y.size(); ++i) y[i] = 0.3 + 0.1 * i;
        y.head<3>() = Vector(0.6, 0, 0.8);
        rk4[round] = nanoseconds(steps, [&] {
            const auto run =
                lagen::integrate(top, y, {0.0, 0.05 * static_cast<double>(steps)}, lagen::Rk4{.step = 0.05});
            if (run.state[0] > 1e9) std::printf("the run of RK4 blew up\n");
        });
    }
    ByHand hand;
    const Discrete::State s = start(model, hand);
    const auto run = lagen::integrate(model, s, {0.0, 100 * model.step()}, lagen::Discrete{});
    for (int k = 0; k < 100; ++k) hand.step();
    for (int i = 0; i < 3; ++i) difference = std::max(difference, std::abs(run.state[i] - hand.G[i]));
    std::printf("steps of the heavy top, h = %g, median of 5 runs of %zu steps\n", model.step(), steps);
    std::printf("  lagen::Discrete  %7.1f ns   %.2f Newton iterations\n", median(ours), iterations);
    std::printf("  by hand          %7.1f ns   %.2f Newton iterations\n", median(theirs), by_hand);
    std::printf("  lagen::Rk4       %7.1f ns\n", median(rk4));
    std::printf("  Discrete over by hand %.3f, over RK4 %.3f; the two maps differ by %.1e after 100 steps\n",
                median(ours) / median(theirs), median(ours) / median(rk4), difference);
    return 0;
}
