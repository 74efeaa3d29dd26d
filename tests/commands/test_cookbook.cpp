// SPDX-License-Identifier: GPL-2.0-or-later
/// The models of docs/cookbook.md: what each is said to show.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

std::string recipe(const std::string& name)
{
    return std::string(LAGEN_SOURCE_DIR) + "/docs/cookbook/" + name + ".toml";
}

struct Cooked {
    json::Value run;
    std::map<std::string, double> last = last_columns(run);
};

Cooked cook(const std::string& name, std::vector<std::string> options = {})
{
    options.insert(options.begin(), {recipe(name), "--tolerance", "1e-12"});
    return {finished_run(options)};
}

} // namespace

TEST_CASE("every recipe is valid")
{
    for (const char* name : {"falling_cat", "arm", "quadrotor", "zermelo"})
        CHECK(call({"check", recipe(name)}).out.find(std::string(name) + ": valid\n") == 0);
}

TEST_CASE("the cat has turned by its loop, without angular momentum", "[run]")
{
    const Cooked cat = cook("falling_cat");
    CHECK(std::abs(cat.last.at("th") - 0.169008608420) < 1e-11); // by hand-written kinetic energy and RK4
    CHECK(std::abs(cat.last.at("p_v_th")) < 1e-11);
}

TEST_CASE("what the arm loses is the work of its joints", "[all]")
{
    const Cooked arm = cook("arm");
    CHECK(std::stod(arm.run["energy_balance"]["max_drift"].text) < 1e-10);
    CHECK(arm.last.at("energy") < 5);
}

TEST_CASE("the quadrotor comes to rest over the origin, with the thrust that carries it", "[all]")
{
    const Cooked quadrotor = cook("quadrotor", {"--t-end", "12"});
    for (const char* name : {"x[1]", "x[2]", "x[3]"}) CHECK(std::abs(quadrotor.last.at(name)) < 1e-6);
    CHECK(std::abs(quadrotor.last.at("thrust") - 1.2 * 9.81) < 1e-5);
}

TEST_CASE("Zermelo's boat steers by tan h = p_v/p_u, and p_u is constant", "[all]")
{
    const Cooked boat = cook("zermelo");
    CHECK(boat.last.at("p_u") == 0.3);
    CHECK(std::abs(std::tan(boat.last.at("h")) - boat.last.at("p_v") / boat.last.at("p_u")) < 1e-11);
    // p_v' = -p_u flow d/dy (1 - y^2): the boat turns against the current that grows to the middle.
    CHECK(boat.last.at("p_v") < 1);
}
