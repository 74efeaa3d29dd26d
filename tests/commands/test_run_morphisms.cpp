// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` of morphism files: both runs, the rows side by side, and the defect of the projection, small where the
/// map is a morphism and large where it is none.
#include "program.hpp"

#include "scene/projection.hpp"
#include "support/golden.hpp"
#include "support/json.hpp"
#include "text/diagnostic.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace lagen::testing;
namespace json = lagen::json;
namespace fs = std::filesystem;

namespace {

const std::string morphism_models = std::string(LAGEN_SOURCE_DIR) + "/models/morphisms/";

/// A copy of tests/data/morphisms in which one model has a scene.
std::string morphisms_with_scene(const std::string& model, const std::string& scene)
{
    const std::string folder = fresh_folder() + "/morphisms";
    fs::copy(std::string(LAGEN_SOURCE_DIR) + "/tests/data/morphisms", folder);
    std::ofstream(folder + "/" + model, std::ios::app) << "[scene.default]\n" << scene;
    return folder + "/";
}

const std::string charged_scene =
    "initial = { x = 0, y = 0, s = 0, p_v_x = 0.5, p_v_y = 0.1, p_v_s = 0.4 }\nsteps = 100\n";
const std::string body_scene = "initial = { th = 0.3, x = 0.1, y = -0.2 }\n"
                               "next = { th = 0.36, x = 0.15, y = -0.18 }\nsteps = 200\n";
const std::string top_scene = "initial = { ph = 0.2, th = 0.9, ps = 0.5 }\n"
                              "next = { ph = 0.22, th = 0.885, ps = 0.555 }\nsteps = 200\n";

double entry_of(const json::Value& run, std::size_t row, const std::string& name)
{
    const std::vector<std::string> names = run["columns"].texts();
    const auto k = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    return run["rows"][row][k].decimal();
}

} // namespace

TEST_CASE("the heavy top in Euler angles projects onto the one on the sphere to 1e-11, with both runs told", "[run]")
{
    const std::string csv = fresh_folder() + "/rows.csv";
    const json::Value value =
        report_of("run", {morphism_models + "heavy_top_reduction.toml", "--tolerance", "1e-13", "-o", csv});
    CHECK(value.keys == std::vector<std::string>{"source", "target", "defect"});
    const json::Value &source = value["source"], &target = value["target"];
    CHECK(source["model"].text == "heavy_top_euler");
    CHECK(target["model"].text == "heavy_top");
    CHECK(target["method"].text == "dop853");
    CHECK(source["columns"].texts() == std::vector<std::string>{"t", "ph", "th", "ps", "dph", "dth", "dps"});
    CHECK(target["columns"].texts() == std::vector<std::string>{"t", "g1", "g2", "g3", "w1", "w2", "w3"});
    REQUIRE(source["rows"].size() == 201);
    REQUIRE(target["rows"].size() == 201);
    CHECK(value["defect"]["columns"].keys == std::vector<std::string>{"g1", "g2", "g3", "w1", "w2", "w3"});
    CHECK(value["defect"]["max"].decimal() < 1e-11);
    CHECK(value["defect"]["max"].decimal() > 0);
    // By hand, at the last row.
    const double th = entry_of(source, 200, "th"), ps = entry_of(source, 200, "ps");
    const double dph = entry_of(source, 200, "dph"), dth = entry_of(source, 200, "dth"),
                 dps = entry_of(source, 200, "dps");
    CHECK(std::abs(entry_of(target, 200, "g1") - std::sin(th) * std::sin(ps)) < 1e-11);
    CHECK(std::abs(entry_of(target, 200, "g3") - std::cos(th)) < 1e-11);
    CHECK(std::abs(entry_of(target, 200, "w1") - (dph * std::sin(th) * std::sin(ps) + dth * std::cos(ps))) < 1e-11);
    CHECK(std::abs(entry_of(target, 200, "w3") - (dph * std::cos(th) + dps)) < 1e-11);
    CHECK(std::abs(entry_of(target, 200, "w1") - entry_of(target, 0, "w1")) > 0.1);
    CHECK(read_text(csv).starts_with("t,g1,g2,g3,w1,w2,w3,projected_g1,projected_g2,projected_g3,projected_w1,"
                                     "projected_w2,projected_w3\r\n"));
    const std::string report = fresh_folder() + "/report.json";
    REQUIRE(call({"run", morphism_models + "heavy_top_reduction.toml", "-o", report}).code == 0);
    CHECK(json::parse(read_text(report)).keys == std::vector<std::string>{"source", "target", "defect"});
}

