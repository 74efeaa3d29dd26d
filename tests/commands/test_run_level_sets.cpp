// SPDX-License-Identifier: GPL-2.0-or-later
/// Level sets in `lagen run`: starts are put on them, and runs stay there.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;

TEST_CASE("a linkage that starts near its level set is put on it and stays there, with its energy", "[run]")
{
    const Outcome outcome = done({"run", std::string(LAGEN_SOURCE_DIR) + "/models/four_bar.toml", "--scene", "swing",
                                  "--tolerance", "1e-12", "--at", "0,6", "--format", "json"});
    const json::Value run = json::parse(outcome.out);
    CHECK(run["status"].text == "ok");
    const json::Value first = run["rows"][0], last = run["rows"][1];
    CHECK(std::abs(first[1].number() + 1.2L) > 1e-3L); // th was -1.2 before
    CHECK(std::abs(last[1].number() - first[1].number()) > 1);
    for (const char* loop : {"a*cos(th) + b*cos(ph) - c*cos(ps) - d", "a*sin(th) + b*sin(ph) - c*sin(ps)"})
        CHECK(run["constraints"][loop]["max"].number() < 1e-12L);
    CHECK(run["invariants"]["energy"]["max_drift"].number() < 1e-10L);
}
