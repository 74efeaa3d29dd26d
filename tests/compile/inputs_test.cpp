// SPDX-License-Identifier: GPL-2.0-or-later
/// Inputs of a generated model, which a program sets each step.
#include "compile/generated_program.hpp"

#include <string>

using namespace lagen::testing;

TEST_CASE("a program sets the inputs of a generated model, and knows their Jacobian and the inverse dynamics")
{
    auto results = lines_by_key(
        run_on_headers("inputs", {"models/cart_pole.toml", "tests/compile/models/arm.toml"}, "", as_for_a_user));
    REQUIRE(results["angle end"].size() == 2);
    CHECK(std::stod(results["angle end"][0]) < 0.01);
    CHECK(results["angle end"][1] == "F");
    REQUIRE(results["angle held"].size() == 3);
    for (const std::string& difference : results["angle held"]) CHECK(std::stod(difference) < 1e-9);
    REQUIRE(results["jacobian difference"].size() == 2);
    CHECK(std::stod(results["jacobian difference"][0]) < 1e-14); // the rates are affine in the force
    CHECK(std::stod(results["jacobian difference"][1]) > 0.5);
    CHECK(std::stod(results["inverse dynamics"][0]) < 1e-13);
    CHECK(results["inverse dynamics"][1] == "singular_mass_matrix");
}
