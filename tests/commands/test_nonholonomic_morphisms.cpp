// SPDX-License-Identifier: GPL-2.0-or-later
/// Morphisms between nonholonomic models: D carried onto D' and the drift into b' + D', equations that project, runs.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

const std::string constrained_maps = std::string(LAGEN_SOURCE_DIR) + "/tests/data/morphisms/nonholonomic/";

/// The lines of `lagen reduce` before the equations.
std::string first_lines(const std::vector<std::string>& arguments)
{
    const std::string text = call(arguments).out;
    return text.substr(0, text.find("\n\n") + 1);
}

/// "constraint", "invariance", .. of what `check` refutes.
std::vector<std::string> refuted_by_check(const std::string& map)
{
    const Outcome outcome = call({"check", constrained_maps + map, "--format", "json"});
    CHECK(outcome.code == 1);
    const json::Value report = json::parse(outcome.out);
    std::vector<std::string> out;
    for (const json::Value& check : report["checks"].entries) {
        if (check["status"].text != "refuted") continue;
        std::string text = check["name"].text;
        for (const std::string& index : check["indices"].texts()) text += " " + index;
        out.push_back(text);
    }
    return out;
}

} // namespace

TEST_CASE("equations of nonholonomic models project where D and the drift are carried")
{
    for (const char* map : {"sleigh_reduction.toml", "sleigh_to_itself.toml", "turned_table.toml"}) {
        const Outcome outcome = call({"check", constrained_maps + map});
        INFO(outcome.out);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.find("  reduction       solutions of the source project to solutions of the target\n") !=
              std::string::npos);
    }
    CHECK(first_lines({"reduce", constrained_maps + "sleigh_reduction.toml"}) ==
          "sleigh_reduction: the equations of chaplygin_sleigh project onto those of sleigh_in_body\n"
          "  constraint      Phi(D): proved\n  lagrange        u, w: proved\n  lifts           u, w: proved\n");
    CHECK(first_lines({"reduce", constrained_maps + "turned_table.toml"}) ==
          "turned_table: the equations of turntable_ball project onto those of turntable_ball\n"
          "  constraint      Phi(u) v_y, Phi(u) W1, Phi(D): proved\n  lagrange        x, y, u, v, n: proved\n"
          "  lifts           u, v, n: proved\n");
}

TEST_CASE("a constraint or a drift that is not carried is refuted by name")
{
    CHECK(refuted_by_check("turned_blade.toml") ==
          std::vector<std::string>{"constraint Phi(u) V2", "constraint Phi(D)", "invariance L"});
    const std::vector<std::string> mirrored = refuted_by_check("mirrored_table.toml");
    REQUIRE(!mirrored.empty());
    for (const std::string& each : mirrored) CHECK(each.starts_with("constraint Phi(drift) "));
    CHECK(refuted_by_check("blade_forgotten.toml") == std::vector<std::string>{"constraint Phi(D)"});
    CHECK(first_lines({"reduce", constrained_maps + "mirrored_table.toml", "--unchecked"})
              .find("  lagrange        n: proved\n  lagrange        x, y, u, v: refuted\n") != std::string::npos);
}

TEST_CASE("motions of nonholonomic models project, by velocities and by momenta", "[run]")
{
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, std::vector<std::string>{"--form", "hamilton"}})
        for (const char* map : {"sleigh_reduction.toml", "turned_table.toml"}) {
            std::vector<std::string> arguments{"run", constrained_maps + map, "--tolerance", "1e-12", "--format",
                                               "json"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            const Outcome outcome = call(arguments);
            INFO(map << outcome.err);
            REQUIRE(outcome.code == 0);
            const json::Value value = json::parse(outcome.out);
            CHECK(value["defect"]["max"].number() < 1e-10);
            CHECK(value["defect"]["columns"].size() >= 2);
        }
    const Outcome lifted = done({"run", constrained_maps + "sleigh_reduction.toml", "--reconstruct", "--tolerance",
                                 "1e-12", "--format", "json"});
    CHECK(json::parse(lifted.out)["reconstruction"]["max"].number() < 1e-11);
}
