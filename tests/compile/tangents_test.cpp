// SPDX-License-Identifier: GPL-2.0-or-later
/// Tangent vectors along trajectories of generated models.
#include "compile/generated_program.hpp"

#include <string>

using namespace lagen::testing;

TEST_CASE("tangents of generated models are differences of their flow, solve dV/dt = J V and keep the volume")
{
    auto results = lines_by_key(run_on_headers("tangents", {"models/heavy_top.toml", "models/double_pendulum.toml"},
                                               "--only rhs,jacobian,variational,mass_matrix"));
    for (const std::string name : {"heavy_top", "double_pendulum"}) {
        CAPTURE(name);
        const std::vector<std::string>& words = results["tangents " + name];
        REQUIRE(words.size() == 4);
        CHECK(std::stod(words[0]) > 1);
        // Central differences of step 1e-6 in long double: 1e-12 times third derivatives, and 1e-19 / 1e-6.
        CHECK(std::stod(words[1]) < 1e-9);
        CHECK(std::stod(words[1]) > 0);
        CHECK(std::stod(words[2]) < 1e-15);
        // RK4 with 2048 steps keeps it to its own error.
        CHECK(std::stod(words[3]) < 1e-10);
    }
}
