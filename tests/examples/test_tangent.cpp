// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on tangent bundles, in coordinates and in quasi-velocities.
#include "examples/follow.hpp"

#include "double_pendulum.hpp"
#include "duffing.hpp"
#include "half_plane.hpp"
#include "heavy_top_euler.hpp"
#include "heavy_top_quasivelocities.hpp"
#include "kepler.hpp"
#include "pendulum.hpp"
#include "relativistic_oscillator.hpp"
#include "spherical_pendulum.hpp"
#include "torus.hpp"
#include "torus_orthonormal.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("pendulums, Kepler's orbit and Duffing's oscillator follow the reference")
{
    follow<models::pendulum<double>>("pendulum_libration");
    follow<models::pendulum<double>>("pendulum_rotation");
    follow<models::double_pendulum<double>>("double_pendulum");
    follow<models::double_pendulum<double>>("double_pendulum_energetic");
    follow<models::kepler<double>>("kepler_e06");
    follow<models::duffing<double>>("parameters_duffing");
}

TEST_CASE("geodesics of the half-plane follow the reference")
{
    follow<models::half_plane<double>>("geodesic_half_plane_orthonormal");
}

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

TEST_CASE("an oscillator whose Lagrangian is not quadratic follows the reference")
{
    follow<models::relativistic_oscillator<double>>("relativistic_oscillator");
}
