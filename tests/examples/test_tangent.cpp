// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on tangent bundles, in coordinates and in quasi-velocities.
#include "examples/follow.hpp"

#include "heavy_top_euler.hpp"
#include "heavy_top_quasivelocities.hpp"
#include "spherical_pendulum.hpp"
#include "torus.hpp"
#include "torus_orthonormal.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("the spherical pendulum in angles follows the reference")
{
    follow<models::spherical_pendulum<double>>("spherical_pendulum_angles");
}

TEST_CASE("geodesics of the torus follow the reference in coordinates and in an orthonormal frame")
{
    follow<models::torus<double>>("geodesic_torus");
    follow<models::torus_orthonormal<double>>("geodesic_torus_orthonormal");
}

TEST_CASE("the heavy top follows the reference in Euler angles and in quasi-velocities")
{
    follow<models::heavy_top_euler<double>>("heavy_top_euler_angles");
    follow<models::heavy_top_quasivelocities<double>>("heavy_top_euler_quasivelocities");
}
