// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen chart` and `lagen run --accuracy`: the choice among points, the three files, and errors against references
/// that were made elsewhere.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

#include "commands/chart/accuracy.hpp"
#include "commands/chart/chart.hpp"
#include "commands/chart/report.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

lagen::ChartPoint charted(const char* method, double parameter, double error, double seconds)
{
    lagen::ChartPoint point;
    point.method = method;
    point.parameter = parameter;
    point.status = "ok";
    point.error = error;
    point.seconds = seconds;
    point.rhs_calls = 40;
    point.drifts = {{"energy", 1e-3 * error}};
    return point;
}

/// Two methods that cross, a failure among them.
lagen::Chart small_chart()
{
    lagen::Chart chart;
    chart.model = "ring";
    chart.scene = "default";
    chart.form = "lagrange";
    chart.end = 1;
    chart.times = {0, 1};
    chart.reference_methods = {"taylor", "verner98"};
    chart.reference_error = 1e-20;
    chart.machine = "a machine, with a comma";
    chart.repeats = 3;
    chart.points = {charted("rk4", 0.5, 1e-2, 1e-6), charted("rk4", 0.25, 1e-4, 2e-6),
                    charted("rk4", 0.125, 1e-7, 8e-6), charted("dop853", 1e-3, 5e-4, 3e-6),
                    charted("dop853", 1e-6, 1e-7, 4e-6)};
    lagen::ChartPoint failed;
    failed.method = "gauss2";
    failed.parameter = 1;
    failed.status = "newton_diverged";
    failed.seconds = 1e-6;
    chart.points.push_back(failed);
    chart.left_out = {{"rkn64", "rkn64 integrates x'' = f(t, x), and in model 'ring' v' depends on v"}};
    return chart;
}

} // namespace

TEST_CASE("the best point for an error is the cheapest that was measured within it, and failures are none")
{
    const lagen::Chart chart = small_chart();
    CHECK(lagen::cheapest_within(chart.points, 1e-2)->parameter == 0.5);
    CHECK(lagen::cheapest_within(chart.points, 9e-3)->parameter == 0.25);
    CHECK(lagen::cheapest_within(chart.points, 1e-7)->method == "dop853");
    CHECK(lagen::cheapest_within(chart.points, 0.9e-7) == nullptr);
}

TEST_CASE("methods lead a picture where they are the cheapest, or nearly, for some error")
{
    const lagen::Chart chart = small_chart();
    CHECK(lagen::leading_methods(chart, 1) == std::vector<std::string>{"rk4", "dop853"});
    lagen::Chart slow = chart;
    for (lagen::ChartPoint& point : slow.points)
        if (point.method == "dop853") point.seconds *= 2.5;
    CHECK(lagen::leading_methods(slow, 1) == std::vector<std::string>{"rk4"});
    CHECK(lagen::leading_methods(slow, 1.3) == std::vector<std::string>{"rk4", "dop853"});
}

TEST_CASE("drifts are drawn of what the equations conserve")
{
    lagen::Chart chart = small_chart();
    CHECK(lagen::charted_invariants(chart) == std::vector<std::string>{"energy"});
    chart.energy_changes = true;
    CHECK(lagen::charted_invariants(chart).empty());
    const std::string folder = fresh_folder();
    CHECK_FALSE(lagen::draw_drifts(chart, folder + "/drift.svg"));
    CHECK(names_in(folder).empty());
}

TEST_CASE("chart.json has the members of the interface")
{
    const json::Value chart = json::parse(lagen::chart_json(small_chart()));
    for (const char* key : {"model", "scene", "reference", "points", "best"}) CHECK(chart.has(key));
    CHECK(chart["reference"]["error"].decimal() == 1e-20);
    CHECK(chart["reference"]["methods"].texts() == std::vector<std::string>{"taylor", "verner98"});
    const json::Value& point = chart["points"][0];
    CHECK(point.keys == std::vector<std::string>{"method", "parameter", "error", "invariants", "seconds", "spread",
                                                 "rhs_calls", "steps", "rejected", "status"});
    CHECK(point["parameter"].kind == json::Kind::number);
    CHECK(point["invariants"]["energy"].decimal() == 1e-5);
    CHECK(chart["points"][5]["error"].kind == json::Kind::null);
    CHECK(chart["points"][5]["status"].text == "newton_diverged");
    REQUIRE(chart["best"].size() == 2); // nothing comes within 1e-9
    CHECK(chart["best"][1]["method"].text == "dop853");
    CHECK(chart["best"][1]["error"].decimal() == 1e-6);
    CHECK(chart["best"][1]["seconds"].decimal() == 4e-6);
    CHECK(chart["left_out"][0]["method"].text == "rkn64");
}

