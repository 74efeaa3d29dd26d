// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions that are so long that they are printed in parts.
#include "compile/generated_program.hpp"

#include <string>

using namespace lagen::testing;

namespace {

bool has_parts(const std::string& program)
{
    return read_text(std::string(LAGEN_BINARY_DIR) + "/compiled/" + program + "/chain_relative.hpp")
               .find("/// Part 2 of ") != std::string::npos;
}

} // namespace

TEST_CASE("the Jacobian of a chain agrees with differences of the right-hand side and with the directional derivative")
{
    auto results = lines_by_key(
        run_on_headers("chain_jacobian", {"models/chain.toml"}, "--set n=16 --only rhs,jacobian,variational"));
    // Central differences of step 1e-6 in long double: 1e-12 times third derivatives, and 1e-19 / 1e-6.
    const double differences = std::stod(results["jacobian differences"].at(0));
    CHECK(differences < 1e-9);
    CHECK(differences > 0);
    CHECK(std::stod(results["jacobian directional"].at(0)) < 1e-16);
}

TEST_CASE("the output of a function in parts may stand in the place of what it reads")
{
    auto results = lines_by_key(
        run_on_headers("in_place", {"tests/data/models/chain_relative.toml"}, "--set n=56 --only rhs,variational"));
    CHECK(has_parts("in_place"));
    const std::vector<std::string>& words = results["in place"];
    REQUIRE(words.size() == 3);
    CHECK(std::stod(words[0]) > 1);
    CHECK(words[1] == "0");
    CHECK(words[2] == "0");
    // Central differences of step 1e-5 along the vector: 1e-10 times third derivatives, and 1e-16 / 1e-5.
    CHECK(std::stod(results["along differences"].at(0)) < 1e-6);
}
