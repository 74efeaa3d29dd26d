// SPDX-License-Identifier: GPL-2.0-or-later
/// One header, every scalar: float, double, long double, 50 digits with and without expression templates, packs.
#include "compile/generated_program.hpp"

using namespace lagen::testing;

namespace {

std::vector<std::string> paths_of(const std::vector<std::string>& names)
{
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back("models/" + name + ".toml");
    return paths;
}

/// Reads the line of each header.
void check_scalars(const std::vector<std::string>& names, std::istream& in)
{
    for (const std::string& name : names) {
        INFO(name);
        std::string word;
        double single = 1, twofold = 1, extended = 1, lazy = 1;
        int wrong_float_lanes = 1, wrong_double_lanes = 1;
        in >> word >> single >> twofold >> extended >> lazy >> wrong_float_lanes >> wrong_double_lanes;
        CHECK(word == name);
        // A dozen roundings of the scalar's epsilon.
        CHECK(single < 12 * 1.2e-7);
        CHECK(single > 0);
        CHECK(twofold < 12 * 2.3e-16);
        CHECK(twofold > 0);
        CHECK(extended < 12 * 1.1e-19);
        CHECK(lazy < 1e-48);
        CHECK(wrong_float_lanes == 0);
        CHECK(wrong_double_lanes == 0);
    }
}

} // namespace

TEST_CASE("the headers of three models agree with 50 digits in every scalar to its precision, packs bit for bit")
{
    const std::vector<std::string> names{"double_pendulum", "heavy_top", "heisenberg"};
    const std::string output = run_on_headers("scalars", paths_of(names));
    std::istringstream in(output);
    INFO(output);
    check_scalars(names, in);
    // RK4's coefficients are exact in 50 digits: halving steps near 1e-6 divides the error of a step by 32, at 1e-30.
    double plain[3]{}, lazy[3]{};
    for (int k = 0; k < 3; ++k) in >> plain[k] >> lazy[k];
    CHECK(plain[0] < 3e-30);
    CHECK(plain[0] > 2e-30);
    for (int k = 1; k < 3; ++k) {
        CHECK_THAT(plain[k - 1] / plain[k], Catch::WithinAbs(32, 0.01));
        CHECK_THAT(lazy[k] / plain[k], Catch::WithinAbs(1, 1e-9));
    }
}

TEST_CASE(
    "the headers of seven further models agree with 50 digits in every scalar to its precision, packs bit for bit",
    "[all]")
{
    const std::vector<std::string> names{"duffing",      "half_plane", "henon_heiles", "kepler",
                                         "lagrange_top", "pendulum",   "rigid_body"};
    const std::string output = run_on_headers("more_scalars", paths_of(names));
    std::istringstream in(output);
    INFO(output);
    check_scalars(names, in);
}
