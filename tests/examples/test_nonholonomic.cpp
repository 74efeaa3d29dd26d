// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples of nonholonomic constraints.
#include "examples/follow.hpp"

#include "chaplygin_sleigh.hpp"
#include "snakeboard.hpp"
#include "suslov.hpp"
#include "turntable_ball.hpp"
#include "vertical_disk.hpp"

#include <cmath>

using namespace lagen;
using examples::follow;

TEST_CASE("blades and wheels follow the reference")
{
    follow<models::chaplygin_sleigh<double>>("chaplygin_sleigh");
    follow<models::vertical_disk<double>>("vertical_disk");
    follow<models::snakeboard<double>>("snakeboard");
    follow<models::suslov<double>>("suslov_so3");
}

TEST_CASE("the header of a sleigh answers ambient velocities and reactions")
{
    const models::chaplygin_sleigh<double> sleigh;
    using State = models::chaplygin_sleigh<double>::State;
    const std::vector<ConstrainedCase> cases = read_constrained_cases();
    const auto found =
        std::ranges::find(cases, "chaplygin_sleigh", [](const ConstrainedCase& each) { return each.reference.name; });
    REQUIRE(found != cases.end());
    for (std::size_t k = 0; k < found->points.size(); ++k) {
        const State s = examples::state_of<State>(found->reference.points[k].state);
        Eigen::Vector3d Y, lambda;
        REQUIRE(sleigh.ambient_velocity(0, s, Y) == Status::ok);
        REQUIRE(sleigh.reaction(0, s, lambda) == Status::ok);
        CHECK(examples::relative_error(Y, examples::state_of<Eigen::Vector3d>(found->points[k].ambient_velocity)) <
              1e-13);
        CHECK(examples::relative_error(lambda, examples::state_of<Eigen::Vector3d>(found->points[k].reaction)) < 1e-13);
    }
}

TEST_CASE("a ball comes back after 7/2 turns of its table")
{
    models::turntable_ball<double> ball;
    ball.parameters.J = 2.0 / 5.0 * ball.parameters.m * ball.parameters.r * ball.parameters.r;
    const auto s = models::turntable_ball<double>::state({.x = 0.5, .y = -0.3}, {.u = 0.2, .v = 0.4, .n = 0.6});
    const double period = 7 * 3.14159265358979323846 / ball.parameters.Om;
    const auto run = integrate(ball, s, {0.0, period}, Dop853{.tolerance = 1e-13});
    REQUIRE(run);
    CHECK(examples::relative_error(run.state, s) < 1e-11);
    const auto half = integrate(ball, s, {0.0, period / 2}, Dop853{.tolerance = 1e-13});
    CHECK(examples::relative_error(half.state, s) > 0.1);
    CHECK(std::abs(ball.energy(0, half.state) - ball.energy(0, s)) > 1e-3);
}
