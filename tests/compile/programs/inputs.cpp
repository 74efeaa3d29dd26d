// SPDX-License-Identifier: GPL-2.0-or-later
/// A program that holds a pole up by setting the force of its cart every 10 ms: prints the last angle; what the force
/// does to the rates, by differences and by the Jacobian; and the torques that accelerations of an arm take.
#include "arm.hpp"
#include "cart_pole.hpp"

#include "lagen/integrate.hpp"

#include <cmath>
#include <cstdio>

template class lagen::models::arm<float>;
template class lagen::models::arm<long double>;

namespace {

using Cart = lagen::models::cart_pole<double>;
using Arm = lagen::models::arm<double>;
constexpr double pi = 3.141592653589793;

double force(const Cart::State& s)
{
    return 60 * (pi - s[1]) - 12 * s[3] + 8 * s[0] + 9 * s[2] + 2 * s[4];
}

/// The angle from the top after ten seconds, by runs of one period each.
template <class Method>
double angle_by_runs(const Method& method)
{
    Cart cart;
    Cart::State s = Cart::state({.x = 0, .th = 2.8}, {}, {});
    for (int k = 0; k < 1000; ++k) {
        cart.inputs.F = force(s);
        const auto run = lagen::integrate(cart, s, {0.01 * k, 0.01 * (k + 1)}, method);
        if (!run) return 100;
        s = run.state;
    }
    return s[1] - pi;
}

/// The same by an Integrator that holds the force.
template <class Method>
double angle_by_steps(const Method& method)
{
    lagen::Integrator integrator(Cart{}, Cart::state({.x = 0, .th = 2.8}, {}, {}), 0.0, method);
    for (int k = 0; k < 1000; ++k) {
        if (integrator.hold({.F = force(integrator.state())}) != lagen::Status::ok) return 100;
        if (integrator.advance_to(0.01 * (k + 1)) != lagen::Status::ok) return 100;
    }
    return integrator.state()[1] - pi;
}

/// The largest difference of the torques from those that gave the rates.
double torques()
{
    Arm arm;
    arm.inputs = {3, -2};
    const Arm::State s = Arm::state({.a = 0.3, .b = 0.7}, {.w_a = -0.4, .w_b = 1.1});
    Arm::State rates;
    Eigen::Vector2d u;
    if (arm.rhs(0, s, rates) != lagen::Status::ok) return 100;
    arm.inputs = {};
    if (arm.inverse_dynamics(0, s, rates.tail<2>(), u) != lagen::Status::ok) return 100;
    return (u - Eigen::Vector2d(3, -2)).cwiseAbs().maxCoeff();
}

} // namespace

int main()
{
    const double by_runs = angle_by_runs(lagen::Dop853{.tolerance = 1e-12});
    std::printf("angle end %.3g %s\n", std::abs(by_runs), Cart::input_names[0]);
    std::printf("angle held %.3g %.3g %.3g\n", std::abs(by_runs - angle_by_steps(lagen::Dop853{.tolerance = 1e-12})),
                std::abs(by_runs - angle_by_steps(lagen::Dopri5{.tolerance = 1e-12})),
                std::abs(by_runs - angle_by_steps(lagen::Gauss8{.step = 0.005})));

    Cart cart;
    const Cart::State s = Cart::state({.x = 0.3, .th = 0.7}, {.u = -0.4, .w = 1.1}, {});
    Cart::State left, right;
    cart.input(0) = 1;
    if (cart.rhs(0, s, left) != lagen::Status::ok) return 1;
    cart.inputs.F = 3;
    if (cart.rhs(0, s, right) != lagen::Status::ok) return 1;
    const auto jacobian = cart.input_jacobian(0, s);
    static_assert(jacobian.RowsAtCompileTime == Cart::dimension && jacobian.ColsAtCompileTime == 1);
    std::printf("jacobian difference %.3g %.3g\n", ((right - left) / 2 - jacobian).cwiseAbs().maxCoeff(),
                jacobian.cwiseAbs().maxCoeff());

    Eigen::Vector2d u;
    Arm arm;
    const lagen::Status dead = arm.inverse_dynamics(0, Arm::state({}, {}), {0, 0}, u);
    std::printf("inverse dynamics %.3g %s\n", torques(), lagen::to_text(dead));
    return 0;
}
