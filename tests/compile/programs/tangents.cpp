// SPDX-License-Identifier: GPL-2.0-or-later
/// Tangent vectors along a trajectory of a generated model (`lagen::WithTangents` on its kernel `variational`) by three
/// other routes, in long double. Prints for each model: the size of what the flow changes, |V - 1|; the largest
/// difference of V from central differences of the flow, from dV/dt = J V with the kernel `jacobian`; and that of the
/// volume from the one that the motion keeps, det(V) det(W) / det(W at the start) - 1.
#include "lagen/tangents.hpp"
#include "lagen/integrate.hpp"

#include "double_pendulum.hpp"
#include "heavy_top.hpp"

#include <Eigen/LU>

#include <cstdio>

using namespace lagen;

namespace {

using Real = long double;

/// The same equations from the Jacobian.
template <class M>
struct ByJacobian {
    using Scalar = Real;
    static constexpr int n = M::dimension, dimension = n * (1 + n);
    using State = Eigen::Matrix<Real, dimension, 1>;
    M model;

    Status rhs(Real t, const State& all, State& derivative) const noexcept
    {
        const typename M::State s = all.template head<n>();
        typename M::State ds;
        const Status status = model.rhs(t, s, ds);
        derivative.template head<n>() = ds;
        const Eigen::Matrix<Real, n, n> J = model.jacobian(t, s);
        for (int k = 0; k < n; ++k)
            derivative.template segment<n>(n * (1 + k)) = J * all.template segment<n>(n * (1 + k));
        return status;
    }
};

/// The derivative of a Runge-Kutta method's flow is its flow of the variational equations, whatever the step.
constexpr Rk4 method{.step = 1.0 / 1024};
constexpr Real end = 2;

template <class M>
auto flow(const M& model, const typename M::State& s)
{
    const auto run = integrate(model, s, {Real(0), end}, method);
    if (!run) std::printf("%s\n", to_text(run.status()));
    return run.state;
}

template <class M>
void compare(const char* name, const typename M::State& start)
{
    constexpr int n = M::dimension;
    using Square = Eigen::Matrix<Real, n, n>;
    using Tangents = WithTangents<M, n>;
    const M model;
    const auto all = flow(Tangents{model}, Tangents::state(start, Square::Identity()));
    const Square V = Tangents::tangents(all);
    const auto again = flow(ByJacobian<M>{model}, Tangents::state(start, Square::Identity()));
    Square differences;
    const Real h = 1e-6L;
    for (int k = 0; k < n; ++k) {
        typename M::State above = start, below = start;
        above[k] += h;
        below[k] -= h;
        differences.col(k) = (flow(model, above) - flow(model, below)) / (2 * h);
    }
    const typename M::State last = all.template head<n>();
    const Real kept =
        V.determinant() * model.mass_matrix(end, last).determinant() / model.mass_matrix(0, start).determinant();
    std::printf("tangents %s %.3Le %.3Le %.3Le %.3Le\n", name, (V - Square::Identity()).cwiseAbs().maxCoeff(),
                (V - differences).cwiseAbs().maxCoeff(), (V - Tangents::tangents(again)).cwiseAbs().maxCoeff(),
                std::abs(kept - 1));
}

} // namespace

int main()
{
    using Top = models::heavy_top<Real>;
    compare<Top>("heavy_top", Top::state({.g1 = 0.36L, .g2 = 0.48L, .g3 = 0.8L}, {.w1 = 1.1L, .w2 = -0.7L, .w3 = 2}));
    using Pendulum = models::double_pendulum<Real>;
    compare<Pendulum>("double_pendulum", Pendulum::state({.a = 1.2L, .b = -0.4L}, {.u = 0.3L, .v = 1}));
}
