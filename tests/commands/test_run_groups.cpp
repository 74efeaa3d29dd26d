// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs by methods on groups: bodies with their attitude, tops on the dual of a semidirect sum.
#include "program.hpp"
#include "turning_body.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

} // namespace

TEST_CASE("methods on groups turn a body so that R I w is constant and R a rotation", "[all]")
{
    for (const std::string method : {"gauss_lie4", "rkmk_dop853"}) { // the others: [long]
        INFO(method);
        const std::vector<double> row = last_row({"turning_body.toml", "--method", method, "--step", "0.01"});
        check_turned(row, 5e-6);
    }
}

TEST_CASE("Lie-Poisson steps of a heavy top keep its Casimirs to rounding, and end where DOP853 does", "[run]")
{
    const std::string model = std::string(LAGEN_SOURCE_DIR) + "/models/heavy_top.toml";
    const std::vector<double> exact = last_row({model, "--form", "hamilton", "--tolerance", "1e-13"});
    for (const std::string method : {"lie_poisson4", "rkmk4"}) {
        INFO(method);
        const Outcome run = done({"run", model, "--form", "hamilton", "--method", method, "--step", "0.01", "--format",
                                  "json", "--at", "8"});
        const json::Value result = json::parse(run.out);
        for (std::size_t k = 1; k < exact.size(); ++k)
            CHECK(result["rows"][0][k].decimal() == Approx(exact[k]).margin(2e-7));
        CHECK(result["casimirs"]["norm_squared"]["max_drift"].decimal() < 1e-14);
        CHECK(result["invariants"]["area"]["max_drift"].decimal() < 2e-14);
        CHECK(result["invariants"]["energy"]["max_drift"].decimal() > 1e-12);
    }
}

TEST_CASE("a hundred thousand steps of the heavy top by every method on groups keep its Casimirs to rounding", "[all]")
{
    const std::string model = std::string(LAGEN_SOURCE_DIR) + "/models/heavy_top.toml";
    const auto lost = [&](const std::string& method) {
        const Outcome run = done({"run", model, "--form", "hamilton", "--method", method, "--step", "0.02", "--t-end",
                                  "2000", "--at", "2000", "--format", "json"});
        const json::Value result = json::parse(run.out);
        return std::max(result["casimirs"]["norm_squared"]["max_drift"].decimal(),
                        result["invariants"]["area"]["max_drift"].decimal());
    };
    for (const std::string method :
         {"rkmk4", "gauss_lie4", "crouch_grossman3", "lie_poisson2", "lie_poisson4", "rkmk_dop853"}) {
        INFO(method);
        CHECK(lost(method) < 1e-12);
    }
    CHECK(lost("rk4") > 1e-7);
}

TEST_CASE("a step that turns too far for its chart ends the run, which says so", "[run]")
{
    const Outcome run = call({"run", "turning_body.toml", "--method", "rkmk4", "--step", "5"});
    CHECK(run.code == 1);
    CHECK(run.err.find("branch_lost") != std::string::npos);
    CHECK(run.err.find("the step turns farther than the chart of the group reaches: take a shorter one") !=
          std::string::npos);
}

TEST_CASE("a body in the dual of its algebra keeps |p| to rounding", "[run]")
{
    const std::vector<double> row = last_row(
        {"turning_body.toml", "--scene", "free", "--form", "hamilton", "--method", "lie_poisson2", "--step", "0.1"});
    REQUIRE(row.size() == 4);
    CHECK(row[1] * row[1] + row[2] * row[2] + row[3] * row[3] == Approx(0.09 + 4 + 0.36).epsilon(1e-14));
    CHECK(std::abs(row[1] - 0.3) > 0.01);
}
