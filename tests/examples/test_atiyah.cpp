// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples on Atiyah algebroids.
#include "examples/follow.hpp"

#include "charged_particle.hpp"
#include "elroys_beanie.hpp"
#include "sliding_mass.hpp"
#include "wong.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("particles in gauge fields follow the reference, for the circle and for SU(2)")
{
    follow<models::charged_particle<double>>("charged_particle_reduced");
    follow<models::wong<double>>("wong_su2_plane");
}

TEST_CASE("bodies with internal shape follow the reference")
{
    follow<models::elroys_beanie<double>>("elroys_beanie_se2");
    follow<models::sliding_mass<double>>("body_sliding_mass");
}
