// SPDX-License-Identifier: GPL-2.0-or-later
/// States that are no vectors move by their retraction.
#include "lagen/integrate.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <cmath>

using namespace lagen;

namespace {

/// q exp(delta / 2) of a unit quaternion q: the exponential of SO(3) in body coordinates. The product is brought back
/// to length 1, since a product of rounded factors is not.
Eigen::Quaterniond turned(const Eigen::Quaterniond& q, const Eigen::Vector3d& delta)
{
    const double angle = delta.norm(), sinc = angle < 1e-8 ? 0.5 : std::sin(angle / 2) / angle;
    const Eigen::Quaterniond step(std::cos(angle / 2), sinc * delta[0], sinc * delta[1], sinc * delta[2]);
    return (q * step).normalized();
}

namespace group {

/// An attitude; no Eigen column.
struct Attitude {
    Eigen::Quaterniond q;
};

Attitude retract(const Attitude& s, const Eigen::Vector3d& delta)
{
    return {turned(s.q, delta)};
}

} // namespace group

/// q' = q w / 2 with the body angular velocity w(t): a turn about one axis where `axis` stands still.
struct Turning {
    using Scalar = double;
    using State = group::Attitude;
    using Tangent = Eigen::Vector3d;
    static constexpr int dimension = 3;
    bool steady = false;

    Status rhs(double t, const State& s, Tangent& ds) const noexcept
    {
        ds = steady ? Tangent(0.3, -0.4, 1.2) : Tangent(std::cos(3 * t), 1 + s.q.x(), std::sin(t) - s.q.w());
        return Status::ok;
    }
};

/// The same with the retraction as a member of the model, on a column of four lanes.
struct Member {
    using Scalar = double;
    using State = Eigen::Vector4d; ///< x, y, z, w as Eigen has them
    using Tangent = Eigen::Vector3d;
    static constexpr int dimension = 3;

    Status rhs(double t, const State& s, Tangent& ds) const noexcept
    {
        return Turning{}.rhs(t, {Eigen::Quaterniond(s)}, ds);
    }
    static State retract(const State& s, const Tangent& delta) { return turned(Eigen::Quaterniond(s), delta).coeffs(); }
};

static_assert(RightHandSide<Turning> && RightHandSide<Member>);
static_assert(!moves_by_sums<Turning> && !moves_by_sums<Member>);

/// Vectors, by sums and by a retraction that is the sum.
struct Sum {
    using Scalar = double;
    using State = Eigen::Vector3d;
    static constexpr int dimension = 3;
    Status rhs(double t, const State& s, State& ds) const noexcept
    {
        ds = State(s[1] * s[2] + t, -s[0] * s[2], s[0] * s[1] / 3);
        return Status::ok;
    }
};

struct Retracted : Sum {
    static State retract(const State& s, const State& delta) { return s + delta; }
};

double length_error(const Eigen::Quaterniond& q)
{
    return std::abs(q.norm() - 1);
}

const group::Attitude start{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};

} // namespace

TEST_CASE("A state with a retraction stays on its group to rounding, and follows the motion")
{
    const auto check = [](const auto& method, double accuracy) {
        const auto run = integrate(Turning{}, start, {0.0, 10.0}, method);
        CHECK(run.status() == Status::ok);
        CHECK(length_error(run.state.q) < tolerance::roundoff(10));
        CHECK(run.state.q.angularDistance(start.q) > 0.1);
        const auto finer = integrate(Turning{}, start, {0.0, 10.0}, Rk4{.step = 1e-4});
        CHECK(run.state.q.angularDistance(finer.state.q) < accuracy);
    };
    check(Euler{.step = 1e-3}, 0.1);
    check(Rk4{.step = 0.01}, 1e-2);
    check(Midpoint{.step = 0.01}, 1e-2);
}

TEST_CASE("A turn about a fixed axis is exact in every step, whatever its length")
{
    const Eigen::Vector3d w(0.3, -0.4, 1.2);
    const auto expected = turned(start.q, 4 * w);
    for (const double step : {0.1, 1.0}) {
        CHECK(integrate(Turning{true}, start, {0.0, 4.0}, Euler{.step = step}).state.q.angularDistance(expected) <
              1e-14);
        CHECK(integrate(Turning{true}, start, {0.0, 4.0}, Rk4{.step = step}).state.q.angularDistance(expected) < 1e-14);
    }
}

TEST_CASE("A retraction may be a member of the model; the integrator, rows and values inside a step use it")
{
    const std::array<double, 2> at{0.123, 1.0};
    const auto run = integrate(Member{}, start.q.coeffs(), {0.0, 1.0}, Rk4{.step = 0.01}, {.at = at});
    const auto other = integrate(Turning{}, start, {0.0, 1.0}, Rk4{.step = 0.01});
    CHECK(run.state == other.state.q.coeffs());
    REQUIRE(run.states.size() == 2);
    CHECK(std::abs(run.states[0].norm() - 1) < tolerance::roundoff(10));
    Integrator integrator(Turning{}, start, 0, Rk4{.step = 0.25});
    REQUIRE(integrator.advance_to(-1) == Status::ok);
    CHECK(length_error(integrator.state().q) < tolerance::roundoff(10));
    CHECK(length_error(integrator.at(-0.9).q) < tolerance::roundoff(10));
    CHECK(integrator.at(-0.9).q.angularDistance(integrator.state().q) > 1e-3);
}

/// The same with a quaternion as the state, which has a scalar and no entries.
struct Quaternion {
    using Scalar = double;
    using State = Eigen::Quaterniond;
    using Tangent = Eigen::Vector3d;
    static constexpr int dimension = 3;

    Status rhs(double t, const State& s, Tangent& ds) const noexcept { return Turning{}.rhs(t, {s}, ds); }
    static State retract(const State& s, const Tangent& delta) { return turned(s, delta); }
};

TEST_CASE("A quaternion may be the state")
{
    const auto run = integrate(Quaternion{}, start.q, {0.0, 1.0}, Rk4{.step = 0.01});
    CHECK(run.status() == Status::ok);
    CHECK(run.state.coeffs() == integrate(Turning{}, start, {0.0, 1.0}, Rk4{.step = 0.01}).state.q.coeffs());
}

TEST_CASE("What is made of sums is refused for a state with a retraction")
{
    const auto dense = integrate(Turning{}, start, {0.0, 1.0}, Rk4{.step = 0.01}, {.dense = true});
    CHECK(dense.status() == Status::invalid_input);
    const auto compensated = integrate(Turning{}, start, {0.0, 1.0}, Rk4{.step = 0.01, .compensated = true});
    CHECK(compensated.status() == Status::invalid_input);
}

TEST_CASE("A retraction that is the sum gives the bits of the sum")
{
    static_assert(moves_by_sums<Sum> && !moves_by_sums<Retracted>);
    const Eigen::Vector3d s(1, 0.5, -0.25);
    const auto check = [&](const auto& method) {
        const auto a = integrate(Sum{}, s, {0.0, 2.0}, method);
        const auto b = integrate(Retracted{}, s, {0.0, 2.0}, method);
        CHECK(a.state == b.state);
        CHECK((a.state - s).norm() > 0.1);
    };
    check(Euler{.step = 0.01});
    check(Rk4{.step = 0.01});
    check(Dopri5{});
}
