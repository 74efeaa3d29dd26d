// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` where the mathematics or the scene says no: the status, the exit code, and the rows so far.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

/// A run of tests/commands/models/fall.toml that cannot go on.
json::Value fails(const std::string& scene, const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments{"run", "fall.toml", "--scene", scene, "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = call(arguments);
    INFO(scene << ": " << outcome.err);
    REQUIRE(outcome.code == 1);
    return json::parse(outcome.out);
}

void refused_run(const std::string& scene, const std::string& block, const std::string& text)
{
    const std::string folder = fresh_folder();
    write_text(folder + "/m.toml",
               read_text(models_folder() + "/oscillator.toml") + "\n[scene." + scene + "]\n" + block);
    const Outcome outcome = call({"run", "m.toml", "--scene", scene, "-o", "rows.csv"}, {.folder = folder});
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == text);
    CHECK(names_in(folder) == std::vector<std::string>{"m.toml"});
}

} // namespace

TEST_CASE("an infall into a centre cannot go on, and keeps the rows before it", "[run]")
{
    // x = 1 at rest falls with x'' = -1/x^2: it arrives at t = pi/(2 sqrt 2).
    const json::Value value = fails("fall", {"--at", "0,1/2,1,2"});
    // Which limit is met first, of the step or of the force, is the step control's affair.
    const std::string status = value["status"].text;
    CHECK((status == "step_too_small" || status == "non_finite"));
    CHECK(value["rows"].size() == 3);
    CHECK(std::abs(std::strtod(value["t"].text.c_str(), nullptr) - 1.1107207345395915) < 1e-6);
    const std::string folder = fresh_folder();
    const Outcome outcome = call({"run", "fall.toml", "--at", "0,2", "-o", folder + "/rows.csv"});
    CHECK(outcome.code == 1);
    CHECK(read_text(folder + "/rows.csv") == "t,x,v\r\n0,1,0\r\n");
    CHECK_THAT(outcome.err, Catch::StartsWith("fall, scene fall: " + status + " at t = 1.1107") &&
                                Catch::Contains(" right-hand sides, 1 row\n"));
}

TEST_CASE("a wall of the domain ends a run, also where a step goes over it", "[run]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/wall.toml",
               "[parameters]\nk = 2\n[base]\ncoordinates = [\"x\", \"y\"]\n"
               "domain = [\"k != 3\", \"x != 0\", \"x^2 + y^2 != 0\"]\n"
               "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"(v_x^2 + v_y^2)/2\"\n"
               "[scene.default]\ninitial = { x = 1, y = 1, v_x = -1, v_y = 0 }\nduration = 3\n"
               "[scene.back]\nlike = \"default\"\ninitial = { x = -0.5, y = 1, v_x = 1, v_y = 0 }\n"
               "[scene.back.events]\nhalf = { when = \"x + 0.25\" }\n");
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--method", "rk4", "--step", "0.3"}, {"--method", "taylor"}}) {
        std::vector<std::string> arguments{"run", folder + "/wall.toml", "--format", "json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = call(arguments);
        CHECK(outcome.code == 1);
        const json::Value value = json::parse(outcome.out);
        CHECK(value["status"].text == "left_domain");
        CHECK(std::abs(value["t"].number() - 1) < 1e-12L);
        CHECK(value["events"].size() == 0);
    }
    const json::Value back =
        json::parse(call({"run", folder + "/wall.toml", "--scene", "back", "--format", "json"}).out);
    CHECK(back["status"].text == "left_domain");
    CHECK(std::abs(back["t"].number() - 0.5L) < 1e-12L);
    REQUIRE(back["events"].size() == 1);
    CHECK(back["events"][0]["name"].text == "half");
}

TEST_CASE("a run that leaves the domain says so")
{
    const json::Value value = fails("leave");
    CHECK(value["status"].text == "left_domain");
    CHECK(value["rows"].size() == 41); // t = 0, 0.005, .., 0.195: x reaches 0 at 0.198, and the last good state
    CHECK(std::strtod(value["t"].text.c_str(), nullptr) < 0.2);
}

TEST_CASE("a run that fails ends with its last good state, at the time of that state")
{
    for (const char* scene : {"leave", "fall"}) {
        const json::Value value = fails(scene);
        INFO(scene);
        const double t = std::strtod(value["t"].text.c_str(), nullptr);
        CHECK(t <= std::strtod(value["failed_at"].text.c_str(), nullptr));
        const json::Value& last = value["rows"][value["rows"].size() - 1];
        CHECK(last[0].text == value["t"].text);
        CHECK(last[1].text == value["state"]["x"].text);
        CHECK(last[2].text == value["state"]["v"].text);
        // The state belongs to this time: the energy of the fall from x = 1 is kept by it.
        const double x = std::strtod(last[1].text.c_str(), nullptr), v = std::strtod(last[2].text.c_str(), nullptr);
        if (std::string(scene) == "fall") CHECK(std::abs(v * v / 2 - 1 / x + 1) < 1e-6 / x);
    }
    const Outcome outcome = call({"run", "fall.toml", "--scene", "leave"});
    const std::size_t begin = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
    const std::string last = outcome.out.substr(begin, outcome.out.size() - begin - 2);
    CHECK_THAT(last, Catch::StartsWith("0.198"));
    CHECK_THAT(outcome.err, Catch::Contains(" left_domain at t = 0.198") &&
                                Catch::Contains("\n  the last good state is at t = 0.198") &&
                                Catch::Contains(": x = ") && Catch::Contains(", v = -5"));
}

