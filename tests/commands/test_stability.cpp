// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen chart --stability`: its axes, its files, and outcomes that are known beforehand.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include "commands/chart/stability_chart.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

lagen::StabilityChart tiny_chart()
{
    lagen::StabilityChart chart;
    chart.model = "ring";
    chart.scene = "default";
    chart.form = "lagrange";
    chart.end = 9;
    chart.followed = "energy";
    chart.axes = {{"step", {0.5, 1, 1.5}}, {"initial.x[1]", {2, 4}, "initial.x_1"}};
    chart.columns = {{2, 1, 9}, {4, 1, 9}};
    chart.methods = {{{"leapfrog_kdk",
                       {{"bounded", 9, 0.25, 0.125},
                        {"drifting", 9, 1, 0.5},
                        {"blown_up", 3, 200, 0},
                        {"bounded", 9, 0.25, 0},
                        {"left_domain", 2, 0, 0},
                        {"newton_diverged", 0, 0, 0, "no_solution"}},
                       {}},
                      {1.0, std::nullopt}}};
    chart.left_out = {{"dop853", "dop853 takes a tolerance, and a stability chart is over steps"}};
    return chart;
}

} // namespace

TEST_CASE("stability.json has outcomes by step and column, limits by column, and says what they mean")
{
    const json::Value chart = json::parse(lagen::stability_json(tiny_chart()));
    CHECK(chart.keys == std::vector<std::string>{"model", "scene", "form", "start", "end", "axes", "omega", "methods",
                                                 "criteria", "left_out"});
    CHECK(chart["axes"][0]["name"].text == "step");
    CHECK(chart["axes"][0]["values"][2].decimal() == 1.5);
    CHECK(chart["axes"][1]["name"].text == "initial.x[1]");
    const json::Value& method = chart["methods"]["leapfrog_kdk"];
    REQUIRE(method["outcome"].size() == 3);
    CHECK(method["outcome"][1].texts() == std::vector<std::string>{"drifting", "left_domain"});
    CHECK(method["outcome"][2].texts() == std::vector<std::string>{"blown_up", "newton_diverged"});
    CHECK(method["status"][2].texts() == std::vector<std::string>{"ok", "no_solution"});
    CHECK(method["limit"][0].decimal() == 1);
    CHECK(method["limit"][1].kind == json::Kind::null);
    for (const char* key : {"bounded", "drifting", "newton_diverged", "blown_up", "left_domain", "scale", "followed"})
        CHECK_FALSE(chart["criteria"][key].text.empty());
    CHECK(chart["left_out"][0]["method"].text == "dop853");
}

TEST_CASE("stability.csv has a line a point, and the text counts outcomes")
{
    const std::string csv = lagen::stability_csv(tiny_chart());
    CHECK_THAT(csv, Catch::StartsWith("method,step,initial.x_1,outcome,t,error,drift,status\r\n"
                                      "leapfrog_kdk,0.5,2,bounded,9,0.25,0.125,ok\r\n"));
    CHECK_THAT(csv, Catch::EndsWith("\r\nleapfrog_kdk,1.5,4,newton_diverged,0,0,,no_solution\r\n"));
    const std::string text = lagen::stability_text(tiny_chart());
    CHECK_THAT(text,
               Catch::Contains("leapfrog_kdk        2         1                1         1            1            "
                               "0.5            1\n"));
    CHECK_THAT(text, Catch::EndsWith("left out: dop853 takes a tolerance, and a stability chart is over steps\n"));
}

