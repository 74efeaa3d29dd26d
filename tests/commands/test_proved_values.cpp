// SPDX-License-Identifier: GPL-2.0-or-later
/// What is proved for the values of the file alone: L = I |w|^2/2 + c |w|^4/4 on so(3), where the sign of c is not
/// said. Its Hamiltonian form is made and runs with values for which the momenta fix the velocities, and with no
/// others.
#include "program.hpp"

#include "compile/generated_program.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
using Catch::Contains;

namespace {

const std::string warning = "that the momenta fix the velocities is proved for c = 3/5 alone";

/// t = 2 and the state there.
std::vector<double> end_of(const std::string& form, const std::vector<std::string>& options)
{
    std::vector<std::string> arguments{"quartic_body.toml", "--form", form, "--at", "2", "--tolerance", "1e-12"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return last_row(arguments);
}

} // namespace

TEST_CASE("what is proved for the values of the file is enough to derive, to generate with a warning and to run")
{
    CHECK_THAT(call({"check", "quartic_body.toml"}).out,
               Contains("regular, rank 3, positive definite (for the parameter values of the file)"));
    const Outcome derived = call({"derive", "quartic_body.toml", "--form", "hamilton"});
    CHECK(derived.code == 0);
    CHECK(derived.err == "warning: " + warning + "\n");
    CHECK_THAT(derived.out, Catch::StartsWith("WARNING: " + warning + "\n"));
    const Outcome generated = call({"generate", "quartic_body.toml", "--form", "hamilton"});
    CHECK(generated.code == 0);
    CHECK(generated.err == "warning: " + warning + "\n");
    CHECK_THAT(generated.out,
               Contains("/// WARNING: " + warning + "\n") && Contains("/// left_domain unless c == 3/5, I > 0.\n"));
    // Lagrange's form needs no such proof.
    CHECK(call({"generate", "quartic_body.toml"}).err.empty());
}

TEST_CASE("Hamilton's and Lagrange's forms agree for the values of the file, of a scene and of the command line",
          "[run]")
{
    const std::pair<std::vector<std::string>, double> cases[] = {
        {{}, 0.6}, {{"--scene", "softer"}, 0.25}, {{"--set", "c=0.25"}, 0.25}};
    for (const auto& [options, c] : cases) {
        const std::vector<double> w = end_of("lagrange", options), p = end_of("hamilton", options);
        const double square = w[1] * w[1] + w[2] * w[2] + w[3] * w[3];
        REQUIRE(square > 1);
        for (std::size_t a = 1; a < 4; ++a) CHECK(std::fabs(p[a] - (2 + c * square) * w[a]) < 1e-10);
    }
    CHECK(std::fabs(end_of("hamilton", {})[1] - end_of("hamilton", {"--set", "c=0.25"})[1]) > 0.1);
}

TEST_CASE("values for which nothing is proved are refused, be they of a scene or of the command line")
{
    const std::string refused =
        "error: the momenta dL/dy of model 'quartic_body' are not shown to fix the velocities, as its Hamiltonian form "
        "needs: d2L/dy2 is not shown to be definite\n"
        "hint: give [hamiltonian] H, or conditions on x and parameters in [base] domain under which d2L/dy2 is "
        "definite\n";
    for (const std::vector<std::string>& value :
         {std::vector<std::string>{"--scene", "negative"}, {"--set", "c=-0.05"}}) {
        std::vector<std::string> arguments{"run", "quartic_body.toml", "--form", "hamilton"};
        arguments.insert(arguments.end(), value.begin(), value.end());
        const Outcome outcome = call(arguments);
        CHECK(outcome.code == 1);
        CHECK(outcome.err == refused);
        // Lagrange's form runs.
        CHECK(end_of("lagrange", value).size() == 4);
    }
}

TEST_CASE("a header takes no other value of a parameter that its proof used, and any of the others", "[run]")
{
    CHECK(run_on_headers("proved_values", {"tests/commands/models/quartic_body.toml"}, "--form hamilton") ==
          "float ok ok left_domain left_domain\n"
          "double ok ok left_domain left_domain\n"
          "run left_domain\n");
}
