// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on integrable subbundles.
#include "examples/follow.hpp"

#include "hyperboloids.hpp"
#include "spherical_pendulum_meridian.hpp"
#include "spherical_pendulum_tilted.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("the spherical pendulum follows the reference on the leaves of r^2, in both frames")
{
    follow<models::spherical_pendulum_meridian<double>>("spherical_pendulum_subbundle_meridian", {"l"});
    follow<models::spherical_pendulum_tilted<double>>("spherical_pendulum_subbundle_zframe", {"l"});
}

TEST_CASE("one model follows the reference on the hyperboloid of one sheet and on the cone")
{
    follow<models::hyperboloids<double>>("leaf_alpha_plus_1");
    follow<models::hyperboloids<double>>("leaf_alpha_zero");
}

TEST_CASE("on the hyperboloid of two sheets positions follow the reference, whose frame is another")
{
    using Leaves = models::hyperboloids<double>;
    const ReferenceCase& known = examples::reference("leaf_alpha_minus_1");
    const Leaves model = examples::with_parameters<Leaves>(known, {});
    // The reference's velocity (z a, z b, x a + y b) at its start, (0.625, -0.375, 0.165), in this frame.
    const auto start = Leaves::state({.x = 0.6, .y = 0.45, .z = 1.25}, {.a = -0.9, .b = 22.0 / 75.0});
    examples::check_trajectory(examples::AnyModel<5>(model), known, start, 3);
}
