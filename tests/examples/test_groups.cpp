// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on Lie algebras and action algebroids.
#include "examples/follow.hpp"

#include "heavy_top_quaternion.hpp"
#include "kirchhoff.hpp"
#include "planar_body.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("bodies in an ideal fluid follow the reference on se(2) and se(3)")
{
    follow<models::planar_body<double>>("planar_body_se2");
    follow<models::kirchhoff<double>>("kirchhoff_se3");
}

TEST_CASE("the heavy top over the quaternions follows the reference")
{
    follow<models::heavy_top_quaternion<double>>("heavy_top_quaternion");
}
