// SPDX-License-Identifier: GPL-2.0-or-later
/// What a run says its state is worth, by a second run, and of lanes below the absolute tolerance.
#include "program.hpp"

#include "lagen_run/archive.hpp"
#include "lagen_run/report.hpp"
#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

using namespace lagen::testing;
namespace fs = std::filesystem;
namespace json = lagen::json;

namespace {

/// The line that tells of the state.
std::string line_of(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "run");
    const Outcome outcome = call(arguments);
    INFO(outcome.err);
    for (const char* word : {"  error of the state: ", "  digits hold until "})
        if (const std::size_t begin = outcome.err.find(word); begin != std::string::npos)
            return outcome.err.substr(begin + 2, outcome.err.find('\n', begin) - begin - 2);
    return "";
}

/// A pendulum that swings by a nanoradian, far below the absolute tolerance.
std::string nanoradian(const std::string& scene = "")
{
    return written_file("nanoradian.toml", R"-([base]
coordinates = ["th"]
[fibre]
coordinates = ["w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "w^2/2 + cos(th)"
[scene.default]
initial = { th = 1e-9, w = 0 }
duration = 20
samples = 3
tolerance = 1e-8
)-" + scene);
}

/// A compiler whose program gives two rows, and called again waits for an end.
std::string waiting_compiler()
{
    const std::string folder = fresh_folder(), path = folder + "/compiler";
    lagen::detail::RunReport report;
    report.status = "ok";
    report.t = report.failed_at = 1;
    report.steps = 2;
    report.state = {1, 1};
    write_text(folder + "/report", lagen::detail::packed(report));
    write_text(folder + "/rows", lagen::detail::packed(std::array{0.0, 1.0, 0.0, 1.0, 0.5, 0.25}).substr(8));
    write_text(path, R"(#!/bin/sh
while [ "$1" != -o ]; do shift; done
cat >"$2" <<'END'
#!/bin/sh
cd )" + folder + R"( || exit
[ ! -e called ] || sleep 27.1828
touch called
cp report "$2"
cat rows
END
chmod +x "$2"
)");
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

bool sleeps(const std::string& word)
{
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc"))
        if (read_text(entry.path().string() + "/cmdline").find(word) != std::string::npos) return true;
    return false;
}

} // namespace

TEST_CASE("a run says how far its state is off, and the error is of that size", "[run]")
{
    for (const std::string tolerance : {"1e-4", "1e-7"}) {
        const json::Value run =
            finished_run({"oscillator.toml", "--method", "dopri5", "--tolerance", tolerance, "--t-end", "30"});
        double most = 0;
        for (const json::Value& row : run["rows"].entries) {
            const auto t = static_cast<double>(row[0].number());
            most = std::max(most, std::hypot(static_cast<double>(row[1].number()) - std::cos(t),
                                             static_cast<double>(row[2].number()) + std::sin(t)));
        }
        CHECK(run["accuracy"]["holds_until"].kind == json::Kind::null);
        CHECK(run["accuracy"]["estimate"].number() > most / 2);
        CHECK(run["accuracy"]["estimate"].number() < most * 2);
        CHECK(run["below_absolute"].entries.empty());
    }
    CHECK_THAT(
        line_of({"oscillator.toml", "--tolerance", "1e-6"}),
        Catch::Matches(
            "error of the state: about [1-9]e-[0-9]+ \\(a second run at (a tenth|1e-[2-6]) of the tolerance.*\\)"));
    CHECK_THAT(line_of({"oscillator.toml", "--method", "rk4", "--step", "0.01"}),
               Catch::Matches("error of the state: about [1-9]e-1[0-9] \\(a second run with half the step\\)"));
}

TEST_CASE("chaos ends in the time until which digits hold", "[run]")
{
    const json::Value run = finished_run({"chaotic_pendulum.toml"});
    const long double until = run["accuracy"]["holds_until"].number();
    CHECK(run["accuracy"]["estimate"].number() > 0.01);
    CHECK(until > 10);
    CHECK(until < 30);
    CHECK_THAT(line_of({"chaotic_pendulum.toml"}),
               Catch::Matches(
                   "digits hold until t = [12][0-9.]+ \\(a second run at (a tenth|1e-[2-6]) of the tolerance.*\\)"));
}

TEST_CASE("no second run is made where it is not wanted, and a smaller tolerance than that of numbers is none", "[run]")
{
    CHECK(line_of({"oscillator.toml", "--no-second-run"}).empty());
    const Outcome outcome = call({"run", "oscillator.toml", "--no-second-run", "--format", "json"});
    CHECK(json::parse(outcome.out)["accuracy"].kind == json::Kind::null);
    CHECK(line_of({"oscillator.toml", "--tolerance", "1e-15"}) ==
          "error of the state: a second run at a smaller tolerance cannot be made");
    const Outcome both = call({"run", "oscillator.toml", "--no-second-run", "--second-run"});
    CHECK(both.code == 4);
    CHECK(both.err == "lagen run: --second-run and --no-second-run exclude each other\n");
}

TEST_CASE("every kind of run is compared: series, stages, splittings, jumps, tables, ends and crossings", "[run]")
{
    const std::string tenth = ".* \\(a second run at (a tenth|1e-[2-6]) of the tolerance.*\\)";
    for (const char* method : {"taylor", "radau5"})
        CHECK_THAT(line_of({"oscillator.toml", "--method", method}),
                   Catch::Matches("error of the state: about" + tenth));
    for (const char* method : {"yoshida6", "variational4"})
        CHECK_THAT(line_of({"oscillator.toml", "--method", method, "--step", "0.125"}),
                   Catch::Matches("error of the state: about .* \\(a second run with half the step\\)"));
    CHECK_THAT(line_of({"bouncing_ball.toml", "--t-end", "1"}), Catch::Matches("error of the state: about" + tenth));
    for (const char* scene : {"table", "watched"})
        CHECK_THAT(line_of({"pushed_mass.toml", "--scene", scene}),
                   Catch::Matches("error of the state: about" + tenth));
}

TEST_CASE("a discrete motion is run with half its step, or says why not", "[run]")
{
    CHECK_THAT(line_of({"charged_particle_discrete.toml"}), Catch::Contains("a second run with half the step"));
    const std::string none = "error of the state: a second run with half the step cannot be made: ";
    CHECK(line_of({"moser_veselov.toml"}) == none + "the start is an arrow of one step");
    const std::string spring = written_file("spring.toml", R"([parameters]
h = 0.125
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[groupoid]
kind = "pair"
[lagrangian]
L = "(v^2 - x^2)/2"
[discrete]
step = "h"
scheme = "midpoint"
[scene.default]
initial = { x = 1, v = 0 }
steps = 8
)");
    CHECK_THAT(line_of({spring}), Catch::Contains("a second run with half the step"));
    CHECK(line_of({spring, "--bind", "h"}) == none + "the model fixes its step");
}

TEST_CASE("an interrupt in the second run leaves the rows, and the run is done")
{
    const std::string folder = fresh_folder();
    const Started started =
        start_call({"run", models_folder() + "/oscillator.toml", "-o", "rows.csv", "--method", "leapfrog_kdk", "--step",
                    "0.125", "--time-scale", "1"},
                   {.environment = {{"CXX", waiting_compiler()}, {"LAGEN_CACHE", fresh_folder()}}, .folder = folder});
    for (int k = 0; k < 500 && !sleeps("27.1828"); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    REQUIRE(sleeps("27.1828"));
    REQUIRE(::kill(started.process, SIGINT) == 0);
    const Outcome outcome = finish(started);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("  error of the state: not estimated, the second run was interrupted\n"));
    CHECK(read_text(folder + "/rows.csv") == "t,x,v\r\n0,1,0\r\n1,0.5,0.25\r\n");
    CHECK(names_in(folder) == std::vector<std::string>{"rows.csv"});
}

TEST_CASE("lanes that never exceeded the absolute tolerance are told of", "[run]")
{
    const std::string model = nanoradian();
    const Outcome outcome = call({"run", model, "--method", "radau5", "--format", "json"});
    const json::Value run = json::parse(outcome.out);
    REQUIRE(run["below_absolute"].entries.size() == 2);
    CHECK(run["below_absolute"][0].text == "th");
    CHECK(run["below_absolute"][1].text == "w");
    CHECK_THAT(outcome.err, Catch::Contains("warning: th (at most 1e-09), w (at most "));
    CHECK(run["accuracy"]["holds_until"].text ==
          "10"); // a tenth of the tolerance makes the same steps, and says nothing
    CHECK_THAT(outcome.err,
               Catch::Contains(") moved and never exceeded the absolute tolerance 1e-08: the digits may be "
                               "noise\nhint: `absolute` in the scene far below them, or other units\n"));
    const std::string fine = nanoradian("[scene.fine]\nlike = \"default\"\nrelative = 1e-10\nabsolute = 1e-20\n");
    CHECK_THAT(call({"run", fine, "--scene", "fine"}).err, !Catch::Contains("never exceeded"));
    CHECK_THAT(call({"run", model, "--initial", "th=1"}).err, !Catch::Contains("never exceeded"));
    CHECK_THAT(call({"run", model, "--method", "rk4", "--step", "0.1"}).err, !Catch::Contains("never exceeded"));
}

TEST_CASE("a sweep counts the rows with lanes below the absolute tolerance", "[sweep]")
{
    const std::string folder = fresh_folder();
    const Outcome outcome =
        call({"sweep", nanoradian(), "--initial", "th=1e-9:1:2", "-o", "a.csv"}, {.folder = folder});
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "a.csv: 2 rows\nwarning: in 1 row th, w moved and never exceeded the absolute tolerance: the "
                         "digits may be noise\nhint: `absolute` in the scene far below them, or other units\n");
    CHECK(read_text(folder + "/a.csv").find('<') == std::string::npos);
}