TEST_CASE("chart.csv has a line a point, and the text names the best, the failures and what was left out")
{
    const std::string csv = lagen::chart_csv(small_chart());
    CHECK_THAT(csv, Catch::StartsWith("peer,method,parameter,status,error,seconds,spread,rhs_calls,steps,rejected,"
                                      "drift_energy\r\n,rk4,0.5,ok,0.01,1e-06,1,40,0,0,1e-05\r\n"));
    CHECK_THAT(csv, Catch::EndsWith("\r\n,gauss2,1,newton_diverged,,1e-06,1,0,0,0,\r\n"));
    const std::string text = lagen::chart_text(small_chart());
    for (const char* part : {"ring, scene default, lagrange form, 2 samples from t = 0 to 1\n",
                             "reference: taylor and verner98 in 113 bits differ by 1.0e-20\n",
                             "1e-06  dop853          tolerance 1e-06     1.0e-07    4.00e-06", "\n1e-09  not reached\n",
                             "failed: gauss2, step 1: newton_diverged\n",
                             "left out: rkn64 integrates x'' = f(t, x), and in model 'ring' v' depends on v\n"})
        CHECK_THAT(text, Catch::Contains(part));
}

TEST_CASE("where peers were charted, the text says what the best of them takes beside the best of lagen")
{
    lagen::Chart chart = small_chart();
    CHECK_THAT(lagen::chart_text(chart), !Catch::Contains("of the time of"));
    chart.points.push_back(charted("dopri5", 1e-3, 1e-4, 1e-6));
    chart.points.back().peer = "odeint";
    const std::string text = lagen::chart_text(chart);
    CHECK_THAT(text, Catch::Contains("\nerror 1e-03: rk4 takes 2.00 of the time of odeint dopri5\n\n"));
    CHECK_THAT(text, !Catch::Contains("error 1e-06:")); // no peer comes within
}

TEST_CASE("--accuracy takes the cheapest method within it, and says where there is none")
{
    const lagen::KeptChart kept = lagen::kept_chart(small_chart());
    const lagen::AccurateMethod chosen = lagen::choose_method(kept, 1e-6);
    CHECK(chosen.method == lagen::find_method("dop853"));
    CHECK(chosen.parameter == 1e-6);
    CHECK(chosen.error == 1e-7);
    const auto said = [](const lagen::KeptChart& chart) -> std::string {
        try {
            (void)lagen::choose_method(chart, 1e-9);
        } catch (const lagen::MathematicsError& error) {
            return error.message() + (error.hint().empty() ? "" : "; " + error.hint());
        }
        return "";
    };
    CHECK(said(kept) ==
          "no method comes within 1e-09 of the reference: the least error is 1e-07, by rk4 with step 0.12");
    CHECK(said({{}, ""}) == "no method comes within 1e-09 of the reference: none succeeds");
    CHECK(said({{}, "taylor and verner98 part"}) ==
          "no accuracy can be promised to the end of the run: taylor and verner98 part; --t-end makes the run shorter");
    lagen::Chart ended = small_chart();
    ended.shortened = "an event ends the scene";
    ended.ended_by_event = true;
    CHECK(lagen::kept_chart(ended).obstacle.empty());
    ended.ended_by_event = false;
    CHECK(lagen::kept_chart(ended).obstacle == "an event ends the scene");
}

TEST_CASE("a kept chart is read as it was written, and other files are none")
{
    const std::string file = fresh_folder() + "/0123456789abcdef0123456789abcdef.run";
    lagen::KeptChart kept = lagen::kept_chart(small_chart());
    kept.obstacle = "chaos";
    lagen::keep_chart(file, kept);
    const std::optional<lagen::KeptChart> found = lagen::find_chart(file);
    REQUIRE(found);
    CHECK(found->obstacle == "chaos");
    REQUIRE(found->points.size() == kept.points.size());
    for (std::size_t k = 0; k < kept.points.size(); ++k) {
        CHECK(found->points[k].method == kept.points[k].method);
        CHECK(found->points[k].parameter == kept.points[k].parameter);
        CHECK(found->points[k].error == kept.points[k].error);
        CHECK(found->points[k].seconds == kept.points[k].seconds);
        CHECK(found->points[k].status == kept.points[k].status);
    }
    write_text(file, "what `lagen run` proved and compiled\n");
    CHECK_FALSE(lagen::find_chart(file));
}

