// SPDX-License-Identifier: GPL-2.0-or-later
/// Splittings on the exact flows of generated headers, in double and on packs.
#include "compile/generated_program.hpp"

using namespace lagen::testing;

TEST_CASE("Generated flows compose to the motion, and packs do the same")
{
    const std::string output =
        run_on_headers("flows", {"models/heavy_top.toml", "models/half_plane.toml", "models/elroys_beanie.toml"},
                       "--form hamilton --with flows");
    INFO(output);
    const auto lines = lines_by_key(output);
    for (const char* name : {"heavy_top", "half_plane", "elroys_beanie"}) {
        INFO(name);
        const std::vector<std::string>& words = lines.at(std::string(name) + " errors");
        REQUIRE(words.size() == 4);
        CHECK(std::stod(words[0]) < 1e-11);
        CHECK(std::stod(words[1]) < 1e-14);
        CHECK(std::stod(words[2]) < 1e-14);
        CHECK(words[3] == "1");
    }
}
