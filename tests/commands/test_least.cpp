// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen explain` and `lagen run --least`: what is said, and rows against truth of more than 25 digits.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

const std::string scenes = LAGEN_SOURCE_DIR "/tests/data/scenes/";

/// The largest |w - truth|/max(1, |truth|) over the rows of `run` that the truth knows.
long double error_of(const json::Value& run, const json::Value& truth)
{
    long double worst = 0;
    std::size_t compared = 0;
    for (const json::Value& row : truth["rows"].entries)
        for (const json::Value& found : run["rows"].entries) {
            if (found[0].number() != row["t"].number()) continue;
            ++compared;
            for (std::size_t k = 0; k < row["values"].size(); ++k) {
                const long double w = row["values"][k].number();
                worst = std::max(worst, std::abs(found[k + 1].number() - w) / std::max(1.0L, std::abs(w)));
            }
        }
    CHECK(compared == truth["rows"].size());
    return worst;
}

json::Value least_run(const std::string& model, const std::string& scene)
{
    const Outcome outcome = call({"run", scenes + model + ".toml", "--scene", scene, "--least", "--method", "dop853",
                                  "--tolerance", "1e-13", "--format", "json"});
    INFO(outcome.err);
    REQUIRE(outcome.code <= 1);
    return json::parse(outcome.out);
}

json::Value truth_of(const std::string& model, const std::string& scene)
{
    return json::read_file(scenes + model + ".json")["scenes"][scene];
}

} // namespace

TEST_CASE("what a scene watches is explained, rule by rule")
{
    const Outcome outcome = call({"explain", scenes + "lagrange_top_height.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "lagrange_top_height, scene default: 2 of 6 states\n"
                         "  watched         g3\n"
                         "  constant        w3 = 3.1: its rate is 0, for all parameters\n"
                         "  own equation    g3'' = I3/I1^2*w3*area - mgl/I1 - 2/I1*g3*energy + (I1*I3 - "
                         "I3^2)/I1^2*g3*w3^2 + 3*mgl/I1*g3^2\n"
                         "  left out        g1, g2, w1, w2\n"
                         "  no fewer        rank 2: certified at Dt(g3) = 5/2, g1 = 3/7, g2 = 2/7, ..\n"
                         "  cost            21 -> 16 operations\n"
                         "  not followed    energy, area, axial_momentum\n");
    const json::Value record =
        json::parse(call({"explain", scenes + "trap_two_values.toml", "--scene", "apart", "--format", "json"}).out);
    CHECK(record["states"]["full"].text == "4");
    CHECK(record["states"]["kept"].texts() == std::vector<std::string>{"x", "u"});
    CHECK(record["rules"][0]["rule"].text == "watched");
    CHECK(record["rules"][0]["relations"].texts() == std::vector<std::string>{"k = 0"});
    CHECK(record["rank"]["value"].text == "2");
    const Outcome whole = call({"explain", scenes + "trap_wind.toml"});
    CHECK(whole.out.starts_with("trap_wind, scene default: all 4 states\n"));
}

TEST_CASE("the rows of a least run are those of the truth")
{
    // A function of its own equation, where the whole run comes within 1e-6 of a pole; equal lanes behind a wall; an
    // event on a quadrature; a jump; a start that is exactly an equilibrium; differences; a relation.
    const std::pair<const char*, const char*> all[] = {{"benchmark_top", "height"}, {"double_four_bar", "all"},
                                                       {"trap_event", "default"},   {"trap_event", "jump"},
                                                       {"trap_upright", "exact"},   {"two_bodies_apart", "default"},
                                                       {"trap_two_values", "apart"}};
    for (const auto& [model, scene] : all) {
        INFO(model << ", scene " << scene);
        const json::Value run = least_run(model, scene), truth = truth_of(model, scene);
        CHECK(error_of(run, truth) < 1e-11L);
        CHECK(run["model"].text == model);
        CHECK(run["least"]["states"].text == truth["least_states"].text);
        CHECK(run["least"]["of"].text == truth["full_states"].text);
        std::vector<std::string> columns = truth["observe"].texts();
        columns.insert(columns.begin(), "t");
        CHECK(run["columns"].texts() == columns);
        CHECK(run["status"].text == (truth.has("stops_at") ? truth["stops_at"]["status"].text : "ok"));
    }
}

TEST_CASE("a least model that is written to a file is a model")
{
    const std::string file = fresh_folder() + "/height.toml";
    REQUIRE(call({"explain", scenes + "lagrange_top_height.toml", "-o", file}).code == 0);
    const Outcome checked = call({"check", file});
    CHECK(checked.code == 0);
    CHECK(checked.out == "lagrange_top_height_default: valid\n");
    const Outcome run = call({"run", file, "--method", "dop853", "--tolerance", "1e-13"});
    const Outcome least =
        call({"run", scenes + "lagrange_top_height.toml", "--least", "--method", "dop853", "--tolerance", "1e-13"});
    CHECK(run.out == least.out);
    const std::string copy = fresh_folder() + "/again.toml";
    REQUIRE(call({"explain", scenes + "lagrange_top_height.toml", "-o", copy}).code == 0);
    const auto text = [](const std::string& path) {
        std::ifstream in(path);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    CHECK(text(copy) == text(file));
}

TEST_CASE("where nothing goes the whole model runs, and says so")
{
    const Outcome least = call({"run", scenes + "trap_wind.toml", "--least"});
    const Outcome whole = call({"run", scenes + "trap_wind.toml"});
    CHECK(least.code == 0);
    CHECK(least.out == whole.out);
    CHECK(least.err.find("the whole model runs: nothing can be left out\n") != std::string::npos);
}
