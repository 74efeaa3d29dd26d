// SPDX-License-Identifier: GPL-2.0-or-later
/// A potential with an error function from end to end: proved, derived, generated, compiled and run.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
using Catch::Contains;
namespace json = lagen::json;

TEST_CASE("a model with an erf potential is proved, its energy invariant among the rest")
{
    const Outcome outcome = call({"check", "trap.toml"});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("trap: valid") && Contains("regularity      regular, rank 1, positive definite"));
    const json::Value value = json::parse(call({"check", "trap.toml", "--format", "json"}).out);
    bool found = false;
    for (std::size_t k = 0; k < value["checks"].size(); ++k)
        found =
            found || (value["checks"][k]["name"].text == "invariant" && value["checks"][k]["status"].text == "proved");
    CHECK(found);
}

TEST_CASE("equations with erf are printed in every format")
{
    CHECK_THAT(call({"derive", "trap.toml"}).out, Contains("erf(x/width)") && Contains("exp("));
    CHECK_THAT(call({"derive", "trap.toml", "--format", "latex"}).out, Contains("\\operatorname{erf}\\left("));
    CHECK_THAT(call({"derive", "trap.toml", "--form", "hamilton"}).out, Contains("erf(x/width)²"));
    CHECK_THAT(call({"generate", "trap.toml"}).out, Contains("using std::erf;") && Contains("erf("));
}

TEST_CASE("a run in an erf potential ends where steps of order four with 20000 steps do", "[run]")
{
    for (const char* form : {"lagrange", "hamilton"}) {
        const Outcome outcome =
            call({"run", "trap.toml", "--form", form, "--tolerance", "1e-13", "--at", "10", "--format", "json"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        const json::Value value = json::parse(outcome.out);
        CHECK(std::fabs(value["rows"][0][1].number() - 0.1555658838188) < 1e-11);
        CHECK(std::fabs(value["rows"][0][2].number() + 0.6615691761078) < 1e-11);
        CHECK(value["invariants"]["energy"]["max_drift"].number() < 1e-11);
    }
}