TEST_CASE("Elroy's beanie on TQ projects onto the one reduced by SE(2), whose motion is lifted to TQ again, to 1e-11",
          "[all]")
{
    const json::Value value =
        report_of("run", {morphism_models + "elroys_beanie_reduction.toml", "--tolerance", "1e-13", "--t-end", "5",
                          "--at", "1,5", "--set", "I2=0.7", "--reconstruct"});
    CHECK(value.keys == std::vector<std::string>{"source", "target", "defect", "reconstruction"});
    CHECK(value["defect"]["max"].decimal() < 1e-11);
    const json::Value &source = value["source"], &target = value["target"];
    CHECK(target["columns"].texts() ==
          std::vector<std::string>{"t", "ps", "d", "W", "v1", "v2", "lifted_th", "lifted_x", "lifted_y", "lifted_ps"});
    REQUIRE(target["rows"].size() == 2);
    CHECK(entry_of(target, 1, "t") == 5);
    // The locked angular velocity is (I1 + I2)^-1 times the spin, with the I2 that was set.
    const double spin = (1.3 + 0.7) * 0.7 + 0.7 * 1.2;
    CHECK(std::abs(entry_of(target, 1, "W") - spin / 2) < 1e-11);
    CHECK(std::abs(entry_of(target, 1, "d") - 1.2) > 0.1);
    // The pose is not in the target: the lift has it from the start and the velocity alone.
    CHECK(value["reconstruction"]["columns"].keys == std::vector<std::string>{"th", "x", "y", "ps"});
    CHECK(value["reconstruction"]["max"].decimal() < 1e-11);
    CHECK(std::abs(entry_of(target, 1, "lifted_x") - entry_of(source, 1, "x")) < 1e-11);
    CHECK(std::abs(entry_of(source, 1, "x") - 2.5) < 1e-11); // the centre moves at the rate 0.5
}

TEST_CASE("in Hamilton's form momenta are compared by the pull-back of those of the target", "[all]")
{
    const json::Value value =
        report_of("run", {morphism_models + "heavy_top_reduction.toml", "--form", "hamilton", "--tolerance", "1e-13"});
    CHECK(value["source"]["form"].text == "hamilton");
    CHECK(value["target"]["form"].text == "hamilton");
    CHECK(value["defect"]["columns"].keys == std::vector<std::string>{"g1", "g2", "g3", "p_dph", "p_dth", "p_dps"});
    CHECK(value["defect"]["max"].decimal() < 1e-11);
}

TEST_CASE("arrows of the pair groupoid of SE(2) go to arrows of the group, step by step to round-off", "[run][all]")
{
    const std::string folder = morphisms_with_scene("se2_pair.toml", body_scene);
    const json::Value value = report_of("run", {folder + "se2_reduction.toml"});
    CHECK(value["defect"]["max"].decimal() < 1e-12);
    const json::Value &source = value["source"], &target = value["target"];
    REQUIRE(target["rows"].size() == 201);
    CHECK(source["columns"].texts() == std::vector<std::string>{"t", "th", "x", "y", "p_v_th", "p_v_x", "p_v_y"});
    // By hand: W = g_k^-1 g_{k+1}.
    for (const std::size_t k : {0UL, 57UL, 199UL}) {
        const double th = entry_of(source, k, "th"), turn = entry_of(source, k + 1, "th") - th;
        const double dx = entry_of(source, k + 1, "x") - entry_of(source, k, "x");
        const double dy = entry_of(source, k + 1, "y") - entry_of(source, k, "y");
        CHECK(std::abs(entry_of(target, k, "W[2,1]") - std::sin(turn)) < 1e-12);
        CHECK(std::abs(entry_of(target, k, "W[1,3]") - (std::cos(th) * dx + std::sin(th) * dy)) < 1e-12);
    }
    CHECK(std::abs(entry_of(target, 199, "W[1,3]") - entry_of(target, 0, "W[1,3]")) > 1e-3);
}

