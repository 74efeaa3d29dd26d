// SPDX-License-Identifier: GPL-2.0-or-later
/// Alike terms as lanes of vectors, compiled: right-hand sides and Taylor coefficients of many bodies.
#include "compile/generated_program.hpp"

using namespace lagen::testing;

TEST_CASE("terms on vectors are the terms one by one, in every scalar, and so are their Taylor coefficients")
{
    const std::string output =
        run_on_headers("terms", {"models/pleiades.toml", "models/outer_solar_system.toml"}, "--with taylor");
    INFO(output);
    const auto lines = lines_by_key(output);
    for (const char* name : {"pleiades", "outer_solar_system"}) {
        INFO(name);
        const std::vector<std::string>& words = lines.at(std::string(name) + " terms");
        REQUIRE(words.size() == 6);
        CHECK(std::stod(words[0]) < 1e-13);
        CHECK(std::stod(words[0]) > 0);
        CHECK(std::stod(words[1]) < 1e-4);
        CHECK(std::stod(words[2]) < 1e-13);
        CHECK(std::stod(words[2]) > 0);
        CHECK(std::stod(words[3]) < 1e-13);
        CHECK(words[4] == "1");
        CHECK(words[5] == "1");
    }
}
