// SPDX-License-Identifier: GPL-2.0-or-later
/// Published experiments from model file to number: file, check, kernels, header, compiler, integrator.
#include "compile/generated_program.hpp"

#include <cmath>

using namespace lagen::testing;

namespace {

auto like(double value, double relative)
{
    return Catch::WithinAbs(value, relative * std::abs(value));
}

double number(const std::vector<std::string>& words, std::size_t k)
{
    REQUIRE(k < words.size());
    return std::stod(words[k]);
}

} // namespace

TEST_CASE("generated headers reproduce published experiments: heavy top, Arenstorf's orbit, SUNDIALS' energies")
{
    auto results =
        lines_by_key(run_on_headers("published",
                                    {"tests/data/models/bruls_heavy_top.toml", "tests/data/models/arenstorf.toml",
                                     "tests/data/models/sundials_kepler.toml"},
                                    "", as_for_a_user));
    // RK4's limit of stability is h = 0.019455; below it the norm is lost: |R(i 75 h)| per step.
    CHECK(results["top 0.019400000000000001"][0] == "ok");
    CHECK(results["top 0.019599999999999999"][0] == "non_finite");
    CHECK_THAT(number(results["top 0.019599999999999999"], 1), Catch::WithinAbs(2.352, 1e-9));
    CHECK(results["top 0.02"][0] == "non_finite");
    CHECK_THAT(number(results["top 0.02"], 1), Catch::WithinAbs(0.94, 1e-9));
    CHECK_THAT(number(results["top 0.0050000000000000001"], 2), Catch::WithinAbs(0.9265, 5e-5));
    CHECK_THAT(number(results["top 0.01"], 2), Catch::WithinAbs(0.1001, 5e-5));
    CHECK_THAT(number(results["top 0.014999999999999999"], 2), Catch::WithinAbs(1.1e-7, 5e-9));
    const double published[] = {-0.15041682274564176, -0.72416559163689565, -0.67302226956044410};
    for (std::size_t k = 0; k < 3; ++k)
        CHECK_THAT(number(results["centre 2"], k + 1), Catch::WithinAbs(published[k], 1e-10));
    // An error of one rounding at the start grows by 2.3e6 in a period.
    CHECK(number(results["arenstorf 1e-14"], 2) < 3e-9);
    CHECK(number(results["arenstorf 1e-14"], 2) > 0);
    // SUNDIALS prints -1.03211855e-07: the rounding errors of 50000 sums of doubles stand in its seventh digit. This is
    // the value of the method in numbers of 113 bits, which compensated sums come to.
    CHECK_THAT(number(results["leapfrog_dkd 0.001"], 2), like(-1.032118368583e-07, 2e-8));
    CHECK_THAT(number(results["leapfrog_dkd 0.001"], 2), like(-1.03211855e-07, 3e-7));
    CHECK_THAT(number(results["leapfrog_kdk 0.001"], 2), like(3.21129917e-06, 1e-8));
    CHECK_THAT(number(results["mclachlan4 0.10000000000000001"], 2), like(-5.372305e-06, 1e-8));
    CHECK_THAT(number(results["mclachlan4 0.050000000000000003"], 2), like(-2.77646164e-07, 1e-7));
    CHECK_THAT(number(results["yoshida6 0.10000000000000001"], 2), like(0.000126811823, 1e-8));
    CHECK_THAT(number(results["yoshida6 0.050000000000000003"], 2), like(2.02661236e-06, 1e-8));
}