TEST_CASE("an observable that is not defined is an empty field of CSV and null in JSON", "[run]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/m.toml", read_text(models_folder() + "/oscillator.toml") +
                                       "\n[observables]\ndepth = \"log(x - 3)\"\nover = \"1/(x - x0)\"\n"
                                       "[scene.undefined]\ninitial = { x = 1, v = 0 }\nduration = 1\n"
                                       "observe = [\"over\", \"x\", \"depth\"]\n[parameters]\nx0 = 1\n");
    const Outcome csv = done({"run", "m.toml", "--scene", "undefined", "--at", "0"}, {.folder = folder});
    CHECK(csv.out == "t,over,x,depth\r\n0,,1,\r\n");
    const Outcome text =
        call({"run", "m.toml", "--scene", "undefined", "--at", "0", "--format", "json"}, {.folder = folder});
    const json::Value row = json::parse(text.out)["rows"][0];
    REQUIRE(row.size() == 4);
    CHECK(row[1].text == "null");
    CHECK(row[2].text == "1");
    CHECK(row[3].text == "null");
}

TEST_CASE("a singular mass matrix is a status, not a number")
{
    const json::Value value = fails("singular");
    CHECK(value["status"].text == "singular_mass_matrix");
    CHECK(value["rows"].size() == 0);
    CHECK(value["t"].text == "0");
}

TEST_CASE("a state that overflows ends with non_finite, and JSON has null for what is no number")
{
    const json::Value value = fails("grow", {"--at", "0"});
    CHECK(value["status"].text == "non_finite");
    CHECK(value["rows"].size() == 1);
    CHECK(value["invariants"]["energy"]["initial"].text == "null");
}

TEST_CASE("more steps than the bound end with too_many_steps", "[all]")
{
    const json::Value value = fails("many", {"--at", "0"});
    CHECK(value["status"].text == "too_many_steps");
    CHECK(value["steps"].text == "100000000");
}

TEST_CASE("a method for separable systems refuses a system that is none", "[run]")
{
    const Outcome outcome = call({"run", "heavy_top.toml", "--method", "leapfrog_dkd", "--step", "0.01"});
    CHECK(outcome.code == 4);
    CHECK(outcome.out.empty());
    CHECK_THAT(
        outcome.err,
        Catch::Contains("leapfrog_dkd splits x' = f(y), y' = g(x) or a sum of exact flows, and in model 'heavy_top' "));
}

TEST_CASE("a splitting whose order rests on an affine x' says which compose exact flows", "[run]")
{
    const Outcome outcome =
        call({"run", "heavy_top.toml", "--form", "hamilton", "--method", "srkn6", "--step", "0.01"});
    CHECK(outcome.code == 4);
    CHECK_THAT(outcome.err, Catch::Contains("srkn6 splits x' = M y + c, y' = g(x), and in model 'heavy_top' g1' "
                                            "depends on g2\nhint: blanesmoan6 and kahanli8 compose its exact flows"));
}

TEST_CASE("a table that would exhaust the memory is refused with its bound")
{
    const Outcome many = call({"run", "fall.toml", "--scene", "rows"});
    CHECK(many.code == 3);
    CHECK_THAT(many.err, Catch::Contains("error: scene 'rows' asks for 1e+07 rows of 3 numbers, where at most 2e+07 "
                                         "numbers are possible\n"));
    const Outcome fine = call({"run", "fall.toml", "--scene", "rows2"});
    CHECK(fine.code == 3);
    CHECK_THAT(fine.err, Catch::Contains("error: scene 'rows2' asks for 1e+301 rows of 3 numbers, where at most 2e+07 "
                                         "numbers are possible\n  sample = 1e-300\n           ^~~~~~\n"));
}

TEST_CASE("a scene that cannot start is an error of the model file, and nothing is written")
{
    refused_run("s", "initial = { x = 1 }\nduration = 1\n",
                "m.toml:18:8: error: scene 's' leaves out the initial value of v\n  [scene.s]\n         ^\n"
                "hint: rest = true sets the fibre coordinates left out to zero\n");
    refused_run("s", "initial = { x = 1, v = 0 }\n",
                "m.toml:18:8: error: scene 's' has no duration\n  [scene.s]\n         ^\n"
                "hint: give `duration`, or --t-end\n");
    refused_run("s", "initial = { x = \"10^400\", v = 0 }\nduration = 1\n",
                "m.toml:18:8: error: 'x' starts at 1e+400 in scene 's', where at most 1.79769e+308 is possible\n"
                "  [scene.s]\n         ^\n");
    refused_run("s", "initial = { x = 1, v = 0 }\nduration = 1\nmethod = \"rk44\"\n",
                "m.toml:21:10: error: unknown method 'rk44'\n  method = \"rk44\"\n           ^~~~~~\n"
                "hint: did you mean 'rk4'?\n");
    refused_run(
        "s", "initial = { x = 1, v = 0 }\nduration = 1\nat = [0, 2]\n",
        "m.toml:21:10: error: a row is wanted at t = 2, outside of the run from 0 to 1\n  at = [0, 2]\n           ^\n");
}

TEST_CASE("a start off a constraint is refused, with the size of the miss")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/heavy_top.toml", read_text(models_folder() + "/heavy_top.toml") +
                                               "\n[scene.off]\nlike = \"default\"\ninitial = { g1 = 0.6, g2 = 0, g3 = "
                                               "0.81, w1 = 0, w2 = 0, w3 = 0 }\n");
    const Outcome outcome = call({"run", "heavy_top.toml", "--scene", "off"}, {.folder = folder});
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::Contains("error: the start of scene 'off' misses the constraint g1^2 + g2^2 + g3^2 "
                                            "- 1 = 0: its left side is 0.0161, where at most "));
    CHECK_THAT(outcome.err,
               Catch::EndsWith("hint: correct the initial values, or let lagen move them: project = true\n"));
}
