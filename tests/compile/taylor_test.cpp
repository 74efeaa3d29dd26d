// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method on the recurrences of generated headers: Lagrange and Pontryagin, double and 50 digits.
#include "compile/generated_program.hpp"

using namespace lagen::testing;

namespace {

void check_walks(const std::map<std::string, std::vector<std::string>>& lines)
{
    for (const char* name : {"rigid_body walk", "oval walk", "ellipse walk"}) {
        INFO(name);
        CHECK(std::stod(lines.at(name)[0]) < 2);
    }
}

} // namespace

TEST_CASE("Taylor's method meets the references to their last digit, in double in fewer steps than DOP853")
{
    const std::string output = run_on_headers("taylor",
                                              {"models/double_pendulum.toml", "models/kepler.toml",
                                               "models/relativistic_oscillator.toml", "models/half_plane_control.toml",
                                               "models/heavy_top.toml", "models/chain.toml", "models/rigid_body.toml"},
                                              "--with taylor");
    INFO(output);
    const auto lines = lines_by_key(output);
    for (const char* name :
         {"double_pendulum", "kepler", "relativistic_oscillator", "half_plane_control", "heavy_top"}) {
        INFO(name);
        const std::vector<std::string>& words = lines.at(std::string(name) + " error");
        REQUIRE(words.size() == 6);
        CHECK(std::stod(words[0]) < 1e-13);
        CHECK(std::stod(words[0]) > 0);
        CHECK(std::stod(words[1]) < 1e-30);
        CHECK(std::stod(words[2]) < 1e-11);
        CHECK(3 * std::stol(words[3]) < std::stol(words[4]));
        CHECK(words[5] == "1");
    }
    const std::vector<std::string>& slopes = lines.at("chain slopes");
    CHECK(std::stod(slopes[0]) < 1e-12);
    CHECK(std::stod(slopes[1]) < 1e-6);
    CHECK(slopes[2] == "1");
    check_walks(lines);
}

TEST_CASE("the energy walks at random for a million units of time", "[all]")
{
    const std::string output =
        run_on_headers("long_walk", {"models/kepler.toml", "models/rigid_body.toml"}, "--with taylor");
    INFO(output);
    check_walks(lines_by_key(output));
}
