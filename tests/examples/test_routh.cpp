// SPDX-License-Identifier: GPL-2.0-or-later
/// Routhians, written out: the motion that is left of a system when its cyclic coordinates are gone.
#include "examples/follow.hpp"

#include "routh_spherical_pendulum.hpp"
#include "routh_symmetric_top.hpp"

using namespace lagen;
using examples::follow;

TEST_CASE("the Routhians of pendulum and top follow the reference")
{
    follow<models::routh_spherical_pendulum<double>>("routh_spherical_pendulum");
    follow<models::routh_symmetric_top<double>>("routh_symmetric_top");
    follow<models::routh_symmetric_top<double>>("routh_symmetric_top_fast");
}

TEST_CASE("their angle is that of the system with all its coordinates")
{
    const ReferenceCase& pendulum = examples::reference("spherical_pendulum_angles"); // th, ph, their rates
    const ReferenceCase& routh = examples::reference("routh_spherical_pendulum");
    const models::routh_spherical_pendulum<double> model =
        examples::with_parameters<models::routh_spherical_pendulum<double>>(routh, {});
    const auto start = examples::state_of<models::routh_spherical_pendulum<double>::State>(routh.initial);
    std::vector<double> times;
    for (const ReferenceSample& sample : pendulum.samples) times.push_back(examples::decimal(sample.t));
    const auto run = integrate(model, start, {times.front(), times.back()}, Dop853{.tolerance = 1e-13}, {.at = times});
    REQUIRE(run.status() == Status::ok);
    double largest = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double th = examples::decimal(pendulum.samples[k].state[0]);
        CHECK(std::abs(run.states[k][0] - th) < 1e-10);
        largest = std::max(largest, std::abs(th));
    }
    CHECK(largest > 1);
}
