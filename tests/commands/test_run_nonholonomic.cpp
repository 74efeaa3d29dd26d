// SPDX-License-Identifier: GPL-2.0-or-later
/// Nonholonomic models in `lagen run`, against trajectories with multipliers.
#include "program.hpp"

#include "support/constrained_case.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace lagen::testing;
namespace json = lagen::json;
using lagen::ConstrainedCase;

namespace {

ConstrainedCase case_named(const std::string& name)
{
    const std::vector<ConstrainedCase> cases = lagen::read_constrained_cases();
    return *std::ranges::find(cases, name, [](const ConstrainedCase& each) { return each.reference.name; });
}

std::string written_model(const ConstrainedCase& constrained, const std::string& more = {})
{
    const std::string path = fresh_folder() + "/" + constrained.reference.name + ".toml";
    std::ofstream(path) << model_text(constrained) << more;
    return path;
}

/// The largest error of the observed states over the samples.
long double largest_error(const json::Value& run, const ConstrainedCase& constrained)
{
    const std::vector<lagen::ReferenceSample>& samples = constrained.reference.samples;
    REQUIRE(run["rows"].size() == samples.size());
    long double largest = 0;
    for (std::size_t k = 0; k < samples.size(); ++k)
        for (std::size_t lane = 0; lane < samples[k].state.size(); ++lane)
            largest =
                std::max(largest, std::abs(run["rows"][k][lane + 1].number() - std::stold(samples[k].state[lane])));
    return largest;
}

} // namespace

TEST_CASE("a ball on a tilted turntable follows its reference; no energy is followed that reactions change", "[run]")
{
    const ConstrainedCase turntable = case_named("turntable_ball");
    const Outcome outcome =
        call({"run", written_model(turntable), "--tolerance", "1e-13", "--method", "dop853", "--format", "json"});
    REQUIRE(outcome.code == 0);
    const json::Value run = json::parse(outcome.out);
    CHECK(run["status"].text == "ok");
    CHECK(largest_error(run, turntable) < 1e-11L);
    CHECK_FALSE(run["invariants"].has("moving_energy"));
    CHECK_FALSE(run["invariants"].has("energy"));
    CHECK(std::abs(run["rows"].entries.back()[1].number()) > 0.2L); // it has moved
}

TEST_CASE("a run of a sleigh observes ambient velocities and reactions, which keep the blade from sliding", "[run]")
{
    const ConstrainedCase sleigh = case_named("chaplygin_sleigh");
    const std::string more = "\n[scene.blade]\nlike = \"default\"\nobserve = [\"th\", \"v_x\", \"v_y\", "
                             "\"reaction.v_x\", \"reaction.v_y\", \"reaction.v_th\", \"energy\"]\n";
    const Outcome outcome = done({"run", written_model(sleigh, more), "--scene", "blade", "--tolerance", "1e-13",
                                  "--method", "dop853", "--format", "json"});
    const json::Value run = json::parse(outcome.out);
    const json::Value last = run["rows"].entries.back();
    const long double th = last[1].number();
    CHECK(std::abs(std::sin(th) * last[2].number() - std::cos(th) * last[3].number()) < 1e-14L);
    // final_reaction of the case
    CHECK(std::abs(last[4].number() - 0.0096691520106374888922853299706063L) < 1e-12L);
    CHECK(std::abs(last[5].number() - 0.032660563132604920632634406012101L) < 1e-12L);
    CHECK(std::abs(last[6].number()) < 1e-15L);
    CHECK(std::abs(last[7].number() - 0.6827L) < 1e-13L);
    CHECK(run["invariants"]["energy"]["max_drift"].number() < 1e-13L);
}

TEST_CASE("every reference trajectory is followed in both forms", "[all]")
{
    for (const ConstrainedCase& constrained : lagen::read_constrained_cases())
        for (const char* form : {"lagrange", "hamilton"}) {
            INFO(constrained.reference.name << " " << form);
            const Outcome outcome = done({"run", written_model(constrained), "--form", form, "--tolerance", "1e-13",
                                          "--method", "dop853", "--format", "json"});
            CHECK(largest_error(json::parse(outcome.out), constrained) < 1e-10L);
        }
}