TEST_CASE("Verlet's step ends at 2 / omega, RK4 drifts, Euler blows up, and Gauss stays: the same bytes twice",
          "[chart]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/spring.toml", R"([parameters]
k = 1
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v^2/2 - k*x^2/2"
[scene.default]
initial = { x = 1, v = 0 }
duration = 300
method = "dop853"
)");
    const auto chart_in = [&](const char* place) {
        return call({"chart", "--stability", "spring.toml", "--over", "step=0.05:1.25:25,k=1:9:3", "--methods",
                     "euler,rk4,leapfrog_kdk,gauss2", "-o", place},
                    {.folder = folder});
    };
    const Outcome outcome = chart_in("a");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    REQUIRE(chart_in("b").code == 0);
    for (const char* name : {"stability.csv", "stability.json", "stability.png", "stability.svg"}) {
        const std::string file = read_text(folder + "/a/" + name);
        CHECK(file.size() > 1000);
        CHECK(file == read_text(folder + "/b/" + name));
    }
    const json::Value chart = json::read_file(folder + "/a/stability.json");
    const json::Value& methods = chart["methods"];
    for (std::size_t j = 0; j < 3; ++j) {
        const double omega = std::sqrt(1.0 + 4.0 * static_cast<double>(j));
        CHECK(chart["omega"][j].decimal() == Approx(omega).epsilon(1e-14));
        CHECK(methods["leapfrog_kdk"]["limit"][j].decimal() == Approx(2 / omega).epsilon(1e-14));
        CHECK(methods["rk4"]["limit"][j].decimal() == Approx(2 * std::sqrt(2.0) / omega).epsilon(1e-14));
        CHECK(methods["euler"]["limit"][j].decimal() == 0);
        CHECK(methods["gauss2"]["limit"][j].kind == json::Kind::null);
        for (std::size_t i = 0; i < 25; ++i) {
            const double h_omega = chart["axes"][0]["values"][i].decimal() * omega;
            INFO("h omega = " << h_omega);
            const auto outcome_of = [&](const char* method) { return methods[method]["outcome"][i][j].text; };
            CHECK(outcome_of("gauss2") == "bounded");
            CHECK(outcome_of("euler") == "blown_up");
            // E swings by (h omega/2)^2 / (1 - (h omega/2)^2) of its size: ten times at 1.907.
            if (h_omega < 1.9) CHECK(outcome_of("leapfrog_kdk") == "bounded");
            if (h_omega > 2.001) CHECK(outcome_of("leapfrog_kdk") == "blown_up");
            // |R|^2 = 1 - y^6/72 + .. a step, over 300/h of them.
            if (h_omega > 0.4 && h_omega < 2.8) CHECK(outcome_of("rk4") == "drifting");
            if (h_omega > 2.9) CHECK(outcome_of("rk4") == "blown_up");
        }
    }
}

TEST_CASE("a discrete body is bounded up to h Omega = 1, where its momenta reach the fold: the same bytes twice",
          "[chart]")
{
    const std::string folder = fresh_folder();
    std::string body = read_text(LAGEN_SOURCE_DIR "/docs/stability/moser_veselov.toml");
    const std::string tilted = "p_w1 = 0.05, p_w2 = 0.05", straight = "p_w1 = 0, p_w2 = 0";
    REQUIRE(body.find(tilted) != std::string::npos);
    write_text(folder + "/body.toml", body.replace(body.find(tilted), tilted.size(), straight));
    const auto chart_in = [&](const char* place) {
        return call({"chart", "--stability", "body.toml", "--over", "step=0.1:1.2:12,initial.p_w3=3.4:6.8:2", "--t-end",
                     "20", "-o", place},
                    {.folder = folder});
    };
    const Outcome outcome = chart_in("a");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    REQUIRE(chart_in("b").code == 0);
    for (const char* name : {"stability.csv", "stability.json", "stability.png", "stability.svg"})
        CHECK(read_text(folder + "/a/" + name) == read_text(folder + "/b/" + name));
    const json::Value chart = json::read_file(folder + "/a/stability.json");
    REQUIRE(chart["methods"].keys == std::vector<std::string>{"discrete"});
    const json::Value& method = chart["methods"]["discrete"];
    for (std::size_t j = 0; j < 2; ++j) {
        const double speed = 1.0 + static_cast<double>(j); // p_w3 / I3
        CHECK(method["limit"][j].decimal() == Approx(1 / speed).epsilon(1e-9));
        // The momenta turn along by the angle asin(h Omega) = h Omega + .. a step, here with h = 0.01.
        CHECK(chart["omega"][j].decimal() == Approx(speed).epsilon(1e-3));
        for (std::size_t i = 0; i < 12; ++i) {
            const double turn = chart["axes"][0]["values"][i].decimal() * speed;
            INFO("h Omega = " << turn);
            if (turn < 0.99) CHECK(method["outcome"][i][j].text == "bounded");
            if (turn < 0.99) CHECK(method["status"][i][j].text == "ok");
            if (turn > 1.01) CHECK(method["outcome"][i][j].text == "newton_diverged");
            if (turn > 1.01) CHECK(method["status"][i][j].text == "no_solution");
        }
    }
}

