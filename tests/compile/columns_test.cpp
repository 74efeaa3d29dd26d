// SPDX-License-Identifier: GPL-2.0-or-later
/// Jacobians that are computed by columns.
#include "compile/generated_program.hpp"

#include <string>

using namespace lagen::testing;

namespace {

std::string header_of(const std::string& program, const std::string& model)
{
    return read_text(std::string(LAGEN_BINARY_DIR) + "/compiled/" + program + "/" + model + ".hpp");
}

const char* const chain_model = "tests/data/models/chain_relative.toml";
const char* const chain_options = "--set n=8 --only rhs,jacobian,variational";
/// Elimination along the links loses 590 roundings at this state; the entries written out one by one lose 2200.
constexpr double most_roundings = 1000;

} // namespace

TEST_CASE("a Jacobian by columns agrees with long double, packs bit for bit, derivatives are carried through it",
          "[all]")
{
    const std::string output = run_on_headers("columns", {chain_model}, chain_options);
    INFO(output);
    CHECK(header_of("columns", "chain_relative").find("sweep_columns") != std::string::npos);
    auto results = lines_by_key("all " + output);
    const std::vector<std::string>& words = results["all chain_relative"];
    REQUIRE(words.size() == 4);
    CHECK(std::stod(words[0]) < most_roundings * 1.2e-7);
    CHECK(std::stod(words[0]) > 0);
    CHECK(std::stod(words[1]) < most_roundings * 2.3e-16);
    CHECK(std::stod(words[1]) > 0);
    CHECK(words[2] == "0");
    CHECK(words[3] == "0");
    // Products with derivatives carried through the right-hand side, through the Jacobian, and the directional one.
    CHECK(std::stod(results["carried through"].at(0)) < 1e-12);
    CHECK(std::stod(results["carried twice"].at(0)) < 1e-12);
    CHECK(std::stod(results["carried directional"].at(0)) < 1e-12);
}

TEST_CASE("a Jacobian by columns agrees with 50 digits in every scalar to its precision, packs bit for bit", "[all]")
{
    const std::string output = run_on_headers("more_columns", {chain_model}, chain_options);
    INFO(output);
    auto results = lines_by_key("all " + output);
    const std::vector<std::string>& words = results["all chain_relative"];
    REQUIRE(words.size() == 6);
    CHECK(std::stod(words[0]) < most_roundings * 1.2e-7);
    CHECK(std::stod(words[1]) < most_roundings * 2.3e-16);
    CHECK(std::stod(words[2]) < most_roundings * 1.1e-19);
    CHECK(std::stod(words[2]) > 0);
    CHECK(std::stod(words[3]) < 1e-46);
    CHECK(words[4] == "0");
    CHECK(words[5] == "0");
}

TEST_CASE(
    "the Jacobian of a chain of 32 links is as long as its right-hand side a few times, and serves implicit methods",
    "[all]")
{
    auto results = lines_by_key(
        run_on_headers("long_chain", {"tests/data/models/chain_relative.toml"}, "--set n=32 --only rhs,jacobian"));
    const std::string header = header_of("long_chain", "chain_relative");
    const std::size_t rhs = header.find(" rhs("), jacobian = header.find(" jacobian_point(");
    REQUIRE(rhs != std::string::npos);
    REQUIRE(jacobian != std::string::npos);
    CHECK(header.size() - jacobian < 4 * (jacobian - rhs));
    // Central differences of step 1e-5 in double: 1e-10 times third derivatives, and 1e-16 / 1e-5.
    CHECK(std::stod(results["jacobian differences"].at(0)) < 1e-7);
    for (const char* method : {"radau5", "gauss8"}) {
        INFO(method);
        const std::vector<std::string>& words = results[std::string("method ") + method];
        REQUIRE(words.size() == 2);
        CHECK(std::stod(words[0]) > 0.01); // what the run changes
        CHECK(std::stod(words[1]) < 1e-7); // from dop853
    }
}
