// SPDX-License-Identifier: GPL-2.0-or-later
/// Morphisms that are claimed to be equal: a Lagrangian in space is constrained to cylinders and reduced by
/// translations along them, in either order and at once.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

std::string commuting(const std::string& name)
{
    return std::string(LAGEN_SOURCE_DIR) + "/tests/data/morphisms/commuting/" + name + ".toml";
}

} // namespace

TEST_CASE("to constrain and to reduce commute, and are the map that does both at once")
{
    for (const char* name : {"constrain_reduce", "reduce_constrain"}) {
        const Outcome outcome = call({"check", commuting(name)});
        CHECK(outcome.code == 0);
        // 7 of the map itself, and x, y, u, v, w and the parameter of its claim
        CHECK(outcome.out.find(std::string(name) + ": valid\n  13 equations zero by structure, 1 proved\n") == 0);
        CHECK(outcome.out.find("by its stages") == std::string::npos); // to constrain is no reduction
        CHECK(call({"reduce", commuting(name)}).out.find("project onto those of seen_from_above\n") !=
              std::string::npos);
    }
}

TEST_CASE("a composition that is another map than it claims is refuted with the coordinate")
{
    const Outcome outcome = call({"check", commuting("astray"), "--format", "json"});
    CHECK(outcome.code == 1);
    const json::Value report = json::parse(outcome.out);
    CHECK(report["verdict"].text == "invalid");
    std::vector<std::string> refuted;
    for (const json::Value& check : report["checks"].entries)
        if (check["status"].text == "refuted")
            refuted.push_back(check["name"].text + " " + check["indices"][0].text + " " + check["residual"].text);
    CHECK(refuted == std::vector<std::string>{"equals u -2*y*a", "equals v 2*x*a"});
}
