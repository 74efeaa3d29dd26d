// SPDX-License-Identifier: GPL-2.0-or-later
/// Further generated headers in every kind of scalar (scalars.hpp prints a line of each).
#include "scalars.hpp"

#include "duffing.hpp"
#include "half_plane.hpp"
#include "henon_heiles.hpp"
#include "kepler.hpp"
#include "lagrange_top.hpp"
#include "pendulum.hpp"
#include "rigid_body.hpp"

int main()
{
    using namespace lagen::models;
    compare<duffing>("duffing");
    compare<half_plane>("half_plane");
    compare<henon_heiles>("henon_heiles");
    compare<kepler>("kepler");
    compare<lagrange_top>("lagrange_top");
    compare<pendulum>("pendulum");
    compare<rigid_body>("rigid_body");
}