TEST_CASE("the distance of two tables is that of their rows, relative to the second")
{
    const lagen::Table a{{"t", "x", "y"}, {0, 3, 4, 1, 0, 1}}, b{{"t", "x", "y"}, {0, 3, 4.5, 1, 0, 2}};
    CHECK(lagen::table_distance(a, b) == 0.5);
    CHECK(lagen::table_distance(a, a) == 0);
    CHECK(std::isinf(lagen::table_distance(a, {})));
    CHECK(lagen::table_distance({{"t", "x"}, {0, 0.25}}, {{"t", "x"}, {0, 0}}) == 0.25);
}

TEST_CASE("the errors of a chart are those of lagen run against 28 digits", "[chart][all]")
{
    const std::string folder = fresh_folder();
    const json::Value exact = json::read_file(LAGEN_SOURCE_DIR "/tests/data/continuous/rigid_body_near_axis1.json");
    std::string times;
    for (const json::Value& sample : exact["samples"].entries) times += (times.empty() ? "" : ", ") + sample["t"].text;
    write_text(folder + "/body.toml", read_text(models_folder() + "/rigid_body.toml") +
                                          "[scene.sampled]\nlike = \"default\"\nat = [" + times + "]\n");
    const std::vector<std::string> scene{folder + "/body.toml", "--scene", "sampled"};
    const auto with = [&](const char* command, std::vector<std::string> options) {
        options.insert(options.begin(), scene.begin(), scene.end());
        options.insert(options.begin(), command);
        return call(options);
    };
    const Outcome outcome = with("chart", {"--methods", "dop853,rk4", "-o", folder + "/new/files"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    for (const char* name : {"chart.csv", "chart.json", "chart.png", "chart.svg", "drift.png", "drift.svg"})
        CHECK(read_text(folder + "/new/files/" + name).size() > 1000);
    const json::Value chart = json::read_file(folder + "/new/files/chart.json");
    CHECK(chart["reference"]["error"].decimal() < 1e-15);
    CHECK(chart["reference"]["methods"].texts() == std::vector<std::string>{"taylor", "verner98"});

    std::map<std::string, int> compared;
    for (const json::Value& point : chart["points"].entries) {
        const double error = point["error"].decimal();
        if (!(error > 1e-9 && error < 1e-4)) continue;
        const bool steps = point["method"].text == "rk4";
        const Outcome run = with("run", {"--method", point["method"].text, steps ? "--step" : "--tolerance",
                                         point["parameter"].text, "--format", "json"});
        REQUIRE(run.code == 0);
        const json::Value rows = json::parse(run.out)["rows"];
        REQUIRE(rows.size() == exact["samples"].size());
        double most = 0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            double distance = 0, size = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const double r = exact["samples"][k]["state"][i].decimal(), away = rows[k][i + 1].decimal() - r;
                distance += away * away;
                size += r * r;
            }
            most = std::max(most, std::sqrt(distance / size));
        }
        CHECK(std::abs(error - most) < 1e-4 * most);
        ++compared[point["method"].text];
    }
    CHECK(compared["dop853"] >= 3);
    CHECK(compared["rk4"] >= 3);
    const Outcome second = with("chart", {"--methods", "dop853,rk4", "-o", folder});
    CHECK(outcome.err.find("compiling ") != std::string::npos);
    CHECK(second.err.find("compiling ") == std::string::npos);
    const json::Value again = json::read_file(folder + "/chart.json");
    REQUIRE(again["points"].size() == chart["points"].size());
    for (std::size_t k = 0; k < again["points"].size(); ++k)
        for (const char* key : {"method", "parameter", "error", "rhs_calls", "steps", "status"})
            CHECK(again["points"][k][key].text == chart["points"][k][key].text);
}

