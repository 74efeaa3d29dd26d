// SPDX-License-Identifier: GPL-2.0-or-later
/// Examples of models/ that use H alone, a solution of Hamilton and Jacobi's equation, forms, a reconstruction, a
/// retraction, a gradient and an `if`: what each is said to show.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

std::string example(const std::string& name)
{
    return std::string(LAGEN_SOURCE_DIR) + "/models/" + name + ".toml";
}

std::map<std::string, double> last_of(const std::string& name, std::vector<std::string> options = {})
{
    options.insert(options.begin(), example(name));
    return last_columns(finished_run(options));
}

} // namespace

TEST_CASE("Arenstorf's orbit closes after its published period", "[run]")
{
    std::map<std::string, double> last = last_of("restricted_three_body");
    CHECK(std::abs(last.at("x") - 0.994) < 1e-10);
    CHECK(std::abs(last.at("y")) < 1e-9);
    CHECK(std::abs(last.at("py") - (0.994 - 2.00158510637908252240537862224)) < 1e-8);
}

TEST_CASE("the projectile stays on dS of its solution of Hamilton and Jacobi's equation", "[run]")
{
    const std::string report = call({"check", example("projectile")}).out;
    CHECK(report.find("\n  hamilton_jacobi 1 proved\n") != std::string::npos);
    std::map<std::string, double> last = last_of("projectile");
    CHECK(std::abs(last.at("off_the_sheaf")) < 1e-12);
    CHECK(std::abs(last.at("x") - 0.6 * 1.5 / 0.5) < 1e-13); // c t/m
    CHECK(std::abs(last.at("z") - (0.6 * std::sqrt(12 - 1.5 * 1.5) / 0.5 - 9.81 * 0.6 * 0.6 / 2)) < 1e-12);
}

TEST_CASE("the field of the charged particle is d of the connection's form", "[run]")
{
    const std::string report = call({"check", example("charged_particle")}).out;
    CHECK(report.find("\n  equals          1 proved\n") != std::string::npos);
    CHECK(report.find("\n  form theta      degree 1, not closed\n") != std::string::npos);
}

TEST_CASE("the body on the hill loses energy and turns in the snow alone", "[run]")
{
    const json::Value run = finished_run({example("hill"), "--tolerance", "1e-11"});
    CHECK(std::stod(run["energy_balance"]["max_drift"].text) < 1e-8);
    std::map<std::string, double> last = last_of("hill", {"--set", "drag=0", "--tolerance", "1e-11"});
    CHECK(std::abs(last.at("spin") + 2.2) < 1e-9); // x v - y u of the start
}

TEST_CASE("the free body turns over and its momentum in space stays", "[run]")
{
    std::map<std::string, double> last = last_of("free_body_attitude", {"--t-end", "28.7"});
    CHECK(last.at("upright") < -0.99);
    CHECK(std::abs(last.at("space[1]") - 0.001) < 1e-9);
    CHECK(std::abs(last.at("space[3]") - 2) < 1e-9); // I2 w2 of the start, upwards
}

TEST_CASE("the momenta of the free body by Cayley's map stay on their sphere", "[run]")
{
    std::map<std::string, double> last = last_of("free_body_cayley", {"--scene", "default"});
    const double squared = std::pow(last.at("M1"), 2) + std::pow(last.at("M2"), 2) + std::pow(last.at("M3"), 2);
    CHECK(std::abs(squared - 8.340489817103993) < 1e-12);
}