TEST_CASE("the discrete top in Euler angles projects onto the one of the action groupoid to round-off", "[all]")
{
    const std::string folder = morphisms_with_scene("top_pair.toml", top_scene);
    CHECK(report_of("run", {folder + "top_reduction.toml"})["defect"]["max"].decimal() < 1e-11);
}

TEST_CASE("a charged particle of the circle bundle projects to round-off; by a wrong fibre map it is far off", "[all]")
{
    const std::string folder = morphisms_with_scene("kaluza_klein.toml", charged_scene);
    const json::Value value = report_of("run", {folder + "circle_reduction.toml"});
    CHECK(value["defect"]["max"].decimal() < 1e-12);
    CHECK(value["defect"]["columns"].keys ==
          std::vector<std::string>{"x", "y", "W[1,1]", "W[1,2]", "W[2,1]", "W[2,2]", "p_v_x", "p_v_y", "p_v_s"});

    const Outcome refused = call({"run", folder + "wrong_fibre.toml"});
    CHECK(refused.code == 1);
    CHECK(refused.out.empty());
    CHECK(refused.err ==
          "error: morphism 'wrong_fibre' is refuted: fibre (q, v_s), residual 1\nhint: see `lagen check " + folder +
              "wrong_fibre.toml`; --unchecked goes on all the same\n");

    const Outcome unchecked = call({"run", folder + "wrong_fibre.toml", "--unchecked", "--format", "json"});
    CHECK(unchecked.code == 0);
    CHECK(json::parse(unchecked.out)["defect"]["max"].decimal() > 1);
    const Outcome told = call({"run", folder + "wrong_fibre.toml", "--unchecked"});
    CHECK(told.err.starts_with("warning: this morphism is REFUTED: fibre (q, v_s), residual 1\n"));
    CHECK(told.err.find("defect of the projection: at most 2.82, of x at t = 10, in 101 rows\nwarning: the projection "
                        "of the source is not the motion of the target: x is off by 2.82, more than 1e-3 of its size "
                        "4.11 from t = 1.7 on\n") != std::string::npos);

    const Outcome composed = call({"run", folder + "circle_and_shape.toml"});
    CHECK(composed.code == 1);
    CHECK(composed.err ==
          "error: the source is run in the form 'discrete', and its target plane_pair has no [discrete]\n");
}

TEST_CASE("a composition is run as one map: a body turned twice has its axes where they were, the other way round",
          "[run]")
{
    const std::string folder =
        morphisms_with_scene("so3.toml", "initial = { p_w1 = 0.3, p_w2 = 0.5, p_w3 = 0.2 }\nsteps = 50\n");
    std::ofstream(folder + "twice.toml") << "compose = [\"turned.toml\", \"turned.toml\"]\n";
    const json::Value value = report_of("run", {folder + "twice.toml"});
    CHECK(value["defect"]["max"].decimal() < 1e-12);
    // Q^2 = diag(-1, -1, 1)
    CHECK(std::abs(entry_of(value["target"], 50, "p_w1") + entry_of(value["source"], 50, "p_w1")) < 1e-12);
    CHECK(std::abs(entry_of(value["target"], 50, "p_w3") - entry_of(value["source"], 50, "p_w3")) < 1e-12);
}

TEST_CASE("a covector is pushed along a map where just one is pulled back to it")
{
    using Numbers = std::vector<long double>;
    const Numbers pushed = lagen::pushed_covector({1, 2, 0, 1}, {3, 8}); // mu'_1 = 3, 2 mu'_1 + mu'_2 = 8
    REQUIRE(pushed.size() == 2);
    CHECK(std::abs(pushed[0] - 3) < 1e-17L);
    CHECK(std::abs(pushed[1] - 2) < 1e-17L);
    CHECK(std::abs(lagen::pushed_covector({1, 2}, {3, 6})[0] - 3) < 1e-17L);
    const auto error_of = [](const Numbers& matrix, const Numbers& mu) {
        try {
            (void)lagen::pushed_covector(matrix, mu);
        } catch (const lagen::MathematicsError& error) {
            return error.message();
        }
        return std::string();
    };
    CHECK(error_of({1, 2}, {3, 7}) ==
          "the momenta of the start are not of the form Phi^* mu': no start of the target has them");
    CHECK(error_of({1, 0}, {3}) ==
          "the momenta of the start are those of more than one start of the target: Phi is not "
          "surjective on the fibre there");
}