TEST_CASE("variational methods stand beside others, and a scheme blows up in its window of unstable steps", "[all]")
{
    const std::string folder = fresh_folder(), spring = R"([base]
coordinates = ["x"]
[lagrangian]
L = "v_x^2/2 - x^2/2"
[scene.default]
initial = { x = 1, v_x = 0 }
duration = 300
)";
    write_text(folder + "/spring.toml", "[algebroid]\nkind = \"tangent\"\n" + spring);
    const auto chart = [&](const char* model, const char* over, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"chart", "--stability", model, "--over", over, "--format", "json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = done(arguments, {.folder = folder});
        return json::parse(outcome.out);
    };
    const json::Value both = chart("spring.toml", "step=0.5:3.7:9", {"--methods", "leapfrog_kdk,variational4"});
    REQUIRE(both["methods"].keys == std::vector<std::string>{"leapfrog_kdk", "variational4"});
    CHECK(both["methods"]["variational4"]["limit"][0].kind == json::Kind::null);
    for (std::size_t i = 0; i < 9; ++i) CHECK(both["methods"]["variational4"]["outcome"][i][0].text == "bounded");
    CHECK(both["methods"]["leapfrog_kdk"]["outcome"][8][0].text == "blown_up");

    write_text(folder + "/lobatto.toml",
               "[groupoid]\nkind = \"pair\"\n[discrete]\nstep = \"h\"\nscheme = \"lobatto:3\"\n" + spring);
    const json::Value found = chart("lobatto.toml", "step=2:4.4:13", {});
    CHECK(found["omega"][0].decimal() == Approx(1).epsilon(1e-12)); // of [lagrangian]
    const json::Value& scheme = found["methods"]["discrete"];
    CHECK(scheme["limit"][0].decimal() == Approx(std::sqrt(8.0)).epsilon(1e-12));
    for (std::size_t i = 0; i < 13; ++i) {
        const double h = found["axes"][0]["values"][i].decimal();
        INFO("h = " << h);
        // At 2.8, close to the end, the energy swings by 16 times its scale.
        const bool window = h > std::sqrt(8.0) && h < std::sqrt(12.0);
        CHECK(scheme["outcome"][i][0].text == (window ? "blown_up" : i == 4 ? "drifting" : "bounded"));
    }
}

TEST_CASE("a run that leaves the domain, or whose steps have no solution, is told as that", "[all]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/fall.toml", R"([base]
coordinates = ["x"]
domain = ["x > 0"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v^2/2 - x"
[scene.default]
initial = { x = 1, v = 0 }
duration = 3
)");
    const Outcome fall = done({"chart", "--stability", "fall.toml", "--over", "step=0.1:0.2:2", "--methods",
                               "heun,gauss2", "--format", "json"},
                              {.folder = folder});
    const json::Value chart = json::parse(fall.out);
    CHECK(chart["axes"].size() == 1);
    for (const char* method : {"heun", "gauss2"})
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(chart["methods"][method]["outcome"][i].texts() == std::vector<std::string>{"left_domain"});
    const Outcome swing =
        call({"chart", "--stability", models_folder() + "/pendulum.toml", "--over", "step=0.05:0.7:2,initial.w=8:8:1",
              "--t-end", "40", "--methods", "gauss2", "--format", "json"},
             {.folder = folder});
    INFO(swing.err);
    REQUIRE(swing.code == 0);
    const json::Value outcomes = json::parse(swing.out)["methods"]["gauss2"]["outcome"];
    CHECK(outcomes[0][0].text == "bounded");
    CHECK(outcomes[1][0].text == "newton_diverged");
}