TEST_CASE("a chart ends where its reference ends, or the event of its scene, and says so", "[all]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/pole.toml", R"(title = "x'' = 6 x^2: x = 1/(1 - t)^2"
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v^2/2 + 2*x^3"
[scene.default]
initial = { x = 1, v = 2 }
duration = 2
[scene.late]
like = "default"
at = [2]
[scene.half]
like = "default"
[scene.half.events]
four = { when = "x - 4", stop = true }
)");
    const Surroundings there{.folder = folder};
    const Outcome whole = done({"chart", "pole.toml", "--methods", "rkn86"}, there);
    CHECK_THAT(whole.err, Catch::Contains("warning: the chart ends at t = 0.9: "));
    CHECK(json::read_file(folder + "/chart.json")["end"].decimal() == Approx(0.9));
    const Outcome late = call({"chart", "pole.toml", "--scene", "late", "--methods", "rkn86"}, there);
    CHECK(late.code == 1);
    CHECK_THAT(late.err, Catch::Contains("error: no reference can be made for scene 'late' beyond t = 0: ") &&
                             Catch::EndsWith("hint: --t-end makes the chart shorter\n"));
    REQUIRE(call({"chart", "pole.toml", "--scene", "half", "--methods", "rkn86"}, there).code == 0);
    const json::Value half = json::read_file(folder + "/chart.json");
    CHECK(std::abs(half["end"].decimal() - 0.5) < 1e-15);
    CHECK(half["shortened"].text == "an event ends the scene");
    const Outcome split = call({"chart", "pole.toml", "--methods", "rkn86,gauss4"}, there);
    CHECK(split.code == 0);
}

TEST_CASE("without numbers of 113 bits there is no chart, and no compiler speaks of it", "[chart]")
{
    const std::string folder = fresh_folder(), model = models_folder() + "/oscillator.toml";
    write_text(folder + "/c++",
               "#!/bin/sh\nfor word; do [ \"$word\" = -lquadmath ] && { echo no such library >&2; exit 1; "
               "}; done\nexec c++ \"$@\"\n");
    std::filesystem::permissions(folder + "/c++", std::filesystem::perms::owner_all);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"chart", model, "-o", folder}, {"run", model, "--accuracy", "1e-3"}}) {
        const Outcome outcome = call(arguments, {.environment = {{"CXX", "./c++"}}, .folder = folder});
        CHECK(outcome.code == 5);
        CHECK_THAT(
            outcome.err,
            Catch::EndsWith("error: the reference of a chart has 113 bits, and the C++ compiler './c++' makes no "
                            "program with __float128 and libquadmath\nhint: g++ on x86 does; CXX names the "
                            "compiler\n"));
    }
}

TEST_CASE("--accuracy keeps its promise, says by what, and charts once", "[chart]")
{
    // A symmetric body precesses: w1 and w2 turn at the rate w3 (I3 - I1)/I1 = -1/2.
    const std::string cache = fresh_folder(), model = cache + "/body.toml";
    write_text(model, read_text(models_folder() + "/rigid_body.toml") +
                          "[scene.precession]\nparameters = { I1 = 2, I2 = 2, I3 = 1 }\n"
                          "initial = { w1 = 1, w2 = 0, w3 = 1 }\nduration = 2\n");
    const auto accurate = [&](const char* accuracy) {
        return call(
            {"run", model, "--scene", "precession", "--accuracy", accuracy, "--at", "0,2/3,2", "--format", "json"},
            {.environment = {{"LAGEN_CACHE", cache}}});
    };
    const auto programs = [&] {
        std::vector<std::string> names = names_in(cache);
        std::erase_if(names, [](const std::string& name) { return name.ends_with(".run"); });
        return names;
    };
    const Outcome first = accurate("1e-9");
    INFO(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err, Catch::Contains("no chart of this scene is kept: it is made now\n") &&
                              Catch::Contains("accuracy 1e-09: ") && Catch::Contains(" moves no row by more than "));
    // What is best for other accuracies was compiled with the first one.
    const std::vector<std::string> compiled = programs();
    const Outcome second = accurate("1e-6");
    REQUIRE(second.code == 0);
    CHECK_THAT(second.err, Catch::StartsWith("accuracy 1e-06: "));
    CHECK(accurate("1e-3").code == 0);
    CHECK(programs() == compiled);
    for (const auto& [outcome, accuracy] : {std::pair(first, 1e-9), std::pair(second, 1e-6)}) {
        const json::Value run = json::parse(outcome.out);
        CHECK(run["rows"].size() == 3);
        for (const json::Value& row : run["rows"].entries) {
            const double t = row[0].decimal();
            CHECK(std::hypot(row[1].decimal() - std::cos(t / 2), row[2].decimal() + std::sin(t / 2)) < accuracy);
        }
    }
}
