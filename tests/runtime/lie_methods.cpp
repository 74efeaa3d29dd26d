// SPDX-License-Identifier: GPL-2.0-or-later
/// Methods on groups: charts, step control, refusals.
#include "support/group_models.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using support::hat, support::Matrix, support::off_group, support::Vector;
using Body = support::TurningBody;
using Top = support::LiePoissonTop;

namespace {

template <class M>
void check_representation(const M& model)
{
    const typename M::State s = M::start();
    for (int k = 0; k < 10; ++k) {
        const AlgebraElement<M> u = AlgebraElement<M>::Random(), v = AlgebraElement<M>::Random();
        const auto A = [&](const AlgebraElement<M>& xi, const typename M::State& x) {
            return typename M::State(model.algebra_action(0, x, xi));
        };
        const typename M::State commutator = A(u, A(v, s)) - A(v, A(u, s));
        CHECK((commutator + A(M::algebra_bracket(u, v), s)).norm() < 1e-14);
        CHECK(commutator.norm() > 1e-3);
    }
}

} // namespace

TEST_CASE("the groups of the models by hand act as their brackets say", "[group]")
{
    check_representation(Body{});
    check_representation(Top{});
}

TEST_CASE("the inverse differential of the exponential map is that of rotations", "[group]")
{
    const Vector theta(0.9, -1.1, 0.7), xi(0.3, 0.2, -0.8);
    const double angle = theta.norm();
    Vector rate;
    REQUIRE(detail::InverseDifferential<Body>()(Body{}, theta, xi, rate));
    // R = exp(hat theta), R' = R hat xi:  theta' = xi + theta x xi / 2 + (1 - x cot x) theta x (theta x xi) / |theta|^2
    const double x = angle / 2, factor = (1 - x / std::tan(x)) / (angle * angle);
    const Vector closed = xi + theta.cross(xi) / 2 + factor * theta.cross(theta.cross(xi));
    CHECK((rate - closed).norm() < 1e-15);
    // the same by a difference of R
    const double h = 1e-5;
    const auto R = [&](double t) {
        const Vector v = theta + t * rate;
        return Matrix(Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix());
    };
    CHECK((R(0).transpose() * (R(h) - R(-h)) / (2 * h) - hat(xi)).norm() < 1e-9);
    CHECK_FALSE(detail::InverseDifferential<Body>()(Body{}, Vector(0, 0, 3), Vector(1, 0, 0), rate));
}

TEST_CASE("DOP853 on a group meets its tolerance, at rows inside steps as well, which lie on the group", "[group]")
{
    const Body body{.spring = 1.4};
    const std::vector<double> times{0.31, 1.77, 4.0, 9.9};
    const auto exact = integrate(body, Body::start(), {0.0, 10.0}, Verner98{.tolerance = 1e-14}, {.at = times});
    double before = 1;
    for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
        const auto run = integrate(body, Body::start(), {0.0, 10.0}, RkmkDop853{.tolerance = tolerance}, {.at = times});
        REQUIRE(run);
        double worst = 0;
        for (std::size_t k = 0; k < times.size(); ++k) {
            worst = std::max(worst, (run.states[k] - exact.states[k]).norm());
            CHECK(off_group(Body::attitude(run.states[k])) < 1e-14);
        }
        CAPTURE(tolerance, worst, run.steps, run.rejected, run.rhs_calls);
        CHECK(worst < 30 * tolerance);
        CHECK(worst < before / 50);
        before = worst;
        const auto plain = integrate(body, Body::start(), {0.0, 10.0}, Dop853{.tolerance = tolerance});
        CHECK(static_cast<double>(run.rhs_calls) < 2 * static_cast<double>(plain.rhs_calls));
    }
}

TEST_CASE("a step that turns too far for its chart is refused, and the state stays", "[group]")
{
    Body::State s = Body::start();
    s.head<3>() = Vector(0, 0, 40);
    const auto run = integrate(Body{}, s, {0.0, 1.0}, Rkmk4{.step = 0.1});
    CHECK(run.status() == Status::ok); // about a principal axis xi stays along theta
    s[0] = 1;
    const auto turned = integrate(Body{}, s, {0.0, 1.0}, Rkmk4{.step = 0.2});
    CHECK(turned.status() == Status::branch_lost);
    CHECK(turned.state == s);
    CHECK(integrate(Body{}, s, {0.0, 1.0}, RkmkDop853{.tolerance = 1e-9}));
    CHECK(integrate(Top{}, Top::start(), {0.0, 20.0}, LiePoisson2{.step = 10}).status() == Status::newton_diverged);
}
