// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on Lie algebras and action algebroids.
#include "examples/follow.hpp"

#include "gyrostat.hpp"
#include "heavy_top.hpp"
#include "heavy_top_quaternion.hpp"
#include "kirchhoff.hpp"
#include "lagrange_top.hpp"
#include "planar_body.hpp"
#include "rigid_body.hpp"

using namespace lagen;
using examples::follow;
using examples::follow_by;

TEST_CASE("bodies in an ideal fluid follow the reference on se(2) and se(3)")
{
    follow<models::planar_body<double>>("planar_body_se2");
    follow<models::kirchhoff<double>>("kirchhoff_se3");
}

TEST_CASE("the heavy top over the quaternions follows the reference")
{
    follow<models::heavy_top_quaternion<double>>("heavy_top_quaternion");
}

TEST_CASE("the free rigid body follows the reference near its stable axes and off the unstable one")
{
    follow<models::rigid_body<double>>("rigid_body_near_axis1");
    follow<models::rigid_body<double>>("rigid_body_near_axis3");
    follow<models::rigid_body<double>>("rigid_body_unstable_axis");
}

TEST_CASE("the heavy top and Lagrange's top follow the reference")
{
    follow<models::heavy_top<double>>("heavy_top_asymmetric");
    follow<models::lagrange_top<double>>("heavy_top_lagrange", {"I2", "e1", "e2", "e3"});
}

TEST_CASE("a body with a rotor follows the reference")
{
    follow<models::gyrostat<double>>("gyrostat");
}

TEST_CASE("methods on groups follow the references of heavy tops")
{
    using Top = models::heavy_top<double>;
    follow_by<Top>("heavy_top_asymmetric", RkmkDop853{.tolerance = 1e-13}, 1e-10);
    follow_by<Top>("heavy_top_asymmetric", Rkmk4{.step = 0.001}, 1e-9);
    follow_by<Top>("heavy_top_asymmetric", GaussLie4{.step = 0.001}, 1e-9);
    follow_by<Top>("heavy_top_asymmetric", CrouchGrossman3{.step = 0.001}, 1e-6);
    follow_by<models::heavy_top_quaternion<double>>("heavy_top_quaternion", RkmkDop853{.tolerance = 1e-13}, 1e-10);
}
